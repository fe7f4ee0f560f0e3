"""Generated levels of many bodies, to measure how a step's cost grows with their number."""

from collections.abc import Callable, Mapping, Sequence
from math import ceil, cos, fsum, pi, sin, sqrt
from typing import Any, NamedTuple

from sandbox.model.body import MAX_BODIES
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import MisuseError, brief

Document = dict[str, Any]
"""The content of a level's file."""

RADIUS = 0.05  # m
G = 9.81  # m/s²
GOLDEN = 0.6180339887498949
"""The inverse golden ratio: fractional parts of its multiples are spread evenly."""

FILLED = 0.2
"""The share of the plane that a gas fills."""

DEEP = 10
"""The layers of a pile of 100 or more discs. With a fixed depth, the lowest discs carry the same
load, and have the same number of contacts, in every pile. Ten sweeps at 60 Hz cannot support heaps
twice as deep."""

LINK = 0.1  # m
STIFF = 4.0
"""The least number of steps per radian of the fastest wave in a chain; 1/2 is too few."""


class CrowdError(MisuseError):
    """A scene of many bodies that cannot be made."""


def gas(count: int) -> Document:
    """Discs fly about between walls, bounce off them and off each other, and keep their energy."""
    columns = ceil(sqrt(count))
    spacing = RADIUS * sqrt(pi / FILLED)
    side = columns * spacing
    discs: Document = {}
    for i in range(count):
        turn = 2 * pi * (i * GOLDEN % 1)
        position = (
            round((i % columns + 0.5) * spacing, 6),
            round((i // columns + 0.5) * spacing, 6),
        )
        disc = _disc(position, velocity=[round(cos(turn), 6), round(sin(turn), 6)], restitution=1)
        discs[f"disc{i + 1}"] = disc
    energy = fsum(v[0] ** 2 + v[1] ** 2 for v in (d["velocity"] for d in discs.values())) / 2
    corners: list[list[float]] = [[0, 0], [side, 0], [side, side], [0, side], [0, 0]]
    return _level(
        f"A gas of {count} discs",
        "Discs that bounce without loss, and keep their energy.",
        effects={"contact": {}, "restitution": {}},
        bodies={**discs, "walls": _walls(corners, restitution=1)},
        checks=[_check("system.energy", energy, 1e-2, "energy")],
        view={"center": [side / 2, side / 2], "width": 1.5 * side},
    )


def pile(count: int) -> Document:
    """Discs fall into a vessel and come to rest.

    They are listed column by column, so that discs in contact are neighbours in memory as well.
    """
    rows = min(ceil(sqrt(count)), DEEP)
    spacing = 2.2 * RADIUS
    width, height = ceil(count / rows) * spacing, (rows + 1) * spacing
    discs: Document = {}
    for i in range(count):
        aside = 0.05 * RADIUS * (2 * (i * GOLDEN % 1) - 1)  # so that no disc balances on another
        position = (round((i // rows + 0.5) * spacing + aside, 6), round(i % rows * spacing, 6))
        discs[f"disc{i + 1}"] = _disc(position, friction=0.5)
    corners = [[0, 2 * height], [0, -spacing], [width, -spacing], [width, 2 * height]]
    return _level(
        f"A pile of {count} discs",
        "Discs that fall into a vessel, and make a heap.",
        effects={
            "gravity": {"acceleration": [0, -G]},
            "contact": {},
            "friction": {},
            "rotation": {},
        },
        bodies={**discs, "vessel": _walls(corners, friction=1)},
        view={"center": [width / 2, height / 2], "width": max(1.1 * width, 2 * height)},
    )


def chain(count: int) -> Document:
    """Discs hang in a row from a point, linked by rods, and swing."""
    angle = 0.3  # rad, of the whole at the start
    discs: Document = {}
    rods: Document = {}
    for i in range(1, count + 1):
        position = (i * LINK * sin(angle), -i * LINK * cos(angle))
        discs[f"disc{i}"] = {**_disc(position), "shape": {"type": "disc", "radius": LINK / 4}}
        rods[f"rod{i}"] = {"type": "rod", "ends": [f"disc{i - 1}" if i > 1 else [0, 0], f"disc{i}"]}
    fastest = 2 * sqrt(count * G / LINK)  # rad/s, of the top links, which carry all others
    ends = [(1, "the highest link"), (count, "the lowest link")]
    return _level(
        f"A chain of {count} links",
        "Discs on massless rods, solved together: every link keeps its length.",
        effects={"gravity": {"acceleration": [0, -G]}},
        bodies=discs,
        joints=rods,
        stepping={"rate": max(60, 10 * ceil(STIFF * fastest / 10))},
        checks=[_check(f"rod{i}.length", LINK, 1e-9, about) for i, about in dict(ends).items()],
        view={"center": [0, -0.55 * count * LINK], "width": 1.8 * count * LINK},
    )


def cluster(count: int) -> Document:
    """Discs at rest attract each other, and fall towards the middle."""
    discs: Document = {}
    for i in range(count):
        out, turn = sqrt(i + 0.5), 2 * pi * i * GOLDEN
        position = (round(out * cos(turn), 6), round(out * sin(turn), 6))
        discs[f"disc{i + 1}"] = _disc(position)
    size = sqrt(count + 0.5)
    middle = fsum(disc["position"][0] for disc in discs.values()) / count
    return _level(
        f"A cluster of {count} bodies",
        "Bodies that attract each other. Their centre of mass stays where it is.",
        effects={"gravitation": {"constant": size / count, "softening": 0.5}},
        bodies=discs,
        checks=[_check("system.center.x", middle, 1e-9, "centre of mass")],
        view={"width": 4 * size},
    )


def _disc(position: tuple[float, float], **rest: object) -> Document:
    shape = {"type": "disc", "radius": RADIUS}
    return {"shape": shape, "mass": 1, "position": list(position), **rest}


def _walls(corners: Sequence[Sequence[float]], **rest: object) -> Document:
    return {"type": "static", "shape": {"type": "polyline", "points": corners}, **rest}


def _check(quantity: str, value: float, tolerance: float, label: str) -> Document:
    return {"quantity": quantity, "formula": value, "tolerance": tolerance, "label": label}


def _level(title: str, summary: str, **parts: object) -> Document:
    return {"format": 1, "title": title, "summary": summary, **parts}


class Crowd(NamedTuple):
    """A kind of scene of many bodies."""

    make: Callable[[int], Document]
    maximum: int
    """the largest number of bodies"""
    minimum: int = 1


CROWDS: Mapping[str, Crowd] = {
    "gas": Crowd(gas, MAX_BODIES - 1),
    "pile": Crowd(pile, 5000),
    "chain": Crowd(chain, 300),
    "cluster": Crowd(cluster, 1000, minimum=2),
}
"""The kinds of crowd. To release the memory of a pile, pymunk takes a time that grows faster than
the square of its size: 2 s for 5,000 discs, more than half a minute for 10,000. The joints of a
chain form one dense system, whose cost grows with the cube; a cluster has a force for each pair of
bodies, and 1,000 bodies just run in real time."""


def crowd(kind: str, bodies: int) -> Document:
    """Return a level with a number of moving bodies.

    Raises `CrowdError` if there is no such kind, or the number of bodies is out of its range.
    """
    if kind not in CROWDS:
        raise CrowdError(
            "there is no scene '{kind}'{hint}", kind=brief(kind), hint=suggestion(kind, CROWDS)
        )
    make, maximum, minimum = CROWDS[kind]
    if not minimum <= bodies <= maximum:
        raise CrowdError(
            "a {kind} must have between {least} and {most} bodies, not {bodies}",
            kind=kind,
            bodies=bodies,
            least=minimum,
            most=maximum,
        )
    return make(bodies)
