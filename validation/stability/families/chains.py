"""Chains of rods: heavy loads, whipping, long swings."""

from collections.abc import Iterator
from math import cos, sin

import numpy as np
from scipy.optimize import brentq

from sandbox.model.joint_ends_at_start import span
from validation.stability.hard_case import Frontier, HardCase
from validation.stability.run_measures import Run, energy, separation
from validation.stability.scene_parts import (
    GRAVITY,
    LAGRANGE,
    WATCHED,
    Document,
    check,
    disc,
    level,
    rod,
    text_of,
)

LINK = 0.5  # m
ANGLE = 0.5  # rad, of a chain from the vertical when it is released

HOLDS = 0.01
"""The tolerance of a link's length, as a share of it."""

TRUE = 1e-4
SWINGS = "energy, of the kinetic, and lengths, of a link, to 1e-4: what the levels promise"

KEEPS = "no link is longer or shorter by a hundredth of itself"


def chain(count: int, load: float = 1.0, *, rate: float = 2000) -> Document:
    """Return a straight chain of links between discs of 1 kg, the last one `load` times that."""
    discs: Document = {}
    rods: Document = {}
    for i in range(1, count + 1):
        place = i * LINK * sin(ANGLE), -i * LINK * cos(ANGLE)
        loaded = i == count and load > 1
        discs[f"disc{i}"] = disc(
            place, 0.4 * LINK if loaded else 0.2 * LINK, load if loaded else 1.0
        )
        rods[f"rod{i}"] = rod(f"disc{i - 1}" if i > 1 else [0, 0], f"disc{i}")
    return level(
        f"{count} links and a load of {text_of(load)} : 1",
        "A straight chain is released at an angle, and its links must keep their lengths.",
        LAGRANGE,
        effects=GRAVITY,
        bodies=discs,
        joints=rods,
        stepping={"rate": rate},
        duration=min(2, WATCHED / rate),
        checks=[
            check("rod1.length", LINK, 1e-9, "length of the highest link"),
            check(f"rod{count}.length", LINK, 1e-9, "length of the lowest link"),
        ],
        view={"center": [0, -0.5 * count * LINK], "width": 2.2 * count * LINK},
    )


def sag(run: Run) -> float:
    """Return the relative difference between the sag and that of a smooth catenary."""
    width, length = 4.0, 40 * 0.15
    a = brentq(lambda a: 2 * a * np.sinh(min(width / (2 * a), 700)) - length, 1e-3, 1e3)
    expected = a * (np.cosh(width / (2 * a)) - 1)
    return float(abs(-run.states.position[..., 1].min() / expected - 1))


def link_error(run: Run) -> float:
    """Return the largest relative error of a link's length."""
    first = next(iter(run.level.joints.values()))
    return separation(run) / span(first, run.level.bodies, run.level.defaults)


def worst_error(run: Run) -> float:
    """Return the larger of the errors in energy and in length."""
    return max(energy(run), link_error(run))


LEVELS = {"20-links-1e5": lambda: chain(20, 1e5)}


def cases() -> Iterator[HardCase]:
    """Yield the chains that must hold."""
    yield HardCase(
        name="40 links, the ball 672 times a link", group="C",
        level="hard/ball-and-chain", criterion=KEEPS, figure=link_error, bound=HOLDS,
        duration=10, quick=1,
    )  # fmt: skip
    yield HardCase(
        name="1 g that holds 1 kg", group="C", level="hard/light-link",
        criterion=KEEPS, figure=link_error, bound=HOLDS, duration=5, quick=1,
    )  # fmt: skip
    yield HardCase(
        name="20 links with 1e5 times their mass: length", group="D",
        level="hard/20-links-1e5", criterion=KEEPS, figure=link_error, bound=HOLDS, duration=3,
        quick=0.3,
    )  # fmt: skip
    yield HardCase(
        name="20 links with 1e5 times their mass: energy", group="D",
        level="hard/20-links-1e5",
        criterion="what swings keeps its energy, to 1e-3 of its largest kinetic energy",
        figure=energy, bound=1e-3, duration=3, quick=0.3,
    )  # fmt: skip
    yield HardCase(
        name="a bridge of 160 links under a load", group="C",
        level="hard/bridge-of-160", criterion=KEEPS, figure=link_error, bound=HOLDS, duration=2,
        quick=0.3,
    )  # fmt: skip
    # Its upper row is taut between two corners, which exact rods refuse: its rods are pymunk's own.
    yield HardCase(
        name="a net of 20 by 20 joints under a load", group="C",
        level="hard/net-of-20", criterion=KEEPS, figure=link_error, bound=HOLDS, duration=2,
        quick=0.3,
    )  # fmt: skip
    yield HardCase(
        name="a chain of 40 links at rest", group="B", level="hard/hanging-chain",
        criterion="the sag is that of a catenary, to the square of a link over the span",
        figure=sag, bound=(0.15 / 4) ** 2, duration=5, quick=1,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of chains."""
    yield Frontier(
        name="a load on 20 links", axis="load, of a link",
        scene=lambda load: chain(20, load, rate=5000), figure=worst_error, bound=TRUE,
        criterion=SWINGS, start=1, end=1e7, duration=2,
    )  # fmt: skip
    yield Frontier(
        name="a load of 1000 on a chain", axis="links", whole=True,
        scene=lambda n: chain(round(n), 1000, rate=2000), figure=worst_error, bound=TRUE,
        criterion=SWINGS, start=2, end=80, duration=2,
    )  # fmt: skip
