"""The stage of force laws: all forces are added up in one call before each kick."""

from functools import partial

from sandbox.physics.state.kick_context import Kick
from sandbox.physics.stepping.stage import Setup, Stage


def make(setup: Setup) -> Stage:
    """Make the stage; explicit Euler uses the forces before the drift."""
    if setup.stepping.scheme == "explicit-euler" and setup.scene.laws:
        clock = setup.kicks.clock
        kick = Kick(clock, 0, clock.dt, clock.dt)
        return Stage(before_drift=partial(setup.forces.apply, kick), calls=1)
    return Stage(in_kick=setup.forces.apply)
