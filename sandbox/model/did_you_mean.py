"""Suggestions for misspelt names."""

from collections.abc import Iterable
from difflib import get_close_matches

from sandbox.model.message import NOTHING, Message

LONGEST = 100  # characters; nothing longer resembles a name


def closest(name: str, known: Iterable[str]) -> str | None:
    """Return the known name that resembles the given one, if any does."""
    choices = {choice.casefold(): choice for choice in sorted(known)}
    close = get_close_matches(name[:LONGEST].casefold(), choices, n=1, cutoff=0.6)
    return choices[close[0]] if close else None


def meant(name: str, known: Iterable[str]) -> Message:
    """Return "; did you mean 'x'?" if a known name resembles the given one, else nothing."""
    close = closest(name, known)
    return Message("; did you mean '{close}'?", close=close) if close else NOTHING


def suggestion(name: str, known: Iterable[str], *, most: int = 8) -> Message:
    """Return the end of a message: the name that was probably meant, or all possible names."""
    choices = sorted(known)
    if hint := meant(name, choices):
        return hint
    if not choices:
        return Message("; there are none")
    shown = ", ".join(choices[:most]) + (", …" if len(choices) > most else "")
    return Message("; known: {shown}", shown=shown)
