"""The levels of the report, chapter by chapter."""

from collections.abc import Callable, Iterable
from typing import Protocol, TypeVar

TITLES = {"newton": "Newton's laws", "lagrange": "Lagrangian mechanics"}
"""The titles of chapters that differ from the names of their folders."""

T = TypeVar("T")


def chapter(level: str) -> str:
    """Return the title of the chapter that a level belongs to."""
    folder = level.partition("/")[0]
    return TITLES.get(folder, folder.capitalize())


class OfLevel(Protocol):
    """Anything that belongs to a level."""

    @property
    def level(self) -> str:
        """The name of the level."""


def by_chapter(things: Iterable[T], whose: Callable[[T], OfLevel]) -> list[tuple[str, list[T]]]:
    """Group things by chapter, given the level of each."""
    groups: dict[str, list[T]] = {}
    for thing in things:
        groups.setdefault(chapter(whose(thing).level), []).append(thing)
    return list(groups.items())
