"""The cases, one phenomenon a file. A new file joins by one line here."""

from collections.abc import Iterator

from validation.case import Case
from validation.cases import (
    atwood,
    circular_orbit,
    collisions,
    free_fall,
    glancing,
    incline,
    projectile,
    table_pulley,
)

PHENOMENA = (
    free_fall,
    projectile,
    atwood,
    incline,
    table_pulley,
    collisions,
    glancing,
    circular_orbit,
)


def all_cases() -> Iterator[Case]:
    """Yield every case of every phenomenon."""
    for phenomenon in PHENOMENA:
        yield from phenomenon.cases()
