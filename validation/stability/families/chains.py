"""Chains of rods: heavy loads, whipping, long swings."""

from collections.abc import Iterator
from math import atan2, cos, sin

import numpy as np

from sandbox.model.joint_ends import span
from validation.stability.case import Frontier, HardCase
from validation.stability.run_measures import Run, energy, separation
from validation.stability.scene import (
    GRAVITY,
    LAGRANGE,
    WATCHED,
    Document,
    G,
    check,
    disc,
    level,
    rod,
    text_of,
)

FAMILY = "chains"

HOLDS = 0.01
"""The tolerance of a link's length, as a share of it."""

TRUE = 1e-4
SWINGS = "energy, of the kinetic, and lengths, of a link, to 1e-4: what the levels promise"

KEEPS = "no link is longer or shorter by a hundredth of itself"


def chain(
    count: int,
    load: float = 1.0,
    *,
    link: float = 0.5,
    angle: float = 0.5,
    rate: float = 2000,
    mass: float = 1.0,
) -> Document:
    """Return a straight chain of massless links between discs, released at an angle [rad].

    The last disc is `load` times as heavy as each of the others [kg].
    """
    discs: Document = {}
    rods: Document = {}
    for i in range(1, count + 1):
        place = i * link * sin(angle), -i * link * cos(angle)
        heavy = mass * load if i == count else mass
        radius = 0.2 * link * (2 if i == count and load > 1 else 1)
        discs[f"disc{i}"] = disc(place, radius, heavy)
        rods[f"rod{i}"] = rod(f"disc{i - 1}" if i > 1 else [0, 0], f"disc{i}")
    return level(
        f"A chain of {count} links"
        if load == 1
        else f"{count} links and a load of {text_of(load)} : 1",
        "A straight chain is released at an angle, and its links must keep their lengths.",
        LAGRANGE,
        effects=GRAVITY,
        bodies=discs,
        joints=rods,
        stepping={"rate": rate},
        duration=min(2, WATCHED / rate),
        checks=[
            check(f"rod{i}.length", link, 1e-9, about)
            for i, about in (
                (1, "length of the highest link"),
                (count, "length of the lowest link"),
            )
        ],
        view={"center": [0, -0.5 * count * link], "width": 2.2 * count * link},
    )


