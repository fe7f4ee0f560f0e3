"""Known set-ups, recognised in a level, and their closed forms as checks.

Each set-up has a module with a function from a `Scene` to suggestions, which is listed here. Only
checks that the scene fulfils are suggested: if something is in the way, a check is at a time before
it is met.
"""

import json
from collections.abc import Callable, Iterator
from contextlib import suppress

from sandbox.editing.cleanup_after_edit import without_meaning
from sandbox.editing.edits.checks_and_ghosts import add_checks
from sandbox.editing.suggested_checks import (
    capstan,
    collision,
    cradle,
    incline,
    lever,
    oscillator,
    pendulum,
    projectile,
    pulleys,
)
from sandbox.editing.suggested_checks.recogniser_input import Scene, Suggestion
from sandbox.editing.text_patches import Changes, put, remove
from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.model.loading import parse

_KNOWN: tuple[Callable[[Scene], Iterator[Suggestion]], ...] = (
    pulleys.suggestions,
    incline.suggestions,
    lever.suggestions,
    pendulum.suggestions,
    cradle.suggestions,
    collision.suggestions,
    projectile.suggestions,
    oscillator.suggestions,
    capstan.suggestions,
)


_OF_MANY: tuple[Callable[[Scene], Iterator[Suggestion]], ...] = (capstan.suggestions,)
"""The set-ups of many bodies, which are found by their joints."""

MOST_MOVING = 12
"""The largest number of moving bodies among which other set-ups are searched."""


def suggestions(level: Level) -> list[Suggestion]:
    """Return the closed forms of the known set-ups in a level that it does not check yet.

    Among many bodies only a few set-ups are searched, as each body is followed among all others.
    """
    checked = {check.quantity for check in level.checks}
    found = _recognised(level)
    return [one for one in found if not {c["quantity"] for c in one.checks} <= checked]


def _recognised(level: Level, *, thorough: bool = False) -> list[Suggestion]:
    """Return the known set-ups in a level."""
    crowd = sum(body.type == "dynamic" for body in level.bodies.values()) > MOST_MOVING
    scene = Scene(level, level.defaults, thorough)
    return [one for recogniser in (_OF_MANY if crowd else _KNOWN) for one in recogniser(scene)]


def with_updated_checks(before: Level, text: str) -> str:
    """Return a changed level with its suggested checks updated.

    Checks that equal the former suggestions are replaced by the present ones, and removed if their
    quantity no longer has a closed form. Checks that a person has changed stay. The text may have
    mistakes.
    """
    if not before.checks:
        return text
    with suppress(LevelError):
        after = parse(text)
        old = [check for one in _recognised(before, thorough=True) for check in one.checks]
        now = _recognised(after, thorough=True) if old else []
        new = {check["quantity"]: check for one in now for check in one.checks}
        checks = json.loads(text).get("checks", [])
        for index in reversed(range(len(checks))):
            old_check, place = checks[index], ("checks", index)
            if old_check in old and old_check != (other := new.get(old_check["quantity"])):
                text = put(text, place, other) if other else without_meaning(remove(text, place))
    return text


def with_suggestion(text: str, level: Level, suggestion: Suggestion) -> str:
    """Return a level with the checks of a suggestion, and the rate and located bodies they need.

    If a check is at a time before something is met, this holds for all values of the parameters.
    Raises `LevelError` if the loader refuses it.
    """
    wanted = suggestion.setup, suggestion.about
    everywhere = (
        one for one in _recognised(level, thorough=True) if (one.setup, one.about) == wanted
    )
    suggestion = next(everywhere, suggestion)
    besides = Changes()
    if level.stepping.accuracy is None and level.stepping.rate < suggestion.rate:
        besides["stepping", "rate"] = suggestion.rate
    located = level.effects.contact.located if level.effects.contact else None
    if not set(suggestion.located) <= set(located or ()):
        together = dict.fromkeys((*(located or ()), *suggestion.located))
        besides["effects", "contact", "located"] = list(together)
    return add_checks(text, level, suggestion.checks, besides)
