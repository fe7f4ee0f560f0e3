"""Errors: why an accuracy cannot be reached."""

from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import Message


class AccuracyError(SandboxError):
    """An accuracy that cannot be reached, or cannot be judged."""


class Cancelled(SandboxError):  # noqa: N818 (a wish rather than an error)
    """A calibration that was cancelled."""

    def __init__(self) -> None:
        super().__init__(Message("the calibration was cancelled"))
