"""What can go wrong while a world runs."""

from math import ceil

from sandbox.model.errors import SandboxError
from sandbox.model.level import HIGHEST_RATE


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
    """

    def __init__(self, subject: str, time: float, reason: str, rate: float | None = None) -> None:
        self.subject = subject
        self.time = time
        self.rate = ceil(rate) if rate is not None and rate <= HIGHEST_RATE else None
        super().__init__(f"stopped at t = {time:.6g} s: {reason}")


class SchemeError(SandboxError):
    """A scheme that is asked of a level which it is not for."""


class JointFailure(Exception):  # noqa: N818 (not an error to be shown: the world adds the time)
    """A joint that cannot be kept, and the rate at which it could, if one is known [Hz]."""

    def __init__(self, joint: str, reason: str, rate: float | None = None) -> None:
        self.joint, self.rate = joint, rate
        super().__init__(reason)


class EndlessImpacts(Exception):  # noqa: N818 (as above)
    """Elastic bodies that collide in one moment more often than can be followed."""

    def __init__(self, body: int) -> None:
        self.body = body
        super().__init__(
            "elastic bodies that touch collide too often to be followed: their masses are too far"
            " apart, or they are wedged in; let their 'restitution' be less than 1"
        )
