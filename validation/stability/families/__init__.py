"""The families of hard cases, with a module for each."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from types import ModuleType

from validation.stability.families import (
    bounces,
    bullets,
    chains,
    contact_and_joint_coupling,
    converging_motions,
    cradles,
    dumbbells,
    exact_to_rounding,
    piles,
    structures,
)
from validation.stability.hard_case import Frontier, HardCase
from validation.stability.scene_parts import Document

SEARCHED = (
    cradles,
    converging_motions,
    piles,
    structures,
    chains,
    bullets,
    contact_and_joint_coupling,
    dumbbells,
)
"""The families with frontiers."""

FAMILIES = (exact_to_rounding, bounces, *SEARCHED)


def all_cases() -> Iterator[HardCase]:
    """Yield the cases of all families."""
    for family in FAMILIES:
        yield from (replace(case, family=_name(family)) for case in family.cases())


def all_frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of all families."""
    for family in SEARCHED:
        yield from (replace(each, family=_name(family)) for each in family.frontiers())


def _name(family: ModuleType) -> str:
    return family.__name__.rpartition(".")[2]


def all_levels() -> Mapping[str, Callable[[], Document]]:
    """Return the functions that make levels of `levels/hard`, by file name.

    The others are in their files alone: nothing makes them harder.
    """
    return {name: make for family in SEARCHED for name, make in family.LEVELS.items()}
