"""The message for a run that had to stop, for any error."""

from collections.abc import Sequence

from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import SystemTooLarge
from sandbox.physics.contacts.impacts.endless_impacts_error import EndlessImpacts
from sandbox.physics.scene.stability_limits import MARGIN
from sandbox.physics.state.simulation_errors import (
    BlockedError,
    BreakdownError,
    JointFailure,
    NoForces,
    SimulationError,
    way_out,
)


def explained(error: Exception, bodies: Sequence[str], t: float, rate: float) -> SandboxError:
    """Return the error to raise in place of another; an unforeseen one becomes a breakdown.

    `bodies` are the names of all bodies, `t` is the time [s], and `rate` the steps per second [Hz].
    """
    match error:
        case SandboxError():
            return error
        case NoForces(bodies=(a, b), blocked=True):
            message = Message(
                "what is driven presses '{one}' and '{other}' together, and nothing can give way",
                one=bodies[a],
                other=bodies[b],
            )
            return BlockedError(bodies[a], t, message)
        case NoForces(bodies=(a, b)):
            needed = MARGIN * rate
            message = Message(
                "no forces were found between '{one}' and '{other}'", one=bodies[a], other=bodies[b]
            )
            return SimulationError(bodies[a], t, message, needed, hint=way_out(needed, rate))
        case JointFailure():
            finer = error.finer and error.finer * rate
            hint = way_out(finer, rate) if finer else NOTHING
            return SimulationError(error.joint, t, error.reason, finer, hint=hint)
        case EndlessImpacts():
            body = bodies[error.body]
            return SimulationError(body, t, error.message_for(body))
        case SystemTooLarge():
            return SimulationError(bodies[error.body], t, error.reason)
        case _:
            return BreakdownError(error, t)
