"""The cases: a file of tables for each phenomenon."""

from collections.abc import Iterator
from pathlib import Path

from validation.case import Case
from validation.case_loading import read

_ORDER = (
    "free_fall", "projectile", "uniform_acceleration", "throws", "circular_motion", "first_law",
    "second_and_third_law", "changing_mass", "atwood", "atwood_push", "incline", "incline_limits",
    "static_friction", "table_pulley", "belts", "work", "circular_orbit", "orbits", "gravitation",
    "wells", "repulsion", "collisions", "glancing", "center_of_mass", "bounces", "cradles",
    "bumpers", "bursts", "sticking", "rolling", "hollows", "free_rotation", "wheels", "pendulums",
    "springs", "driven", "torques", "given_forces", "least_action", "chapter_code", "beads",
    "machines", "holding_and_slipping", "mechanisms",
)  # fmt: skip
_FOUND = {path.stem for path in Path(__file__).parent.glob("*.toml")}

PHENOMENA = (*_ORDER, *sorted(_FOUND.difference(_ORDER)))
"""The files of tables, in the order of the chapter; any others follow by name."""


def all_cases() -> Iterator[Case]:
    """Yield every case of every phenomenon."""
    for phenomenon in PHENOMENA:
        yield from read(phenomenon)
