"""Bullets: bodies that move further in a step than the width of their target."""

from collections.abc import Iterator

from validation.stability.hard_case import Frontier, HardCase
from validation.stability.run_measures import Run, measured
from validation.stability.scene_parts import MOMENTUM, Document, block, check, disc, level

RADIUS = 0.05  # m
WALL = 0.1  # m


def shot(times: float, rate: float = 240) -> Document:
    """Return a ball that moves a number of its diameters per step towards a thin wall."""
    speed = times * (2 * RADIUS + WALL) * rate
    return level(
        f"A bullet of {times:g} widths a step",
        "A fast ball flies at a wall as thin as the ball itself, and must not pass through it.",
        MOMENTUM,
        effects={"contact": {"located": ["bullet"]}, "restitution": {}},
        bodies={
            "bullet": disc((-2.5 * speed / rate, 0), RADIUS, velocity=[speed, 0], restitution=1),
            "wall": block((WALL / 2 + RADIUS, 0), WALL, 4, restitution=1),
        },
        stepping={"rate": rate},
        duration=5 / rate,
        checks=[check("bullet.speed", speed, 1e-9, "speed")],
        view={"center": [0, 0], "width": 6 * speed / rate + 1},
    )


def has_passed(run: Run) -> float:
    """Return 1 if a bullet still flies on at the end, else 0."""
    return float(measured(run, "bullet.velocity.x")[-1] > 0)


LEVELS = {"bullet-at-0.9": lambda: shot(0.9), "bullet-at-10": lambda: shot(10)}


def cases() -> Iterator[HardCase]:
    """Yield the bullets."""
    yield HardCase(
        name="a bullet of 0.9 widths a step", group="C", level="hard/bullet-at-0.9",
        criterion="it comes back from the wall, whatever it was into it", figure=has_passed,
        bound=0, every_step=True,
    )  # fmt: skip
    yield HardCase(
        name="a bullet of 10 widths a step", group="D", level="hard/bullet-at-10",
        criterion="it comes back from the wall", figure=has_passed, bound=0, every_step=True,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontier of a bullet's speed."""
    yield Frontier(
        name="the speed of a bullet", axis="widths a step", scene=shot,
        figure=has_passed, bound=0, criterion="it comes back from the wall", start=0.1, end=1e4,
        duration=5 / 240,
    )  # fmt: skip
