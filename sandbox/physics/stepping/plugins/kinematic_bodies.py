"""The plugin of kinematic bodies that follow formulas of time.

The direct solver starts from the velocities before a kick and the accelerations in it. So it gets
the motion of these bodies as an acceleration before the kick, and their velocities are set after
pymunk's solver.
"""

from sandbox.physics.engine.prescribed_motion import Motions
from sandbox.physics.state.kick_context import Kick
from sandbox.physics.stepping.step_plugin import Plugin, Setup


def make(setup: Setup) -> Plugin:
    """Make the plugin; between two steps, as at an impact, such bodies keep their velocities."""
    clock, forces, scene = setup.kicks.clock, setup.forces, setup.scene
    motions = Motions(setup.level.bodies, setup.values, scene.batch, clock.dt)

    def set_acceleration(kick: Kick) -> None:
        if kick.ahead == 0:
            forces.set_prescribed(motions.bodies, motions.accelerations(kick.t, kick.length))
            if not scene.direct:
                motions.set_velocities()

    def set_velocity(kick: Kick) -> None:
        if kick.ahead == 0:
            motions.set_velocities()

    return Plugin(in_kick=set_acceleration, after_kick=set_velocity if scene.direct else None)
