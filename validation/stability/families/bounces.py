"""Bounces: balls, boxes and gases that conserve energy, and balls that lose the right amount."""

from collections.abc import Iterator

import numpy as np

from validation.stability.hard_case import HardCase
from validation.stability.run_measures import Run, energy, measured
from validation.stability.scene_parts import G

DROP = 5.0  # m, of the balls in all levels here
RADIUS = 0.1  # m


def mean_square(run: Run) -> float:
    """Return the mean of (E − E0)² over the run and the balls [J²]."""
    total = measured(run, "system.energy") / 49
    return float(np.mean((total - total[0]) ** 2))


def escaped(run: Run) -> float:
    """Return the number of bodies outside the walls."""
    out = np.abs(run.states.position).max(axis=(0, 2)) > 3.0
    return float(out.sum())


def apexes(run: Run) -> float:
    """Return the error of each of the first four apexes: e², e⁴, e⁶, e⁸ times the height.

    In flight, y + v²/(2 g) is the height of the next apex at every step.
    """
    e = run.level.bodies["floor"].restitution
    assert e is not None
    y, v = measured(run, "ball.position.y") - RADIUS, measured(run, "ball.velocity.y")
    bounced = np.flatnonzero((v[1:] > 0) & (v[:-1] <= 0)) + 1
    heights = (y + v**2 / (2 * G))[bounced[:4] + 1]
    expected = DROP * e({}) ** (2 * np.arange(1, 5))
    if len(heights) < len(expected):
        return float("inf")
    return float(np.abs(heights / expected - 1).max())


KEEPS = "elastic impacts keep the energy, to rounding"


def cases() -> Iterator[HardCase]:
    """Yield the bounces that must hold."""
    for rate in (60, 240):
        yield HardCase(
            name=f"an elastic ball, 20 s at {rate} Hz", group="A",
            level="hard/elastic-ball", criterion=KEEPS, figure=energy, bound=1e-10, duration=20,
            rate=rate, every_step=True,
        )  # fmt: skip
    yield HardCase(
        name="SimBenchmark: bouncing", group="A", level="hard/49-elastic-balls",
        criterion="mean of (E - E0)² [J²]; RaiSim publishes 1.9e-2, ODE 185, Bullet 7.5e4",
        figure=mean_square, bound=1e-6, duration=20, quick=4, every_step=True,
    )  # fmt: skip
    yield HardCase(
        name="a tumbling elastic box", group="A", level="hard/tumbling-box",
        criterion=KEEPS, figure=energy, bound=1e-10, duration=10, quick=5, every_step=True,
    )  # fmt: skip
    yield HardCase(
        name="a gas of 60 elastic balls: energy", group="A", level="hard/gas-of-60",
        criterion=KEEPS, figure=energy, bound=1e-10, duration=20, quick=5,
    )  # fmt: skip
    yield HardCase(
        name="a gas of 60 elastic balls: none escapes", group="A",
        level="hard/gas-of-60", criterion="balls that have left the walls", figure=escaped,
        bound=0, duration=20, quick=5,
    )  # fmt: skip
    for e, name in ((0.5, "ball-of-half"), (0.8, "ball-of-four-fifths")):
        yield HardCase(
            name=f"four apexes of restitution {e:g}", group="B",
            level=f"hard/{name}",
            criterion="e² of the last height each time; naive pymunk at 60 Hz: 0.208 for 0.25",
            figure=apexes, bound=1e-6, duration=4 if e == 0.5 else 6, every_step=True,
        )  # fmt: skip
