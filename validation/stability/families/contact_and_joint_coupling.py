"""Compositions: contacts, friction and joints that are correct only if solved together."""

from collections.abc import Iterator
from itertools import pairwise
from math import exp, pi

import numpy as np

from validation.formulas.assorted_mechanics_problems import capstan_acceleration
from validation.stability.hard_case import Frontier, HardCase
from validation.stability.run_measures import Run, drift, mass, rows
from validation.stability.scene_parts import (
    GRAVITY,
    NEWTON,
    ROTATION,
    Document,
    G,
    block,
    box,
    check,
    disc,
    ground,
    level,
    rod,
    text_of,
)

RATE = 240.0  # Hz

CARRIES = 1e-9
"""The tolerance of a force, relative to it."""

ROLLS = 1e-6
"""The tolerance of a force, relative to it."""

WHEEL = 10.0  # kg
AXLES = {"back": -0.5, "front": 0.5}  # m

ROUGHNESS = 0.25
ROPE = 0.01  # kg
MARGIN = 0.01
"""The share by which a weight is below or above what friction can hold."""

SLIPS = 0.25  # s
CREEPS = 0.01
"""The tolerance, as a share of the distance that the heavier weight has slipped at the end."""

STANDS = 1e-9  # m


def strut(ratio: float) -> Document:
    """Return a weight on a rod on a box of 1 kg on the floor; a rail keeps it upright."""
    return level(
        f"A strut under {text_of(ratio)} times its foot",
        "A weight rests on a rod, the rod on a light box, and the box on the floor.",
        NEWTON,
        effects={**GRAVITY, "contact": {}},
        bodies={
            "ground": block((0, -0.5), 10, 1),
            "foot": box((0, 0.1), 0.2, 0.2),
            "weight": disc((0, 1.1), 0.1, ratio),
        },
        joints={
            "rod": rod("foot", "weight"),
            "rail": {"type": "rail", "ends": ["weight", [0, 1.1]], "direction": [0, 1]},
        },
        stepping={"rate": RATE},
        duration=2,
        checks=[
            check("foot.contact.normal", (ratio + 1) * G, CARRIES, "force on the floor"),
            check("rod.tension", -ratio * G, CARRIES, "force in the rod"),
        ],
        view={"center": [0, 0.6], "width": 3},
    )


def car(mass: float) -> Document:
    """Return a chassis [kg] on two wheels of 10 kg."""
    wheels = {name: disc((x, 0.25), 0.25, WHEEL, friction=1) for name, x in AXLES.items()}
    axles = {
        f"{name}_axle": {"type": "pivot", "ends": [{"body": "chassis", "at": [x, -0.45]}, name]}
        for name, x in AXLES.items()
    }
    carried = (mass / 2 + WHEEL) * G
    return level(
        f"A car of {text_of(mass)} kg on light wheels",
        "A heavy chassis stands on two wheels of 10 kg.",
        ROTATION,
        effects={**GRAVITY, "contact": {}, "friction": {}, "rotation": {}},
        bodies={
            "ground": ground(5, friction=1),
            "chassis": box((0, 0.7), 1.2, 0.2, mass, friction=1),
            **wheels,
        },
        joints=axles,
        stepping={"rate": RATE},
        duration=2,
        checks=[
            *(
                check(f"{n}.contact.normal", carried, ROLLS, f"force on the {n} wheel")
                for n in AXLES
            ),
            check("chassis.position.x", 0, ROLLS, "horizontal position"),
        ],
        view={"center": [0, 0.5], "width": 3},
    )


def capstans(links: int, rate: float = RATE / 2) -> Document:
    """Return ropes of links round half of two rough drums; one of the weights is too heavy."""
    limit = exp(ROUGHNESS * pi)
    held, held_rods = _capstan("held", -1.7, (1 - MARGIN) * limit, links)
    slips, slips_rods = _capstan("slips", 1.7, (1 + MARGIN) * limit, links)
    return level(
        f"Two capstans with ropes of {links} links",
        "Friction holds up to e^(μ φ) times the small weight. "
        "One drum has 1 % less and must hold, the other 1 % more and must slip.",
        NEWTON,
        effects={**GRAVITY, "contact": {}, "friction": {}},
        bodies={**held, **slips},
        joints={**held_rods, **slips_rods},
        stepping={"rate": rate},
        duration=SLIPS,
        checks=[
            check("held_large.position.y", -1.8, 1e-9, "left: height of the load"),
            check(
                "slips_large.acceleration.y", -_slipping(limit * (1 + MARGIN), links), 1e-2,
                "right: acceleration of the load", at=SLIPS / 2,
            ),
        ],
        view={"center": [0, -0.5], "width": 7.5},
    )  # fmt: skip


def _capstan(name: str, x: float, load: float, links: int) -> tuple[Document, Document]:
    """Return a drum of 1 m about (x, 0), with a rope between 1 kg and `load` kg, and the joints."""
    bend = pi / links
    thin = 0.3 * bend
    around = 1 + thin
    knots = {}
    for i in range(links + 1):
        place = x - around * np.cos(i * bend), around * np.sin(i * bend)
        knots[f"{name}_knot{i}"] = disc(place, thin, ROPE / (links + 1), friction=1)
    row = [f"{name}_small", *knots, f"{name}_large"]
    bodies = {
        f"{name}_drum": {
            "type": "static", "shape": {"type": "disc", "radius": 1}, "position": [x, 0],
            "friction": ROUGHNESS,
        },
        f"{name}_small": box((x - around, -1.6), 0.36, 0.36, friction=0),
        f"{name}_large": box((x + around, -1.8), 0.54, 0.54, load, friction=0),
        **knots,
    }  # fmt: skip
    return bodies, {f"{name}_rod{i}": rod(a, b) for i, (a, b) in enumerate(pairwise(row))}


