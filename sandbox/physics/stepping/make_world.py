"""Makes the world of a level at a chosen rate, or explains why that fails."""

import numpy as np

from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.step_plugin import Begin
from sandbox.physics.stepping.world import World


def make_world(level: Level, values: Values, stepping: Stepping, begin: Begin = None) -> World:
    """Make the world of a level at a chosen rate, in the initial state that `begin` sets, if any.

    `stepping` must have a rate: if it only asks for an accuracy, this raises `ValueError`, and
    `build` finds a setting instead. Raises `SimulationError` if the world cannot even start, and
    `SchemeError` if the scheme does not suit the level.
    """
    if stepping.accuracy is not None:
        raise ValueError("an accuracy is asked for, and no rate is chosen")
    try:
        if stepping.is_composed:
            from sandbox.physics.scene.usable_schemes import require

            require(level, stepping.scheme)
        with np.errstate(all="ignore"):  # non-finite values are reported by name
            return World(level, values, stepping, begin)
    except Exception as error:  # any error is explained
        from sandbox.physics.stepping.failure_messages import explained

        explanation = explained(error, list(level.bodies), 0.0, stepping.rate)
        if isinstance(explanation, SimulationError):
            explanation.refuse(level)
        if explanation is error:
            raise
        raise explanation from error
