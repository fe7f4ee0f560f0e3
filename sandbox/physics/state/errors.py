"""The errors of a running world."""

from math import ceil

from sandbox.model.effects.contract import IncompleteError
from sandbox.model.errors import SandboxError
from sandbox.model.json_positions import Path
from sandbox.model.level import HIGHEST_RATE, Level
from sandbox.model.message import NOTHING, Message


def way_out(needed: float, rate: float) -> Message:
    """Return what to do where a higher rate would hold [Hz], if a level may have that."""
    if needed > HIGHEST_RATE:
        return Message("no 'rate' that a level may have is enough")
    return Message("take a higher 'rate': {needed:,}, not {rate:g}", needed=ceil(needed), rate=rate)


class SimulationError(SandboxError):
    """A run that had to stop; the world keeps the last state that was good.

    Attributes
    ----------
    subject
        The body or joint that is to blame.
    time
        When it was noticed [s].
    rate
        Steps a second at which it should hold; None if no rate that a level may have does [Hz].
    reason
        The message.
    hint
        What may help, which nobody has tried; empty if nothing is known.
    place
        Where in the level's file the cause stands, if the world could not even start.
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
        """Let it be told in another process, too."""
        arguments = self.subject, self.time, self.reason, self.rate, self._path, self.hint
        return type(self), arguments, {"place": self.place}

    def __str__(self) -> str:
        return str(self.message)

    @property
    def message(self) -> Message:
        """What is wrong and when, with the hint, to be translated."""
        return self.with_advice(self.hint)

    def with_advice(self, advice: Message) -> Message:
        """Return the message with some advice; none if that is empty."""
        begin = self.place or Message("stopped at t = {t:.6g} s", t=self.time)
        told = Message("{begin}: {reason}", begin=begin, reason=self.reason)
        return Message("{told}; {advice}", told=told, advice=advice) if advice else told

    def when(self, condition: str) -> "SimulationError":
        """Return the same, of values of the parameters only."""
        reason = Message("{reason} when {condition}", reason=self.reason, condition=condition)
        return SimulationError(self.subject, self.time, reason, self.rate, self._path, self.hint)

    def advised(self, hint: Message, rate: float | None) -> "SimulationError":
        """Return the same error with remedies, and a rate that works [Hz]."""
        found = SimulationError(self.subject, self.time, self.reason, rate, self._path, hint)
        found.place = self.place
        return found

    def refuse(self, level: Level) -> None:
        """Say where in a level that cannot start the cause stands, instead of when it stopped.

        The subject of the message, if nothing else is known.
        """
        parts = (part for part in ("joints", "bodies") if self.subject in getattr(level, part))
        path = self._path or next(((part, self.subject) for part in parts), ())
        self.place = level.place(path) if path else ""


class BreakdownError(SimulationError):
    """A run that ended for an unforeseen reason: a defect of the program.

    What was raised is its cause.
    """

    def __init__(self, error: Exception, time: float) -> None:
        what = " ".join(f"{error}".split()) or Message("no more is known")
        message = Message(
            "the numbers of this scene lead where nothing can be computed ({what})", what=what
        )
        if isinstance(error, IncompleteError):
            message = Message("{what}", what=what)
        super().__init__("", time, message)
        self._error = error

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (Exception(str(self._error)), self.time), {"place": self.place}


class SchemeError(SandboxError):
    """A scheme that is asked of a level which it is not for."""


class JointFailure(Exception):  # noqa: N818 (not an error to be shown: the world adds the time)
    """A joint that cannot be kept.

    It could with `finer` times as many steps, if that is known.
    """

    def __init__(self, joint: str, reason: Message, finer: float | None = None) -> None:
        self.joint, self.reason, self.finer = joint, reason, finer
        super().__init__(reason)


class NoForces(Exception):  # noqa: N818 (as above)
    """Two bodies that touch, between which no forces were found."""

    def __init__(self, a: int, b: int) -> None:
        self.bodies = a, b
        super().__init__(f"bodies {a} and {b}")
