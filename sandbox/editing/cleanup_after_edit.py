"""Cleaning up after an edit: meaningless parts are removed, missing ones are declared."""

import json
from collections.abc import Iterable, Iterator

from sandbox.editing.json_spans import Spans
from sandbox.editing.text_patches import put_all, remove
from sandbox.model.effects import EFFECTS
from sandbox.model.errors import LevelError
from sandbox.model.events import ACTIONS
from sandbox.model.json_positions import Path
from sandbox.model.loading import parse

COEFFICIENTS = tuple(name for name, effect in EFFECTS.items() if effect.coefficient)
"""The coefficients that every body needs if the effect is declared; with 1, that of the pair is the
other body's."""

ROUNDS = 20
"""The most searches for meaningless parts; removing one can make another meaningless."""

_LISTS = ("pairs", "located", "bodies", *ACTIONS)
"""The lists in effects and events from which a single name can be removed."""


def is_valid(text: str) -> bool:
    """Return whether a text is a level without mistakes."""
    try:
        parse(text)
    except LevelError:
        return False
    return True


def first_valid(texts: Iterable[str], otherwise: str) -> str:
    """Return the first of some texts that is a level without mistakes, or another text."""
    return next(filter(is_valid, texts), otherwise)


def accepted(*texts: str) -> str:
    """Return the first of some texts that is a level without mistakes.

    Raises `LevelError` if there is none, with the mistakes of the first.
    """
    found = first_valid(texts, "")
    if not found:
        parse(texts[0])
    return found


def without_meaning(text: str) -> str:
    """Return a level without parts that refer to missing parts, or have no effect.

    Those are the joints, effects, events, checks, ghosts, goals and parameters that have a mistake.
    Other mistakes remain.
    """
    for _ in range(ROUNDS):
        try:
            parse(text)
            break
        except LevelError as error:
            found = Spans(text)
            places = [_place(mistake.path, found) for mistake in error.mistakes]
        units = {unit for place in places if (unit := _unit(place))}
        bare = {bare: 1 for place in places for bare in _missing(place, text)}
        if not (units or bare):
            break
        text = put_all(text, bare)
        for unit in sorted(units, key=_backwards, reverse=True):
            if unit in Spans(text):  # it may have been removed with another
                text = remove(text, unit)
    return text


def _place(message_path: str, found: Spans) -> Path:
    """Return the path of a mistake."""
    path: Path = ()
    for step in message_path.split("."):
        index = int(step) if step.isdecimal() else -1
        path = (*path, index if (*path, index) in found else step)
    return path


def _unit(path: Path) -> Path | None:
    """Return the path to remove because of a mistake at a path; None if there is none."""
    match path:
        case ("parameters" | "constants" | "checks" | "ghosts" | "joints", _, *_):
            return path[:2]
        case ("bodies", _, _, *_):
            return path[:3]
        case ("challenge", str(), str() | int(), *_):
            return path[:3]
        case ("challenge", *_):
            return path[:1]
        case ("effects" | "events" | "view", _, *_):
            return _part(path)
    return None


def _part(path: Path) -> Path:
    """Return what to remove in an effect, an event or the view: a name, an item, or all."""
    match path:
        case ("effects", "contact", "apart", int(), *_):
            return path[:5]
        case ("view", "together", int(), *_):
            return path[:4]
        case ("effects" | "events", _, str() as part, int(), *_) if part in _LISTS:
            return path[:4]
        case ("effects", _, int(), *_):
            return path[:3]
    return path[:2]


def _missing(path: Path, text: str) -> Iterator[Path]:
    """Yield the coefficients that a body had only in a pair, and now needs by itself."""
    if len(path) == 2 and path[0] == "bodies":
        data = json.loads(text)
        body = data["bodies"][path[1]]
        yield from (
            (*path, kind) for kind in COEFFICIENTS if kind in data["effects"] and kind not in body
        )


def _backwards(path: Path) -> tuple[tuple[bool, str | int], ...]:
    """Return a sort key by which later items of a list follow earlier ones."""
    return tuple((isinstance(step, int), step) for step in path)
