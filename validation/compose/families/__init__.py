"""The families from which random scenes are drawn.

A family is a function that builds a scene with a draft, the source of randomness. It builds what a
person might build, and varies masses, sizes, surfaces and joints.
"""

from collections.abc import Callable, Mapping

from validation.compose.families import (
    colliding_mechanisms,
    driven,
    hanging,
    random_trees,
    smooth,
    standing,
)
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
        colliding_mechanisms.pendulum_at_a_wall,
        colliding_mechanisms.dumbbell,
        colliding_mechanisms.seesaw,
        colliding_mechanisms.ragdoll,
        colliding_mechanisms.cart_downhill,
        colliding_mechanisms.block_and_weight,
        colliding_mechanisms.chain_dropped,
        colliding_mechanisms.train,
        colliding_mechanisms.wrecking_ball,
        colliding_mechanisms.bolas,
        colliding_mechanisms.yo_yo,
        colliding_mechanisms.bead_and_block,
        colliding_mechanisms.collapse,
        colliding_mechanisms.fluid,
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
