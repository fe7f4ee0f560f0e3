"""The errors of a running world."""

from math import ceil

from sandbox.model.effects.contract import IncompleteError
from sandbox.model.errors import SandboxError
from sandbox.model.json_positions import Path
from sandbox.model.level import HIGHEST_RATE, Level
from sandbox.model.translatable_message import NOTHING, Message


def way_out(needed: float, rate: float) -> Message:
    """Return the hint that a higher rate [Hz] may help (untried), or that no allowed one will."""
    if needed > HIGHEST_RATE:
        return Message("no 'rate' that is allowed is enough")
    higher = ceil(needed)
    return Message("a higher 'rate' may help: {needed:,}, not {rate:g}", needed=higher, rate=rate)


class SimulationError(SandboxError):
    """A run that had to stop; the world keeps its last valid state.

    Attributes
    ----------
    subject
        The body or joint that caused it.
    time
        The time at which it was noticed [s].
    rate
        The steps a second that should suffice; None if no allowed rate does [Hz].
    reason
        The cause.
    hint
        A possible remedy; empty if none is known.
    place
        The location of the cause in the level's file, if the world could not start.
    """

    def __init__(
        self,
        subject: str,
        time: float,
        reason: Message,
        rate: float | None = None,
        path: Path = (),
        hint: Message = NOTHING,
    ) -> None:
        self.subject = subject
        self.time = time
        self.reason = reason
        self.hint = hint
        self.place = ""
        self._path = path
        self.rate = ceil(rate) if rate is not None and rate <= HIGHEST_RATE else None
        super().__init__(self.with_advice(hint))

    def __reduce__(self) -> tuple[object, ...]:
        """Support pickling, to pass the error to another process."""
        arguments = self.subject, self.time, self.reason, self.rate, self._path, self.hint
        return type(self), arguments, {"place": self.place}

    def __str__(self) -> str:
        return str(self.message)

    @property
    def message(self) -> Message:
        """The cause and the time, with the hint, for translation."""
        return self.with_advice(self.hint)

    def with_advice(self, advice: Message) -> Message:
        """Return the message, with advice unless that is empty."""
        begin = self.place or Message("stopped at t = {t:.6g} s", t=self.time)
        told = Message("{begin}: {reason}", begin=begin, reason=self.reason)
        return Message("{told}; {advice}", told=told, advice=advice) if advice else told

    def when(self, condition: str) -> "SimulationError":
        """Return the same error, with the note that it occurs only for some parameter values."""
        reason = Message("{reason} when {condition}", reason=self.reason, condition=condition)
        return SimulationError(self.subject, self.time, reason, self.rate, self._path, self.hint)

    def advised(self, hint: Message, rate: float | None) -> "SimulationError":
        """Return the same error with a remedy, and a rate that works, if any [Hz]."""
        found = SimulationError(self.subject, self.time, self.reason, rate, self._path, hint)
        found.place = self.place
        return found

    def refuse(self, level: Level) -> None:
        """Name the cause's location in a level that cannot start, instead of the time.

        If no location was given, it is that of the subject.
        """
        parts = (part for part in ("joints", "bodies") if self.subject in getattr(level, part))
        path = self._path or next(((part, self.subject) for part in parts), ())
        self.place = level.location(path) if path else ""


class BreakdownError(SimulationError):
    """A run ended by an unforeseen exception, its cause: that is a defect of the program."""

    def __init__(self, error: Exception, time: float) -> None:
        what = " ".join(f"{error}".split()) or Message("no details are known")
        message = Message(
            "nothing can be computed with the numbers of this scene ({what})", what=what
        )
        if isinstance(error, IncompleteError):
            message = Message("{what}", what=what)
        super().__init__("", time, message)
        self._error = error

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (Exception(str(self._error)), self.time), {"place": self.place}


class BlockedError(SimulationError):
    """A run in which something is driven into what cannot give way: no rate helps."""


class OverlapError(SimulationError):
    """Bodies that overlap at the start, at any rate and with any solver."""


class SchemeError(SandboxError):
    """A scheme that does not suit a level."""


class JointFailure(Exception):  # noqa: N818 (not an error to be shown: the world adds the time)
    """A joint that cannot be kept.

    `finer` is the factor on the step rate that should suffice, if known.
    """

    def __init__(self, joint: str, reason: Message, finer: float | None = None) -> None:
        self.joint, self.reason, self.finer = joint, reason, finer
        super().__init__(reason)


class NoForces(Exception):  # noqa: N818 (as above)
    """Two touching bodies for whose contact the solver found no forces.

    `blocked` tells whether there are none at any rate: something is driven into what cannot give
    way.
    """

    def __init__(self, a: int, b: int) -> None:
        self.bodies, self.blocked = (a, b), False
        super().__init__(f"bodies {a} and {b}")
