"""What can go wrong while a world runs."""

from sandbox.model.errors import SandboxError


class SimulationError(SandboxError):
    """A run that had to stop; the world keeps the last state that was good.

    Attributes
    ----------
    subject
        The body or joint that is to blame.
    time
        When it was noticed [s].
    """

    def __init__(self, subject: str, time: float, reason: str) -> None:
        self.subject = subject
        self.time = time
        super().__init__(f"stopped at t = {time:.6g} s: {reason}")


class JointFailure(Exception):  # noqa: N818 (not an error to be shown: the world adds the time)
    """A joint that cannot be kept."""

    def __init__(self, joint: str, reason: str) -> None:
        self.joint = joint
        super().__init__(reason)


class EndlessImpacts(Exception):  # noqa: N818 (as above)
    """Elastic bodies that collide in one moment more often than can be followed."""

    def __init__(self, body: int) -> None:
        self.body = body
        super().__init__(
            "elastic bodies that touch collide too often to be followed: their masses are too far"
            " apart, or they are wedged in; let their 'restitution' be less than 1"
        )
