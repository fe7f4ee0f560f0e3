"""The errors of a level, and how each mistake is worded.

    SandboxError
    ├── LevelError       a level that cannot be used; it holds every Mistake
    ├── ExpressionError  a formula that is not allowed, or has no value
    ├── MisuseError      what cannot be done as it was asked for
    │   ├── QuantityError    a name that is not a quantity of the level
    │   └── ValueRangeError  a parameter that does not exist, or a value that it cannot have
    └── SimulationError  a run that had to stop (in sandbox.physics)

Code that shows messages to a person catches `SandboxError`; anything else is a defect.
"""

from dataclasses import dataclass

from sandbox.model.translatable_message import Message, joined
from sandbox.model.translatable_message import message as as_message

MAX_MISTAKES = 100
"""The most mistakes that are listed; if there are more, one at the root says so."""


class SandboxError(Exception):
    """Anything that a user can mend; its text is fit to be shown.

    It takes a message, or the template of one and its values by name.
    """

    exit_status = 1  # of a command that ends with it

    def __init__(self, message: str, /, **values: object) -> None:
        super().__init__(as_message(message, values))

    @property
    def message(self) -> Message:
        """The message, which can be translated."""
        return self.args[0]


@dataclass(frozen=True, slots=True)
class Mistake:
    """A mistake in a level, and its place."""

    source: str
    """The file, or another origin of the level."""
    line: int | None
    column: int | None
    """The position in the file, from 1; None if it has none."""
    path: str
    """The path in the level, such as `bodies.ball.mass`; empty for the level as a whole."""
    rule: Message
    """The mistake or the broken rule, with a suggestion if possible."""
    value: str = ""
    """The text at that place, as in the file; empty if it does not help."""

    def __str__(self) -> str:
        return str(self.message)

    @property
    def message(self) -> Message:
        """The whole mistake in one line, which can be translated."""
        place = f"{self.source}:{self.line}:{self.column}" if self.line else self.source
        return Message("{place}: {told}", place=place, told=self.unplaced)

    @property
    def unplaced(self) -> Message:
        """The mistake without its position in a file."""
        text = Message("{rule} (found {value})", rule=self.rule, value=self.value)
        text = text if self.value else self.rule
        return Message("{path}: {told}", path=self.path, told=text) if self.path else text


class LevelError(SandboxError):
    """A level that cannot be used, with all mistakes found in it."""

    def __init__(self, mistakes: tuple[Mistake, ...]) -> None:
        self.mistakes = mistakes
        super().__init__(joined((mistake.message for mistake in mistakes), "\n"))

    def __reduce__(self) -> tuple[type["LevelError"], tuple[tuple[Mistake, ...]]]:
        return type(self), (self.mistakes,)  # or Exception would rebuild it from its text


class MisuseError(SandboxError):
    """What cannot be done as it was asked for: wrong usage of a command."""

    exit_status = 2


class ValueRangeError(MisuseError):
    """A parameter that the level does not have, or a value that it cannot have."""


def brief(text: str, longest: int = 60) -> str:
    """Return content of a file, fit for a message: on one line, printable, and not too long."""
    shown = text if len(text) <= longest else f"{text[: longest - 1]}…"
    if shown.isprintable():
        return shown
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in shown)
