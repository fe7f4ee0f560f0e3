"""The hand, which grabs a world's bodies and moves them."""

from collections.abc import Mapping
from math import isfinite

import numpy as np

from sandbox.model.shapes import XY
from sandbox.physics.engine.grab_spring import Hand
from sandbox.physics.scene.stability_limits import check_springs
from sandbox.physics.scene.substep import once
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.step_plugin import Plugins, Setup


def require_leapfrog(setup: Setup, now: Snapshot) -> None:
    """Replace substeps by leapfrog, as a hand cannot pull backwards in time.

    Raises `SimulationError` if springs are too stiff for leapfrog.
    """
    scene, kicks = setup.scene, setup.kicks
    check_springs(scene.joints.springs, scene.inverse_mass, now.angle, setup.stepping.rate)
    kicks.compose([once(kicks.clock.dt)])


def grab(setup: Setup, body: str, point: XY) -> None:
    """Grab a dynamic body at a point of the plane [m]."""
    scene, forces = setup.scene, setup.forces
    if forces.hand is None:
        forces.hand = Hand(scene.space, list(scene.bodies.values()))
    forces.hand.grab(list(scene.bodies).index(body), point)


def require_reach(setup: Setup, positions: Mapping[str, XY]) -> None:
    """Raise `SimulationError` if a position [m] is outside the grid in which pymunk finds pairs."""
    scene = setup.scene
    for name, position in positions.items():
        if isfinite(scene.reach) and not max(map(abs, position)) < scene.reach:
            from sandbox.physics.stepping.plugins.grid_bounds import out_of_bounds

            raise out_of_bounds(name, scene, setup.kicks.clock.after(0))


def place(setup: Setup, plugins: Plugins, positions: Mapping[str, XY], now: Snapshot) -> None:
    """Move bodies to positions within reach [m], with their present velocities.

    Joints adapt to the new positions. Raises `JointFailure` if one cannot.
    """
    scene, t = setup.scene, setup.kicks.clock.after(0)
    for name, position in positions.items():
        scene.bodies[name].position = position
        scene.space.reindex_shapes_for_body(scene.bodies[name])
    if scene.hollows:
        scene.hollows.enclosures.update()
    for refit in plugins.refit:
        refit(t)
    scene.batch.set_velocity(np.column_stack((now.velocity, now.angular_velocity)))
