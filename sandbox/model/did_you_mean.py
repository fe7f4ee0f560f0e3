"""Suggestions for misspelt names."""

from collections.abc import Iterable
from difflib import get_close_matches

from sandbox.model.message import NOTHING, Message
from sandbox.model.synonyms import called

LONGEST = 100  # characters; nothing longer resembles a name

TYPED, ALIKE = 0.85, 0.6
"""The likeness of a name with a typing error, and the least likeness that counts. Words that mean
the same come in between."""


def closest(name: str, known: Iterable[str]) -> str | None:
    """Return the known name that a name stands for elsewhere, or else resembles, if any."""
    choices = {choice.casefold(): choice for choice in sorted(known)}
    name = name[:LONGEST].casefold()
    found = (
        *get_close_matches(name, choices, n=1, cutoff=TYPED),
        *called(name, choices),
        *get_close_matches(name, choices, n=1, cutoff=ALIKE),
    )
    return choices[found[0]] if found else None


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
