"""Piles: stacks, pyramids, heavy boxes on light ones, and overlaps at the start."""

from collections.abc import Iterator

import numpy as np

from validation.stability.hard_case import Frontier, HardCase
from validation.stability.run_measures import Run, drift
from validation.stability.scene_parts import (
    NEWTON,
    WATCHED,
    Document,
    box,
    check,
    ground,
    level,
    pile,
    text_of,
)

RESTS = 0.01  # m
WITHIN = f"no box of 1 m moves by {RESTS * 100:g} cm: where forces balance, nothing moves"

SINKS = 0.05  # m
PARTS = 0.5  # m


def stack(count: int, heaviest: float = 1.0, rate: float = 2000, iterations: int = 4) -> Document:
    """Return boxes of 1 kg on top of each other, with another mass for the highest [kg]."""
    last = count - 1
    boxes = {
        f"box{i + 1}": box((0, i + 0.5), 1.0, 1.0, heaviest if i == last else 1.0, friction=1)
        for i in range(count)
    }
    top, many = f"box{count}", f"{last} boxes" if last > 1 else "one box"
    return level(
        f"A stack of {count} boxes" if heaviest == 1 else f"{text_of(heaviest)} : 1 on {many}",
        "A stack of boxes must stand still.",
        NEWTON,
        effects=pile(1.0),
        bodies={**boxes, "ground": ground(10.0)},
        stepping={"rate": rate, "iterations": iterations},
        duration=min(5, WATCHED / rate),
        checks=[
            check(f"{top}.position.y", count - 0.5, RESTS, "height of the top box"),
            check(f"{top}.position.x", 0, RESTS, "lean of the stack"),
        ],
        view={"center": [0, count / 2], "width": 2.4 * count},
    )


def pyramid(overlap: float, rows: int = 4) -> Document:
    """Return a pyramid of boxes of 1 m that overlap by a share of that."""
    apart = 1 - overlap
    boxes: Document = {}
    for row in range(rows):
        for i in range(rows - row):
            place = (i - (rows - row - 1) / 2) * apart, 0.5 + row * apart
            boxes[f"box{row + 1}_{i + 1}"] = box(place, 1.0, 1.0, friction=1)
    return level(
        f"Boxes that overlap by {overlap:.0%}",
        "Boxes that overlap at the start must separate gently.",
        NEWTON,
        effects=pile(1.0, overlaps=True),
        bodies={**boxes, "ground": ground(float(rows))},
        stepping={"rate": 480},
        duration=3,
        checks=[check(f"box{rows}_1.position.x", 0, 1, "horizontal position, within a metre")],
        view={"center": [0.0, rows / 2], "width": 2.0 * rows},
    )


def apex_displacement(run: Run) -> float:
    """Return the distance of an apex from its place at the end [m]."""
    rows = 6
    names = list(run.level.bodies)
    apexes = [names.index(f"box{k}_{rows}_1") for k in (1, 2, 3)]
    return float(np.abs(run.states.position[-1, apexes, 1] - (rows - 0.5)).max())


def greatest_height(run: Run) -> float:
    """Return the greatest height of a box above a pyramid that has parted [m]."""
    rows = max(int(name[3:].split("_")[0]) for name in run.level.bodies if name != "ground")
    return float(run.states.position[..., 1].max() - (rows - 0.5))


LEVELS = {
    "stack-of-15": lambda: stack(15),
    "stack-of-20": lambda: stack(20),
    "100-on-one": lambda: stack(2, 100),
    "1000-on-one": lambda: stack(2, 1e3),
    "10000-on-one": lambda: stack(2, 1e4, 10_000, 100),
    "100-on-five": lambda: stack(6, 100),
    "1000-on-five": lambda: stack(6, 1e3, 4000, 10),
    "10000-on-five": lambda: stack(6, 1e4, 8000, 10),
    "deep-overlap": lambda: pyramid(0.25),
}


