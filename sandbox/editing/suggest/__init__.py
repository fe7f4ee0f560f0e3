"""Known set-ups, recognised in a level, and the closed forms that it may be held against.

A module a set-up; each has a function from a `Scene` to suggestions, and stands in the list here.
Nothing is suggested that the scene does not keep: where something is in the way, a check is about
a time before it is met.
"""

import json
from collections.abc import Callable, Iterator
from contextlib import suppress

from sandbox.editing.cleanup import without_meaning
from sandbox.editing.edits.checks import add_checks
from sandbox.editing.suggest import (
    capstan,
    collision,
    cradle,
    incline,
    lever,
    oscillator,
    pendulum,
    projectile,
    pulleys,
    spring_pendulum,
)
from sandbox.editing.suggest.scene import Scene, Suggestion
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
    spring_pendulum.suggestions,
    capstan.suggestions,
)


_OF_MANY: tuple[Callable[[Scene], Iterator[Suggestion]], ...] = (capstan.suggestions,)
"""Those that have many bodies, and are found by their joints."""

MOST_MOVING = 12
"""Up to how many moving bodies other set-ups are looked for."""


def suggestions(level: Level) -> list[Suggestion]:
    """Return the closed forms of the known set-ups that a level is, and does not check yet.

    In a crowd few are looked for: each body would be followed among all the others.
    """
    checked = {check.quantity for check in level.checks}
    found = _recognised(level)
    return [one for one in found if not {c["quantity"] for c in one.checks} <= checked]


def _recognised(level: Level, *, thorough: bool = False) -> list[Suggestion]:
    """Return the known set-ups that a level is."""
    crowd = sum(body.type == "dynamic" for body in level.bodies.values()) > MOST_MOVING
    scene = Scene(level, level.defaults, thorough)
    return [one for known in (_OF_MANY if crowd else _KNOWN) for one in known(scene)]


def followed(before: Level, text: str) -> str:
    """Return a changed level with its suggested checks updated.

    Those that were just as they would be suggested become as they would be suggested now, and go
    where their quantity no longer has a closed form; others stay as somebody made them.

    Parameters
    ----------
    before
        The level as it was.
    text
        The changed text, which may have mistakes.
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
            said, place = checks[index], ("checks", index)
            if said in old and said != (other := new.get(said["quantity"])):
                text = put(text, place, other) if other else without_meaning(remove(text, place))
    return text


def take(text: str, level: Level, suggestion: Suggestion) -> str:
    """Return a level with the checks of a suggestion, and with what else they need.

    Where they are about a time before something is met, that is before it for all values of the
    parameters.

    Raises
    ------
    LevelError
        If the loader refuses it.
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
