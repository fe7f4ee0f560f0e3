"""Known set-ups, recognised in a level, and the closed forms that it may be held against.

A module a set-up; each has a function from a `Scene` to suggestions, and stands in the list here.
Nothing is suggested that the scene does not keep: where something is in the way, a check is about
a time before it is met.
"""

from collections.abc import Callable, Iterator

from sandbox.editing.edits.checks import add_checks
from sandbox.editing.suggest import atwood, collision, incline, oscillator, pendulum, projectile
from sandbox.editing.suggest.scene import Scene, Suggestion
from sandbox.editing.text_patches import Changes
from sandbox.model.level import Level

_KNOWN: tuple[Callable[[Scene], Iterator[Suggestion]], ...] = (
    atwood.suggestions,
    incline.suggestions,
    pendulum.suggestions,
    collision.suggestions,
    projectile.suggestions,
    oscillator.suggestions,
)


MOST_MOVING = 12
"""How many bodies may move where a set-up is looked for; those that are known have a few."""


def suggestions(level: Level) -> list[Suggestion]:
    """Return the closed forms of the known set-ups that a level is, and does not check yet.

    In a crowd nothing is looked for: each body would be followed among all the others.
    """
    if sum(body.type == "dynamic" for body in level.bodies.values()) > MOST_MOVING:
        return []
    scene = Scene(level, level.defaults)
    checked = {check.quantity for check in level.checks}
    found = (one for known in _KNOWN for one in known(scene))
    return [one for one in found if not {c["quantity"] for c in one.checks} <= checked]


def take(text: str, level: Level, suggestion: Suggestion) -> str:
    """Return a level with the checks of a suggestion, and with the rate that they need.

    Raises
    ------
    LevelError
        If the loader refuses it.
    """
    besides = Changes()
    if level.stepping.accuracy is None and level.stepping.rate < suggestion.rate:
        besides["stepping", "rate"] = suggestion.rate
    return add_checks(text, level, suggestion.checks, besides)
