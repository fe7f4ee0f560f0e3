"""Iteration over the parts of a level."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple, Self

from sandbox.model.contained_expressions import expressions as walk
from sandbox.model.json_positions import Path
from sandbox.model.last_result_cache import of_the_last
from sandbox.model.level import Check, Level
from sandbox.model.measuring_instants import Instant
from sandbox.model.translatable_message import Message, message

if TYPE_CHECKING:
    from sandbox.model.challenge import Goal
    from sandbox.model.expressions import Expression


class _Fault(NamedTuple):
    path: Path
    rule: Message


class Fault(_Fault):
    """A mistake in a level: its path, and a message, or the template of one and its values."""

    __slots__ = ()

    def __new__(cls, path: Path, rule: str, /, **values: object) -> Self:
        """Make a fault; a rule with values is the template of its message."""
        return super().__new__(cls, path, message(rule, values))


def expressions(part: object, path: Path = ()) -> "Iterator[tuple[Path, Expression]]":
    """Yield every expression in a level or a part of it, with its path."""
    return iter(_all_of(part)) if isinstance(part, Level) and not path else walk(part, path)


@of_the_last
def _all_of(level: Level) -> "Sequence[tuple[Path, Expression]]":
    """Return every expression of a level, cached because several rules need them."""
    return list(walk(level))


def measured(level: Level) -> Iterator[tuple[Path, "Check | Goal"]]:
    """Yield every check and goal, with its path."""
    for index, check in enumerate(level.checks):
        yield ("checks", index), check
    if level.challenge is None:
        return
    for index, goal in enumerate(level.challenge.goals):
        yield ("challenge", "goals", index), goal
    for index, goal in enumerate(level.challenge.stars):
        yield ("challenge", "stars", index), goal


def instants(level: Level) -> Iterator[tuple[Path, Instant]]:
    """Yield every instant at which something is measured, with its path."""
    yield from (((*path, "at"), one.at) for path, one in measured(level) if one.at is not None)


def names_in(part: object) -> frozenset[str]:
    """Return the names in the expressions of a part of a level."""
    return frozenset().union(*(expression.names for _, expression in expressions(part)))
