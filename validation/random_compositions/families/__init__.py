"""The families from which random scenes are drawn.

A family is a function that builds a scene with a draft, the source of randomness. It builds what a
person might build, and varies masses, sizes, surfaces and joints.
"""

from collections.abc import Callable, Mapping

from validation.random_compositions.families import (
    colliding_mechanisms,
    driven_scenes,
    hanging_scenes_at_rest,
    random_trees,
    smooth_scenes,
    standing_scenes_at_rest,
)
from validation.random_compositions.scene_builder import Draft

Family = Callable[[Draft], None]

FAMILIES: Mapping[str, Family] = {
    family.__name__: family
    for family in (
        standing_scenes_at_rest.strut,
        standing_scenes_at_rest.a_frame,
        standing_scenes_at_rest.table,
        standing_scenes_at_rest.car,
        standing_scenes_at_rest.ladder,
        standing_scenes_at_rest.beam,
        standing_scenes_at_rest.dumbbell_at_rest,
        standing_scenes_at_rest.bracket,
        standing_scenes_at_rest.scissor,
        standing_scenes_at_rest.wedged,
        hanging_scenes_at_rest.relieved,
        hanging_scenes_at_rest.crane,
        hanging_scenes_at_rest.platform,
        hanging_scenes_at_rest.braked_wheel,
        hanging_scenes_at_rest.trolley,
        hanging_scenes_at_rest.pressed,
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
        driven_scenes.motor_car,
        driven_scenes.belt,
        driven_scenes.lift,
        driven_scenes.pusher,
        smooth_scenes.pendulums,
        smooth_scenes.four_bar,
        smooth_scenes.springs,
        smooth_scenes.machine,
        smooth_scenes.bead,
        random_trees.tree,
    )
}
