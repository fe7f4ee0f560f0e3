"""The families of hard cases, with a module for each."""

from collections.abc import Callable, Iterator, Mapping

from validation.stability.case import Frontier, HardCase
from validation.stability.families import (
    bounces,
    bullets,
    chains,
    compositions,
    cradles,
    dumbbells,
    exact,
    oscillators,
    piles,
    structures,
)
from validation.stability.scene import Document

SEARCHED = (
    cradles,
    oscillators,
    piles,
    structures,
    chains,
    bullets,
    compositions,
    dumbbells,
)
"""The families with frontiers."""

FAMILIES = (exact, bounces, *SEARCHED)


def all_cases() -> Iterator[HardCase]:
    """Yield the cases of all families."""
    for family in FAMILIES:
        yield from family.cases()


def all_frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of all families."""
    for family in SEARCHED:
        yield from family.frontiers()


def all_levels() -> Mapping[str, Callable[[], Document]]:
    """Return the functions that make levels of `levels/hard`, by file name.

    The others are written in their files alone: nothing makes them harder, and none of their
    numbers is computed.
    """
    return {name: make for family in FAMILIES for name, make in family.LEVELS.items()}
