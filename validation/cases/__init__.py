"""The cases: a file of tables a phenomenon, and beside it what its formulas call `own`."""

from collections.abc import Iterator

from validation.case import Case
from validation.tables import read

PHENOMENA = (
    "free_fall", "projectile", "uniform_acceleration", "throws", "circular_motion", "first_law",
    "second_and_third_law", "changing_mass", "atwood", "atwood_push", "incline", "incline_limits",
    "static_friction", "table_pulley", "belts", "work", "circular_orbit", "orbits", "gravitation",
    "wells", "repulsion", "collisions", "glancing", "center_of_mass", "bounces", "cradles",
    "bumpers", "bursts", "sticking", "rolling", "hollows", "free_rotation", "wheels", "pendulums",
    "springs", "driven", "torques", "given_forces", "least_action", "chapter_code", "beads",
    "machines", "mechanisms",
)  # fmt: skip
"""The files of tables, in the order of the chapter."""


def all_cases() -> Iterator[Case]:
    """Yield every case of every phenomenon."""
    for phenomenon in PHENOMENA:
        yield from read(phenomenon)
