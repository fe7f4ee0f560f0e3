"""Making the world of a level at a chosen rate, or saying why there is none."""

import numpy as np

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.stage import Begin
from sandbox.physics.stepping.world import World


def make_world(level: Level, values: Values, stepping: Stepping, begin: Begin = None) -> World:
    """Make the world of a level at a rate that is chosen.

    Parameters
    ----------
    level, values
        What to simulate, and its parameters.
    stepping
        How time advances; no accuracy, which `build` finds a setting for.
    begin
        Puts it where it begins, if that is not the start.

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
            return World(level, values, stepping, begin)
    except Exception as error:  # whatever it is, whoever builds gets an answer
        from sandbox.physics.stepping.failures import explained

        explanation = explained(error, list(level.bodies), 0.0, stepping.rate)
        if isinstance(explanation, SimulationError):
            explanation.refuse(level)
        if explanation is error:
            raise
        raise explanation from error
