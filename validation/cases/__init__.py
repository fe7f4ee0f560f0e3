"""The cases, one phenomenon a file. A new file joins by one line here."""

from collections.abc import Iterator

from validation.case import Case
from validation.cases import (
    atwood,
    atwood_push,
    belts,
    bounces,
    center_of_mass,
    changing_mass,
    circular_motion,
    circular_orbit,
    collisions,
    first_law,
    free_fall,
    free_rotation,
    given_forces,
    glancing,
    gravitation,
    incline,
    incline_limits,
    orbits,
    pendulums,
    projectile,
    rolling,
    second_and_third_law,
    springs,
    static_friction,
    table_pulley,
    throws,
    uniform_acceleration,
    wells,
    work,
)

PHENOMENA = (
    free_fall,
    projectile,
    uniform_acceleration,
    throws,
    circular_motion,
    first_law,
    second_and_third_law,
    changing_mass,
    atwood,
    atwood_push,
    incline,
    incline_limits,
    static_friction,
    table_pulley,
    belts,
    work,
    circular_orbit,
    orbits,
    gravitation,
    wells,
    collisions,
    glancing,
    center_of_mass,
    bounces,
    rolling,
    free_rotation,
    pendulums,
    springs,
    given_forces,
)


def all_cases() -> Iterator[Case]:
    """Yield every case of every phenomenon."""
    for phenomenon in PHENOMENA:
        yield from phenomenon.cases()