def cases() -> Iterator[HardCase]:
    """Yield the piles that must stand."""
    yield from _stacks()
    yield from _pyramids()


def _stacks() -> Iterator[HardCase]:
    for name, about in {
        "stack-of-15": "a stack of 15 boxes, 20 s",
        "stack-of-20": "a stack of 20 boxes, 20 s",
        "100-on-one": "100 : 1 on one box",
        "1000-on-one": "1000 : 1 on one box",
        "10000-on-one": "10,000 : 1 on one box",
        "100-on-five": "100 : 1 on five boxes",
        "1000-on-five": "1000 : 1 on five boxes",
        "10000-on-five": "10,000 : 1 on five boxes",
    }.items():
        yield HardCase(
            name=about, group="C", level=f"hard/{name}", criterion=WITHIN,
            figure=drift, bound=RESTS, duration=20, quick=5,
        )  # fmt: skip
    yield HardCase(
        name="boxes of 5 mm", group="C", level="hard/tiny-stack", duration=10,
        criterion="no box moves by a hundredth of its size", figure=drift, bound=RESTS * 0.005,
        quick=5,
    )  # fmt: skip
    yield HardCase(
        name="a stack of 15 boxes for an hour", group="C", level="hard/stack-of-15",
        criterion=WITHIN, figure=drift, bound=RESTS, duration=3600, quick=60, rate=1000,
    )  # fmt: skip


def _pyramids() -> Iterator[HardCase]:
    yield HardCase(
        name="a pyramid of 20 rows", group="C", level="hard/pyramid-of-20",
        criterion=WITHIN, figure=drift, bound=RESTS, duration=10, quick=1,
    )  # fmt: skip
    yield HardCase(
        name="three pyramids with heavy apexes, dropped", group="C",
        level="hard/three-pyramids", duration=6, quick=6,
        criterion="each apex ends where it lies on its pyramid, to a twentieth of a box",
        figure=apex_displacement, bound=SINKS,
    )  # fmt: skip
    yield HardCase(
        name="a pyramid with overlaps of 25 %", group="C",
        level="hard/deep-overlap", duration=5,
        criterion="no box rises half a box above a pyramid that has parted", figure=greatest_height,
        bound=PARTS,
    )  # fmt: skip
    yield HardCase(
        name="a pyramid 10,000 km from the origin", group="C",
        level="hard/far-pyramid", duration=10, criterion=WITHIN, figure=drift, bound=RESTS,
        quick=2,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of piles."""
    yield Frontier(
        name="height of a stack", axis="boxes", whole=True,
        scene=lambda n: stack(round(n), rate=1400, iterations=10), figure=drift, bound=RESTS,
        criterion=WITHIN,
        start=2, end=60, duration=3,
    )  # fmt: skip
    yield Frontier(
        name="a heavy box on one", axis="mass ratio",
        scene=lambda ratio: stack(2, ratio, 2000, 30), figure=drift, bound=RESTS, criterion=WITHIN,
        start=10, end=1e6, duration=5, tolerance=2,
    )  # fmt: skip
    yield Frontier(
        name="a heavy box on five", axis="mass ratio",
        scene=lambda ratio: stack(6, ratio, 50_000, 10), figure=drift, bound=RESTS,
        criterion=WITHIN, start=10, end=1e6, duration=5, tolerance=2,
    )  # fmt: skip
    yield Frontier(
        name="boxes made in each other", axis="overlap",
        scene=pyramid, figure=greatest_height, bound=PARTS,
        criterion="no box rises half a box above a pyramid that has parted", start=0.02, end=0.9,
        duration=3,
    )  # fmt: skip
    yield Frontier(
        name="a stack of 15 at rest", axis="time", unit="s",
        scene=lambda _: stack(15, rate=1000), figure=drift, bound=RESTS, criterion=WITHIN,
        start=0.1, end=300, over_time=True,
    )  # fmt: skip