def catenary(count: int = 40, width: float = 4.0, link: float = 0.15) -> Document:
    """Return a chain at rest between two points, with every link along its tension."""
    places = hanging(count, width, link)
    beads = {f"bead{i}": disc(places[i], 0.03) for i in range(1, count)}
    ends = [list(places[0]), *beads, list(places[-1])]
    rods = {f"rod{i + 1}": rod(ends[i], ends[i + 1]) for i in range(count)}
    middle = f"bead{count // 2}"
    return level(
        f"A hanging chain of {count} links",
        "A chain of short links hangs at rest between two points, nearly in a catenary.",
        LAGRANGE,
        effects=GRAVITY,
        bodies=beads,
        joints=rods,
        stepping={"rate": 960},
        duration=3,
        checks=[
            check(f"{middle}.position.y", places[count // 2][1], 1e-9, "height of the lowest bead")
        ],
        view={"center": [0, -1], "width": 7},
    )


def hanging(count: int, width: float, link: float) -> list[tuple[float, float]]:
    """Return the equilibrium positions of the beads in such a chain [m].

    The horizontal tension H is the same in every link, and the vertical one grows by the weight of
    a bead from link to link: link k slopes by atan(w (k - (n - 1) / 2) / H). H is found by
    bisection so that the links span the width.
    """
    rising = G * (np.arange(count) - (count - 1) / 2)
    low, high = 1e-6, 1e9
    for _ in range(200):
        across = np.sqrt(low * high)
        spans = link * np.sum(across / np.hypot(across, rising))
        low, high = (across, high) if spans < width else (low, across)
    slopes = [atan2(v, across) for v in rising]
    x, y = -width / 2, 0.0
    places = [(x, y)]
    for slope in slopes:
        x, y = x + link * cos(slope), y + link * sin(slope)
        places.append((x, y))
    places[-1] = (width / 2, 0.0)
    return places


def sag(run: Run) -> float:
    """Return the relative difference between the sag and that of a smooth catenary."""
    width, length = 4.0, 40 * 0.15
    low, high = 1e-3, 1e3
    for _ in range(200):
        a = (low + high) / 2
        longer = 2 * a * np.sinh(min(width / (2 * a), 700)) > length
        low, high = (a, high) if longer else (low, a)
    expected = a * (np.cosh(width / (2 * a)) - 1)
    return float(abs(-run.states.position[..., 1].min() / expected - 1))


def bridge(planks: int = 160, rate: float = 240) -> Document:
    """Return a slack row of planks between two banks, with a load in the middle."""
    width, link = 0.98 * planks * 0.25, 0.25
    places = hanging(planks, width, link)
    beads = {f"bead{i}": disc(places[i], 0.06) for i in range(1, planks)}
    beads[f"bead{planks // 2}"]["mass"] = 100
    ends = [list(places[0]), *beads, list(places[-1])]
    rods = {f"rod{i + 1}": rod(ends[i], ends[i + 1]) for i in range(planks)}
    return level(
        f"A bridge of {planks} links",
        "A load of 100 times the mass of a link rests on the middle of a long bridge.",
        LAGRANGE,
        effects=GRAVITY,
        bodies=beads,
        joints=rods,
        stepping={"rate": rate},
        duration=1,
        checks=[check("rod1.length", link, 1e-9, "length of the first link")],
        view={"center": [0, -3], "width": 1.1 * width},
    )


def of_link(run: Run) -> float:
    """Return the largest relative error of a link's length."""
    first = next(iter(run.level.joints.values()))
    return separation(run) / span(first, run.level.bodies, run.level.defaults)


def swings_true(run: Run) -> float:
    """Return the larger of the errors in energy and in length."""
    return max(energy(run), of_link(run))


LEVELS = {
    "ball-and-chain": lambda: chain(40, 672, link=0.25, angle=1.57079),
    "light-link": lambda: chain(2, 1000, mass=0.001, rate=1000),
    "20-links-1e5": lambda: chain(20, 1e5),
    "hanging-chain": catenary,
    "bridge-of-160": bridge,
}


def cases() -> Iterator[HardCase]:
    """Yield the chains that must hold."""
    yield HardCase(
        name="40 links, the ball 672 times a link", family=FAMILY, group="C",
        level="hard/ball-and-chain", criterion=KEEPS, figure=of_link, bound=HOLDS,
        duration=10, quick=1,
    )  # fmt: skip
    yield HardCase(
        name="1 g that holds 1 kg", family=FAMILY, group="C", level="hard/light-link",
        criterion=KEEPS, figure=of_link, bound=HOLDS, duration=5, quick=1,
    )  # fmt: skip
    yield HardCase(
        name="20 links with 1e5 times their mass: length", family=FAMILY, group="D",
        level="hard/20-links-1e5", criterion=KEEPS, figure=of_link, bound=HOLDS, duration=3,
        quick=0.3,
    )  # fmt: skip
    yield HardCase(
        name="20 links with 1e5 times their mass: energy", family=FAMILY, group="D",
        level="hard/20-links-1e5",
        criterion="what swings keeps its energy, to 1e-3 of its largest kinetic energy",
        figure=energy, bound=1e-3, duration=3, quick=0.3,
    )  # fmt: skip
    yield HardCase(
        name="a bridge of 160 links under a load", family=FAMILY, group="C",
        level="hard/bridge-of-160", criterion=KEEPS, figure=of_link, bound=HOLDS, duration=2,
        quick=0.3,
    )  # fmt: skip
    # Its upper row is taut between two corners, which exact rods refuse: its rods are pymunk's own.
    yield HardCase(
        name="a net of 20 by 20 joints under a load", family=FAMILY, group="C",
        level="hard/net-of-20", criterion=KEEPS, figure=of_link, bound=HOLDS, duration=2, quick=0.3,
    )  # fmt: skip
    yield HardCase(
        name="a chain of 40 links at rest", family=FAMILY, group="B", level="hard/hanging-chain",
        criterion="the sag is that of a catenary, to the square of a link over the span",
        figure=sag, bound=(0.15 / 4) ** 2, duration=5, quick=1,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of chains."""
    yield Frontier(
        name="a load on 20 links", family=FAMILY, axis="load, of a link",
        scene=lambda load: chain(20, load, rate=5000), figure=swings_true, bound=TRUE,
        criterion=SWINGS, start=1, end=1e7, duration=2,
    )  # fmt: skip
    yield Frontier(
        name="a load of 1000 on a chain", family=FAMILY, axis="links", whole=True,
        scene=lambda n: chain(round(n), 1000, rate=2000), figure=swings_true, bound=TRUE,
        criterion=SWINGS, start=2, end=80, duration=2,
    )  # fmt: skip
