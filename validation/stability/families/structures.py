"""Structures: an arch of wedges, a house of cards."""

from collections.abc import Iterator
from math import cos, pi, sin

from validation.stability.hard_case import Frontier, HardCase
from validation.stability.run_measures import drift
from validation.stability.scene_parts import (
    NEWTON,
    Document,
    box,
    check,
    ground,
    level,
    pile,
    rounded,
)

TILT = 25 * pi / 180  # rad, of a card from the vertical
CARD = 0.4, 0.002  # m
PITCH = 0.392  # m, from one pair of cards to the next


def arch(count: int = 17) -> Document:
    """Return a half circle of wedges between two abutments."""
    gap = 1e-6  # rad, on either side: it closes under its weight
    wedges: Document = {}
    for i in range(count):
        a, b = pi * i / count + gap, pi * (i + 1) / count - gap
        corners = [(r * cos(t), r * sin(t)) for r, t in ((4.0, a), (5.0, a), (5.0, b), (4.0, b))]
        x, y = _centroid(corners)
        relative = [rounded((p - x, q - y)) for p, q in corners]
        shape = {"type": "polygon", "vertices": relative}
        wedge = {"shape": shape, "mass": 1, "position": rounded((x, y)), "friction": 0.775}
        wedges[f"stone{i + 1}"] = wedge
    keystone = f"stone{count // 2 + 1}"
    high = wedges[keystone]["position"][1]
    return level(
        f"An arch of {count} stones",
        "Only weight and friction hold the stones of an arch together.",
        NEWTON,
        effects=pile(0.5),
        bodies={**wedges, "ground": ground(10, friction=0.775)},
        stepping={"rate": 2000, "iterations": 8},
        duration=3,
        checks=[check(f"{keystone}.position.y", high, 0.01, "height of the keystone")],
        view={"center": [0, 2.6], "width": 14},
    )


def _centroid(corners: list[tuple[float, float]]) -> tuple[float, float]:
    area = x = y = 0.0
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        cross = ax * by - bx * ay
        area, x, y = area + cross, x + (ax + bx) * cross, y + (ay + by) * cross
    return x / (3 * area), y / (3 * area)


def cards(stories: int = 5) -> Document:
    """Return a house of cards: pairs that lean on each other, with a card across each two pairs."""
    half, thin = CARD[0] / 2, CARD[1] / 2
    rise = half * cos(TILT) + thin * sin(TILT)  # from a card's middle to its highest corner
    reach = half * sin(TILT) + thin * cos(TILT)
    house: Document = {}
    base = 0.0
    for story in range(stories):
        for i in range(stories - story):
            x = (i - (stories - story - 1) / 2) * PITCH
            for side, name in ((-1, "left"), (1, "right")):
                card = box((x + side * reach, base + rise), CARD[1], CARD[0], 0.01, friction=0.8367)
                house[f"{name}{story + 1}_{i + 1}"] = {**card, "angle": round(side * TILT, 12)}
        base += 2 * rise
        for i in range(stories - story - 1):
            x = (i - (stories - story - 2) / 2) * PITCH
            flat = box((x, base + thin), PITCH - 0.0005, CARD[1], 0.01, friction=0.8367)
            house[f"flat{story + 1}_{i + 1}"] = flat
        base += 2 * thin
    top = f"left{stories}_1"
    return level(
        f"A house of cards of {stories} stories",
        "Cards of 40 cm by 2 mm lean on each other at 25°. Only friction holds their feet.",
        NEWTON,
        effects=pile(0.02),
        bodies={**house, "ground": ground(2, friction=0.8367)},
        stepping={"rate": 4000, "iterations": 10},
        duration=1,
        checks=[
            check(f"{top}.position.y", house[top]["position"][1], 0.005, "height of a top card")
        ],
        view={"center": [0, base / 2], "width": 2.4 * base},
    )


LEVELS = {"arch": arch, "house-of-cards": cards}

STANDS = "no stone of 1 m moves by 1 cm"
LEANS = "no card of 40 cm moves by 4 mm"


def cases() -> Iterator[HardCase]:
    """Yield the structures that must stand."""
    yield HardCase(
        name="an arch of 17 stones", group="C", level="hard/arch", duration=10,
        criterion=STANDS, figure=drift, bound=0.01, quick=2,
    )  # fmt: skip
    yield HardCase(
        name="a house of cards of five stories", group="C",
        level="hard/house-of-cards", duration=5, criterion=LEANS, figure=drift, bound=0.004,
        quick=1,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of structures."""
    yield Frontier(
        name="stones of an arch", axis="stones", whole=True,
        scene=lambda n: arch(2 * round(n) + 1), figure=drift, bound=0.01, criterion=STANDS,
        start=2, end=40, duration=5,
    )  # fmt: skip
    yield Frontier(
        name="stories of a house of cards", axis="stories", whole=True,
        scene=lambda n: cards(round(n)), figure=drift, bound=0.004, criterion=LEANS,
        start=1, end=10, duration=2,
    )  # fmt: skip
