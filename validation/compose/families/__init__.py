"""The families of scenes; what is listed here is drawn from.

A family is a function that puts a scene together from a draft, which is where chance comes from.
Each takes what a person would build, and lets masses, sizes, surfaces and joints vary.
"""

from collections.abc import Callable, Mapping

from validation.compose.families import driven, hanging, moving, random_trees, smooth, standing
from validation.compose.scene_builder import Draft

Family = Callable[[Draft], None]

FAMILIES: Mapping[str, Family] = {
    family.__name__: family
    for family in (
        standing.strut,
        standing.a_frame,
        standing.table,
        standing.car,
        standing.ladder,
        standing.beam,
        standing.dumbbell_at_rest,
        standing.bracket,
        standing.scissor,
        standing.wedged,
        hanging.relieved,
        hanging.crane,
        hanging.platform,
        hanging.braked_wheel,
        hanging.trolley,
        hanging.pressed,
        moving.pendulum_at_a_wall,
        moving.dumbbell,
        moving.seesaw,
        moving.ragdoll,
        moving.cart_downhill,
        moving.block_and_weight,
        moving.chain_dropped,
        moving.train,
        moving.wrecking_ball,
        moving.bolas,
        moving.yo_yo,
        moving.bead_and_block,
        moving.collapse,
        moving.fluid,
        driven.motor_car,
        driven.belt,
        driven.lift,
        driven.pusher,
        smooth.pendulums,
        smooth.four_bar,
        smooth.springs,
        smooth.machine,
        smooth.bead,
        random_trees.tree,
    )
}
