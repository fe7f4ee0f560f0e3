"""Random levels, some of them with parts in shorthand: repeats, groups and copies of them."""

from collections.abc import Sequence
from copy import deepcopy
from random import Random
from typing import Any

from sandbox.model.shorthand.repeated_members import GROUPS, REPEAT
from validation.fuzz.mutated_levels import mutated, places
from validation.fuzz.schema_grammar import Grammar

Document = dict[str, Any]

BOUNDS: Sequence[Any] = (
    1, 2, 3, 2, 3, [1, 3], [0, 2], [-1, 1], [3, 1], "{i}", "{i + 1}", ["{i}", 4],
    0, -1, 10**18, [1, 10**6], "{1/0}", "{p}", "{k}", [0.5, 2], ["{10**9}", "{10**9 + 1}"],
)  # fmt: skip
"""The last values of indices, or their first and last ones, most of them allowed."""

NUMBERS: Sequence[str] = ("{0} + {{i}}", "{0} + 2*{{i}}/3", "{{i}}", "{0}*{{i - 1}}**2", "{{-i}}")
"""What a number becomes in a part that is repeated."""

REPEATS = (0, 0, 1, 1, 2, 4)

SHORT = 0.2
"""The probability that a level has shorthand which it did not have."""


def drawn_level(random: Random, *, changed: bool) -> Document:
    """Return a level from the schema, or a changed one of the catalog."""
    level = mutated(random) if changed else Grammar(random).level()
    return shortened(random, level) if random.random() < SHORT else level


def shortened(random: Random, level: Document) -> Document:
    """Return a level in which some members are repeated, or all bodies may be copies of a group."""
    if random.random() < 0.3 and isinstance(level.get("bodies"), dict):
        _group(random, level)
    for _ in range(random.choice(REPEATS)):
        inner = [(part, key) for part, key in places(level) if part is not level]
        if inner:
            _repeat(random, *random.choice(inner))
    return level


def _group(random: Random, level: Document) -> None:
    """Move bodies and joints into a group, and place copies of it."""
    group = {"bodies": level["bodies"]}
    if random.random() < 0.5 and "joints" in level:
        group["joints"] = level.pop("joints")
    level[GROUPS] = {"g": group}
    turns = random.choice(({}, {"angle": "p/2"}, {"angle": 1}))
    copies: Document = {
        name: {"copy": "g", "position": [10 * number, random.choice((0, "p", 1e-9))], **turns}
        for number, name in enumerate(("c", "d", "")[: random.choice((1, 2, 3))])
    }
    if random.random() < 0.3:
        copies = {"c{i}": {"copy": "g", "position": ["9*{i}", 0], REPEAT: _bounds(random)}}
    level["bodies"] = copies


def _repeat(random: Random, part: Any, key: Any) -> None:  # noqa: ANN401 (whatever JSON holds)
    """Repeat the member at a place, with other numbers in each of its copies."""
    value = part[key]
    for inside, step in list(places(value)):
        if isinstance(inside[step], int | float) and random.random() < 0.3:
            inside[step] = random.choice(NUMBERS).format(inside[step])
    if isinstance(part, list):
        part[key] = {REPEAT: _bounds(random), "each": value}
    elif isinstance(value, dict):
        del part[key]
        part[f"{key}{random.choice(('{i}', '{i}', '{i + 1}', '', '{i/2}'))}"] = {
            REPEAT: _bounds(random),
            **value,
        }


def _bounds(random: Random) -> Document:
    """Return the indices of a repeat."""
    names = random.choice((("i",), ("i",), ("i", "j"), ("j", "i"), ("i", "j", "k"), ("p",)))
    return {name: deepcopy(random.choice(BOUNDS)) for name in names}