def _slipping(load: float, links: int) -> float:
    """Return the acceleration of a weight on such a rope [m/s²]."""
    return capstan_acceleration(load, ROUGHNESS, links + 1, ROPE / (links + 1), G)


def stack(count: int) -> Document:
    """Return boxes of 1 m and 1 kg on top of each other, solved directly."""
    boxes = {f"box{i + 1}": box((0, i + 0.5), 1, 1, friction=0.6) for i in range(count)}
    return level(
        f"A stack of {count} boxes, solved directly",
        "A stack of boxes must stand still at only 60 steps per second.",
        NEWTON,
        effects={**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}},
        bodies={**boxes, "ground": ground(10)},
        stepping={"rate": 60},
        duration=10,
        checks=[
            check(f"box{count}.position.y", count - 0.5, STANDS, "height of the top box"),
            check(f"box{count}.position.x", 0, STANDS, "lean of the stack"),
            check(
                "box1.contact.normal",
                (2 * count - 1) * G,
                CARRIES,
                "force between the lowest boxes",
            ),
        ],
        view={"center": [0, count / 2], "width": 2.4 * count},
    )


def carried(run: Run, force: float, *names: str) -> float:
    """Return the relative error of the forces that carry bodies, in the second half of the run.

    pymunk alone needs the first half to settle.
    """
    pressed = run.states.normal[len(run.states.t) // 2 :, rows(run, *names)]
    return float(np.abs(pressed / force - 1).max())


def floor_carries(run: Run) -> float:
    """Return the relative error of the floor's force on a strut's foot: both weights."""
    return carried(run, (mass(run, "weight") + mass(run, "foot")) * G, "foot")


def wheels_carry(run: Run) -> float:
    """Return the relative error of the floor's forces on a car's wheels, which are half each."""
    return carried(run, (mass(run, "chassis") / 2 + WHEEL) * G, *AXLES)


def creeps(run: Run) -> float:
    """Return the error of either weight's position, relative to the distance of the slipping one.

    That distance is a t² / 2 as long as it is short compared with a link.
    """
    links = sum(name.startswith("held_knot") for name in run.level.bodies) - 1
    height = run.states.position[:, rows(run, "held_large", "slips_large"), 1]
    distance = _slipping(mass(run, "slips_large"), links) * run.states.t**2 / 2
    off = height[0] - height - np.stack((np.zeros_like(distance), distance), axis=1)
    return float(np.abs(off).max() / distance[-1])


LEVELS = {
    "strut": lambda: strut(1e6),
    "heavy-car": lambda: car(1e5),
    "two-capstans": lambda: capstans(24, rate=RATE / 4),
    "stack-of-40-directly": lambda: stack(40),
}

FORCE = "the floor carries both weights, to 1e-9 of them"
LOADS = "each wheel carries half of the car, to 1e-6 of it"
ROPES = "the rope that holds does not move, and the other slips as Newton's law says, to 1 %"
UPRIGHT = "no box of 1 m moves by 1e-9 m: where forces balance, nothing moves"


def cases() -> Iterator[HardCase]:
    """Yield the compositions that must be right."""
    yield HardCase(
        name="1,000,000 : 1 on a strut", group="C", level="hard/strut",
        criterion=FORCE, figure=floor_carries, bound=CARRIES, duration=10, quick=2,
    )  # fmt: skip
    yield HardCase(
        name="a car of 10,000 times its wheels", group="C", level="hard/heavy-car",
        criterion=LOADS, figure=wheels_carry, bound=ROLLS, duration=10, quick=2,
    )  # fmt: skip
    yield HardCase(
        name="two capstans with ropes of 24 links", group="D",
        level="hard/two-capstans", criterion=ROPES, figure=creeps, bound=CREEPS,
    )  # fmt: skip
    yield HardCase(
        name="a stack of 40 boxes, solved directly", group="C",
        level="hard/stack-of-40-directly", criterion=UPRIGHT, figure=drift, bound=STANDS, quick=2,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of compositions."""
    yield Frontier(
        name="a weight on a strut", axis="mass ratio", scene=strut,
        figure=floor_carries, bound=CARRIES, criterion=FORCE, start=1, end=1e6, duration=3,
    )  # fmt: skip
    yield Frontier(
        name="a car on light wheels", axis="mass", unit="kg", scene=car,
        figure=wheels_carry, bound=ROLLS, criterion=LOADS, start=100, end=1e10, duration=2,
    )  # fmt: skip
    yield Frontier(
        name="a rope round a drum", axis="links", whole=True,
        scene=lambda n: capstans(round(n)), figure=creeps, bound=CREEPS, criterion=ROPES,
        start=12, end=32, duration=SLIPS,
    )  # fmt: skip
    yield Frontier(
        name="a stack solved directly", axis="boxes", whole=True,
        scene=lambda n: stack(round(n)), figure=drift, bound=STANDS, criterion=UPRIGHT,
        start=2, end=60, duration=10,
    )  # fmt: skip
