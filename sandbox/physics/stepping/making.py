"""The world of a level, at a rate that is chosen, or why there is none."""

import numpy as np

from sandbox.model.branching import obstacle
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.world import World


def make_world(
    level: Level, values: Values, stepping: Stepping, before: World | None = None
) -> World:
    """Make the world of a level at a rate that is chosen.

    Parameters
    ----------
    level, values
        What to simulate, and its parameters.
    stepping
        How time advances; no accuracy, which `build` finds a setting for.
    before
        Another world of the level, from whose state this one begins; from the start if left out.

    Raises
    ------
    SimulationError
        If the world cannot even start.
    SchemeError
        If the scheme is not for such a level.
    ValueError
        If an accuracy is asked for.
    """
    if stepping.accuracy is not None:
        raise ValueError("an accuracy is asked for, and no rate is chosen")
    try:
        if stepping.scheme == "fourth-order":
            from sandbox.physics.scene.schemes import require

            require(level, stepping.scheme)
        with np.errstate(all="ignore"):  # what is not finite is told by name
            return World(level, values, stepping, before)
    except Exception as error:  # whatever it is, whoever builds gets an answer
        from sandbox.physics.stepping.failures import explained

        told = explained(error, list(level.bodies), before.t if before else 0.0, stepping.rate)
        if isinstance(told, SimulationError):
            told.refuse(level)
        if told is error:
            raise
        raise told from error


def branch(world: World, values: Values) -> World:
    """Make a world that goes on from the state of another with other parameters, in the same steps.

    The other one stays as it is. Of a parameter that is the same in both, nothing changes but
    rounding, and what a solver remembers of the last step.

    Raises
    ------
    SandboxError
        If a parameter that has changed cannot be while a run goes on; the message says why.
    SimulationError
        If the world cannot go on from there.
    """
    changed = [name for name in values if values[name] != world.values[name]]
    if changed and (why := obstacle(world.level, changed)):
        raise SandboxError(why)
    return make_world(world.level, values, world.stepping, world)
