"""Dumbbells: two bodies on a rod that bounce as one."""

from collections.abc import Iterator
from math import cos, inf, radians, sin

import numpy as np

from sandbox.model.expressions import Array
from validation.formulas.assorted_mechanics_problems import dumbbell_bounce
from validation.stability.hard_case import Frontier, HardCase
from validation.stability.run_measures import Run, mass, rows
from validation.stability.scene_parts import (
    MOMENTUM,
    Document,
    block,
    check,
    disc,
    level,
    rod,
    text_of,
)

RATE = 160.0  # Hz
FALL = 1.0  # m/s

BOUNCED = 3 / RATE
"""The duration of a run [s]; the impact comes after half of it."""

BOUNCES = 1e-10  # m/s
AS_ONE = "the ends leave the floor as those of one rigid body, to 1e-10 of the speed of the fall"

DUMBBELLS = ((20, 1.0, True), (35, 0.6, False), (70, 0.3, True), (10, 0.0, False), (85, 0.8, True))
"""The angle [°], the restitution, and whether the upper end is the heavy one."""


def dumbbells(ratio: float) -> Document:
    """Return slanted dumbbells of 1 m that fall on a smooth floor, with one end heavier."""
    bodies: Document = {"ground": block((0, -0.5), 20, 1, restitution=1)}
    joints: Document = {}
    momentum = 0.0
    for i, (degrees, e, top_heavy) in enumerate(DUMBBELLS, start=1):
        masses = (1.0, ratio) if top_heavy else (ratio, 1.0)  # kg, of the lower and the upper end
        x, y, angle = 3.0 * (i - 3), 0.1 + FALL * BOUNCED / 2, radians(degrees)
        ends = (x, y), (x + cos(angle), y + sin(angle))
        for name, place, heavy in zip(("low", "high"), ends, masses, strict=True):
            bodies[f"{name}{i}"] = disc(place, 0.1, heavy, velocity=[0, -FALL], restitution=e)
        joints[f"rod{i}"] = rod(f"low{i}", f"high{i}")
        momentum += sum(masses) * dumbbell_bounce(masses, angle, FALL, e)[1]
    return level(
        f"Dumbbells of {text_of(ratio)} : 1",
        "Tilted dumbbells fall on a smooth floor, and each must bounce as one rigid body.",
        MOMENTUM,
        effects={"contact": {}, "restitution": {}},
        bodies=bodies,
        joints=joints,
        stepping={"rate": RATE},
        duration=0.25,
        checks=[
            check("system.momentum.y", momentum, 1e-9, "momentum after the bounces", at=2 / RATE)
        ],
        view={"center": [0.5, 1], "width": 16},
    )


def misses(run: Run) -> float:
    """Return the error of a dumbbell's motion after its impact, relative to a rigid body's [m/s].

    It is the largest, at the first instant after the impact, of the error of the centre of mass's
    velocity and that of the spin times the length of 1 m.
    """
    return max(_misses(run, i) for i in range(1, len(DUMBBELLS) + 1))


def _misses(run: Run, number: int) -> float:
    degrees, e, _ = DUMBBELLS[number - 1]
    low, high = f"low{number}", f"high{number}"
    ends = rows(run, low, high)
    place, velocity = run.states.position[:, ends], run.states.velocity[:, ends]
    after = np.flatnonzero(velocity[:, 0, 1] > -FALL / 2)
    if not len(after):
        return inf
    masses = mass(run, low), mass(run, high)
    spin, rise = dumbbell_bounce(masses, radians(degrees), FALL, e)
    found = _motion(place[after[0]], velocity[after[0]], masses)
    return float(np.abs(found - (0.0, rise, spin)).max())


def _motion(place: Array, velocity: Array, masses: tuple[float, float]) -> Array:
    """Return the velocity of the centre of mass and the spin of two ends: (3,)."""
    (along, up), (dx, dy) = place[1] - place[0], velocity[1] - velocity[0]
    spin = (along * dy - up * dx) / (along**2 + up**2)
    return np.array([*(masses @ velocity / sum(masses)), spin])


LEVELS = {"dumbbells": lambda: dumbbells(1e6)}


def cases() -> Iterator[HardCase]:
    """Yield the dumbbells."""
    yield HardCase(
        name="dumbbells of 1,000,000 : 1", group="A", level="hard/dumbbells",
        criterion=AS_ONE, figure=misses, bound=BOUNCES, duration=BOUNCED, every_step=True,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield how unequal the ends of a dumbbell may be."""
    yield Frontier(
        name="a dumbbell that bounces", axis="mass ratio", scene=dumbbells,
        figure=misses, bound=BOUNCES, criterion=AS_ONE, start=1, end=1e6, duration=BOUNCED,
    )  # fmt: skip
