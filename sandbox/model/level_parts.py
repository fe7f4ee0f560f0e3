"""Walks through the parts of a level."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sandbox.model.json_positions import Path
from sandbox.model.last_result_cache import of_the_last
from sandbox.model.level import Check, Level
from sandbox.model.measuring_instants import Instant
from sandbox.model.message import Message
from sandbox.model.traversal import expressions as walk

if TYPE_CHECKING:
    from sandbox.model.challenge import Goal
    from sandbox.model.expressions import Expression


class Fault(NamedTuple):
    """Something wrong with a level: where, and what."""

    path: Path
    rule: Message


def expressions(part: object, path: Path = ()) -> "Iterator[tuple[Path, Expression]]":
    """Yield every expression below a part of a level, or in all of it, with the path to it."""
    return iter(_all_of(part)) if isinstance(part, Level) and not path else walk(part, path)


@of_the_last
def _all_of(level: Level) -> "Sequence[tuple[Path, Expression]]":
    """Return every expression of a level: several rules ask for all of them."""
    return list(walk(level))


def measured(level: Level) -> Iterator[tuple[Path, "Check | Goal"]]:
    """Yield whatever is measured to judge a run, checks and goals, with the path to it."""
    for index, check in enumerate(level.checks):
        yield ("checks", index), check
    if level.challenge is None:
        return
    for index, goal in enumerate(level.challenge.goals):
        yield ("challenge", "goals", index), goal
    for index, goal in enumerate(level.challenge.stars):
        yield ("challenge", "stars", index), goal


def instants(level: Level) -> Iterator[tuple[Path, Instant]]:
    """Yield every time and event at which something is measured, with the path to it."""
    yield from (((*path, "at"), one.at) for path, one in measured(level) if one.at is not None)


def names_in(part: object) -> frozenset[str]:
    """Return the names that the expressions below a part of a level use."""
    return frozenset().union(*(expression.names for _, expression in expressions(part)))
