"""Scenes of a few lines, for tests: dictionaries as they stand in a level's file."""

import json
from collections.abc import Mapping, Sequence
from math import cos, radians, sin
from typing import Any

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World

G = 9.81  # m/s²
GRAVITY: Mapping[str, Any] = {"gravity": {"acceleration": [0, -G]}}

Spec = dict[str, Any]
Pair = Sequence[float]


def level(bodies: Mapping[str, Spec], effects: Mapping[str, Any], **rest: object) -> Level:
    """Make a level, through the same door as a file."""
    said = {"format": 1, "title": "Test", "bodies": bodies, "effects": effects, **rest}
    return parse(json.dumps(said))


def disc(position: Pair = (0, 0), *, radius: float = 0.5, mass: float = 1, **rest: object) -> Spec:
    shape = {"type": "disc", "radius": radius}
    return {"shape": shape, "mass": mass, "position": list(position), **rest}


def box(
    position: Pair = (0, 0), *, size: Pair = (0.5, 0.5), mass: float = 1, **rest: object
) -> Spec:
    shape = {"type": "box", "width": size[0], "height": size[1]}
    return {"shape": shape, "mass": mass, "position": list(position), **rest}


def fixed(shape: Spec, position: Pair = (0, 0), **rest: object) -> Spec:
    return {"type": "static", "shape": shape, "position": list(position), **rest}


def floor(y: float = 0, **rest: object) -> Spec:
    return fixed({"type": "segment", "start": [-100, 0], "end": [100, 0]}, (0, y), **rest)


def pulley(ends: Sequence[str], over: Sequence[Pair], **rest: object) -> Spec:
    return {"type": "pulley", "ends": list(ends), "over": [list(peg) for peg in over], **rest}


def atwood(left: float, right: float, **rest: object) -> Level:
    """Two masses on a string over two pegs, 3 m below them."""
    return level(
        {"left": box((-0.5, 0), mass=left), "right": box((0.5, 0), mass=right)},
        GRAVITY,
        joints={"string": pulley(["left", "right"], [(-0.5, 3), (0.5, 3)])},
        **rest,
    )


def incline(angle: float, friction: float | None = None, **rest: object) -> Level:
    """A block of 2 kg at the middle of a slope that rises to the right; its centre is at [0, 0]."""
    rub: Spec = {} if friction is None else {"friction": friction}
    slope = fixed(
        {"type": "segment", "start": [-200, 0], "end": [200, 0]},
        (0.25 * sin(angle), -0.25 * cos(angle)),
        angle=angle,
        **({} if friction is None else {"friction": 1}),
    )
    effects = {**GRAVITY, "contact": {}, **({} if friction is None else {"friction": {}})}
    return level({"block": box(mass=2, angle=angle, **rub), "slope": slope}, effects, **rest)


def table(friction: float | None = None, *, block: float = 1, weight: float = 0.5) -> Level:
    """A block on a table, and a weight that pulls it over the edge by a string."""
    rub: Spec = {} if friction is None else {"friction": friction}
    top = fixed({"type": "segment", "start": [-50, 0], "end": [50, 0]}, (0, -0.25))
    return level(
        {
            "block": box((-5, 0), mass=block, **rub),
            "weight": box((0, -1), size=(0.2, 0.2), mass=weight, **rub),
            "table": {**top, **({} if friction is None else {"friction": 1})},
        },
        {**GRAVITY, "contact": {}, **({} if friction is None else {"friction": {}})},
        joints={"string": pulley(["block", "weight"], [(0, 0)])},
    )


def strut(rate: float, solver: str = "iterative", **rest: object) -> Level:
    """100 kg on a rod on a box of 1 kg on the floor; a rail keeps the load upright."""
    rod = {"type": "rod", "ends": ["box", "load"]}
    rail = {"type": "rail", "ends": [[0, 0], "load"], "direction": [0, 1]}
    return level(
        {"box": box((0, 0.25)), "load": disc((0, 1.5), radius=0.2, mass=100), "floor": floor()},
        {**GRAVITY, "contact": {"solver": solver}},
        joints={"rod": rod, "rail": rail},
        stepping={"rate": rate},
        **rest,
    )


def straddle(rate: float) -> Level:
    """300 kg on rods on two boxes on the floor, by forces that are found in turn."""
    rods = {f"{name}_rod": {"type": "rod", "ends": [name, "top"]} for name in ("left", "right")}
    return level(
        {
            "left": box((-0.6, 0.1), size=(0.3, 0.2), friction=1),
            "right": box((0.6, 0.1), size=(0.3, 0.2), friction=1),
            "top": disc((0, 1.2), radius=0.1, mass=300, friction=1),
            "floor": floor(friction=1),
        },
        {**GRAVITY, "contact": {"solver": "iterative"}, "friction": {}},
        joints=rods,
        stepping={"rate": rate},
    )


def orbit(speed: float = 1, rate: float = 60, scheme: str = "leapfrog", mu: float = 1) -> Level:
    """A planet 1 m from a centre of attraction; with the speed of √mu its orbit is a circle."""
    return level(
        {"planet": disc((1, 0), radius=0.05, velocity=[0, speed])},
        {"attraction": [{"mu": mu}]},
        stepping={"rate": rate, "scheme": scheme},
    )


def run(world: World, steps: int) -> Snapshot:
    """Observe every step, and return them all, the start first: time in front."""
    return Snapshot.stack([world.snapshot, *(world.advance() for _ in range(steps))])


def booked(scene: Level, seconds: float) -> tuple[World, Ledger]:
    """Run a level for so long, and keep books of every step."""
    world = build(scene)
    books = Ledger(world)
    for _ in range(round(seconds * scene.stepping.rate)):
        world.advance()
        books.note()
    return world, books


def measured(world: World, steps: int, *names: str) -> dict[str, Array]:
    """Return quantities at every step, the start first."""
    return Meter(world, names)(run(world, steps))


def path_length(snapshot: Snapshot, pegs: Sequence[Pair], ends: Pair = (0, 1)) -> Array:
    """Return the length of the path between two bodies over pegs, at every instant [m]."""
    a, b = (snapshot.position[..., int(end), :] for end in ends)
    between = np.sum(np.hypot(*np.diff(np.array(pegs, dtype=float), axis=0).T))
    first, last = a - np.array(pegs[0]), b - np.array(pegs[-1])
    return np.asarray(np.hypot(*_xy(first)) + between + np.hypot(*_xy(last)))


def _xy(vectors: Array) -> tuple[Array, Array]:
    return vectors[..., 0], vectors[..., 1]


def worst(measured: Array, expected: Array | float) -> float:
    """Return the largest difference, relative to the largest expected value if that is not zero."""
    scale = float(np.abs(expected).max())
    return float(np.abs(measured - expected).max()) / (scale or 1.0)


def small_swings(angle: float = 5) -> Level:
    """A pendulum let go at some degrees, by the formula of the smallest swings; and its rod."""
    start = radians(angle)
    place = {"quantity": "bob.position.x", "formula": f"sin({start}*cos(sqrt({G})*t))"}
    length = {"quantity": "rod.length", "formula": "1"}
    return level(
        {"bob": disc((sin(start), -cos(start)), radius=0.1)},
        GRAVITY,
        joints={"rod": {"type": "rod", "ends": [[0, 0], "bob"]}},
        checks=[{**check, "tolerance": 0.01} for check in (place, length)],
        stepping={"rate": 480},
        duration=2,
    )
