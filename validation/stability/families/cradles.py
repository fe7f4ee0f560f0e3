"""Newton's cradle with balls that touch."""

from collections.abc import Iterator

import numpy as np

from validation.stability.hard_case import Frontier, HardCase
from validation.stability.run_measures import Run, energy
from validation.stability.scene_parts import MOMENTUM, Document, check, disc, level

RADIUS = 0.1  # m
LEAVE = (
    "as many leave as came, with the same speed: the outcome of one impact after another between"
    " equal balls"
)


def cradle(count: int, coming: int = 1, gap: float = 0.0) -> Document:
    """Return a row of balls that others hit at 1 m/s."""
    balls: Document = {}
    for i in range(count):
        comes = i < coming
        place = i * (2 * RADIUS + gap) - (0.5 if comes else 0), 0.0
        balls[f"ball{i + 1}"] = disc(place, RADIUS, velocity=[float(comes), 0.0], restitution=1)
    return level(
        f"A cradle of {count} balls",
        "Balls in a row touch each other. As many must leave as arrive.",
        MOMENTUM,
        effects={"contact": {}, "restitution": {"impacts": "sequence"}},
        bodies=balls,
        stepping={"rate": 240},
        duration=1,
        checks=[
            check(f"ball{count}.velocity.x", 1, 1e-9, "velocity of the last ball", at=0.9),
            check("ball1.velocity.x", 0, 1e-9, "velocity of the first ball", at=0.9),
        ],
        view={"center": [count * RADIUS, 0], "width": 2.6 * count * RADIUS + 1},
    )


def velocity_error(run: Run) -> float:
    """Return the largest error of the final velocities from the mirrored initial ones [m/s]."""
    velocity = run.states.velocity
    return float(np.abs(velocity[-1, :, 0] - velocity[0, ::-1, 0]).max())


LEVELS = {"cradle-of-50": lambda: cradle(50), "cradle-of-five": lambda: cradle(5, 2)}


def cases() -> Iterator[HardCase]:
    """Yield the cradles."""
    for coming in (1, 2, 3):
        for gap in (0.0, 1e-9):
            yield HardCase(
                name=f"a cradle of five, {coming} in, gap {gap:g} m", group="A",
                level="hard/cradle-of-five", criterion=LEAVE, figure=velocity_error, bound=1e-6,
                duration=0.9, scene=cradle(5, coming, gap),
            )  # fmt: skip
    yield HardCase(
        name="a cradle of 50 balls that touch", group="D",
        level="hard/cradle-of-50", criterion=LEAVE, figure=velocity_error, bound=1e-6, duration=0.9,
    )  # fmt: skip
    yield HardCase(
        name="a hanging cradle of 20: energy", group="C",
        level="hard/hanging-cradle",
        criterion="leapfrog's energy swings with (ω dt)²/8: below 1e-3 of the kinetic",
        figure=energy, bound=1e-3, duration=20, quick=2,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontier of a cradle's length."""
    yield Frontier(
        name="a cradle that touches", axis="balls", whole=True,
        scene=lambda n: cradle(round(n)), figure=velocity_error, bound=1e-6, criterion=LEAVE,
        start=2, end=50, duration=0.9,
    )  # fmt: skip
