"""The plugin of force laws: all forces are added up in one call before each kick."""

from functools import partial

from sandbox.physics.state.kick_context import Kick
from sandbox.physics.stepping.step_plugin import Plugin, Setup


def make(setup: Setup) -> Plugin:
    """Make the plugin; explicit Euler uses the forces before the drift."""
    if setup.stepping.scheme == "explicit-euler" and setup.scene.laws:
        clock = setup.kicks.clock
        kick = Kick(clock, 0, clock.dt, clock.dt)
        return Plugin(before_drift=partial(setup.forces.apply, kick), calls=1)
    return Plugin(in_kick=setup.forces.apply)
