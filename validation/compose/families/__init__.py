"""The families of scenes, which scenes are drawn from.

A family is a function that builds a scene with a draft, the source of randomness. It builds what a
person might build, and varies masses, sizes, surfaces and joints.
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
