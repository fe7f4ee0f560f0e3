"""The message for a run that had to stop, whatever stopped it."""

from collections.abc import Sequence

from sandbox.model.errors import SandboxError
from sandbox.physics.contacts.direct.constraint_rows import TooMuch
from sandbox.physics.scene.stability_limits import MARGIN
from sandbox.physics.state.errors import (
    BreakdownError,
    EndlessImpacts,
    JointFailure,
    NoForces,
    SimulationError,
    way_out,
)


def explained(error: Exception, bodies: Sequence[str], t: float, rate: float) -> SandboxError:
    """Return the error to raise for another one: an unforeseen one is a breakdown.

    Parameters
    ----------
    error
        What was raised.
    bodies
        The names of all.
    t
        The time [s].
    rate
        Steps a second [Hz].
    """
    match error:
        case SandboxError():
            return error
        case NoForces(bodies=(a, b)):
            needed = MARGIN * rate
            message = f"no forces were found between '{bodies[a]}' and '{bodies[b]}'"
            return SimulationError(bodies[a], t, message, needed, hint=way_out(needed, rate))
        case JointFailure():
            finer = error.finer and error.finer * rate
            hint = way_out(finer, rate) if finer else ""
            return SimulationError(error.joint, t, str(error), finer, hint=hint)
        case EndlessImpacts() | TooMuch():
            body = bodies[error.body]
            return SimulationError(body, t, str(error).format(body=f"'{body}'"))
        case _:
            return BreakdownError(error, t)
