"""Scenes that are built to explode: each stays within bounds, or stops and says why.

None may hang, end in values that are not finite, or end the interpreter: those that could are run
in a process of their own.
"""

from contextlib import suppress
from typing import Any

import numpy as np
import pytest

from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.elsewhere import python
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, level

GROUND = fixed({"type": "box", "width": 400, "height": 10}, (0, -5))
PILE: dict[str, Any] = {**GRAVITY, "contact": {"overlaps": True}, "rotation": {}}
SEQUENCE: dict[str, Any] = {
    "contact": {"overlaps": True},
    "restitution": {"impacts": "sequence"},
}
FAR = 1e8  # m


def pyramid(overlap: float) -> Level:
    """Boxes of 1 m in five rows, each within its neighbours by a share of its width."""
    way = 1 - overlap
    boxes = {
        f"b{row}_{i}": box(((i - (5 - row) / 2) * way, 0.5 + row * way), size=(1, 1))
        for row in range(5)
        for i in range(5 - row)
    }
    return level({"ground": GROUND, **boxes}, PILE)


def hung(kind: str, **rest: object) -> Level:
    """A body of 1 kg on a joint of no length."""
    joint = {"type": kind, "ends": [[0, 0], "bob"], **rest}
    return level({"bob": disc()}, GRAVITY, joints={"joint": joint})


def struck(impacts: str) -> Level:
    """A grain between two ships."""
    ship: Spec = {"mass": 1e12, "restitution": 1}
    return level(
        {
            "a": disc((0, 0), velocity=[10, 0], **ship),
            "grain": disc((2, 0), mass=1e-12, restitution=1),
            "b": disc((4, 0), **ship),
        },
        {"contact": {}, "restitution": {"impacts": impacts}},
    )


SCENES = {
    "overlaps of a quarter": lambda: pyramid(0.25),
    "overlaps of nine tenths": lambda: pyramid(0.9),
    "forty bodies in one place": lambda: level(
        {"ground": GROUND, **{f"b{i}": disc((0, 1)) for i in range(40)}}, PILE
    ),
    "elastic bodies in one place": lambda: level(
        {f"b{i}": disc(restitution=1) for i in range(20)}, SEQUENCE
    ),
    "a million metres a second": lambda: level(
        {
            "ground": GROUND,
            "a": disc((0, 1), velocity=[1e6, -1e6]),
            "b": disc((5, 1), velocity=[-1e6, 0]),
        },
        PILE,
    ),
    "a grain under a ship": lambda: level(
        {"ground": GROUND, "a": box((0, 0.25), mass=1e-12), "b": box((0, 0.75), mass=1e12)}, PILE
    ),
    "a ship under a grain": lambda: level(
        {"ground": GROUND, "a": box((0, 0.25), mass=1e12), "b": box((0, 0.75), mass=1e-12)}, PILE
    ),
    "a grain between ships": lambda: struck("together"),
    "a grain between ships, in sequence": lambda: struck("sequence"),
    "a ship on rods by a grain": lambda: level(
        {"a": disc((1, 0), mass=1e-12), "b": disc((3, 0), mass=1e12)},
        GRAVITY,
        joints={
            "r": {"type": "rod", "ends": [[0, 0], "a"]},
            "s": {"type": "rod", "ends": ["a", "b"]},
        },
    ),
    "a spring of 1e12 N/m": lambda: hung("spring", stiffness=1e12),
    "a rod of no length": lambda: hung("rod"),
    "a rope of no length": lambda: hung("rope"),
    "a pulley of no length": lambda: hung("pulley", over=[[0, 0]]),
    "a pivot of no length": lambda: hung("pivot"),
    "a spring of no length": lambda: hung("spring", stiffness=10),
    "a spring with its ends in one place": lambda: hung("spring", stiffness=10, length=1),
    "a body at the centre that attracts it": lambda: level(
        {"b": disc()}, {"attraction": [{"mu": 1}]}
    ),
    "a gravity of 1e9 m/s²": lambda: level(
        {"ground": GROUND, "b": disc((0, 0.5))},
        {"gravity": {"acceleration": [0, -1e9]}, "contact": {}},
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_it_stays_within_bounds_or_says_why_not(name: str) -> None:
    try:
        world = build(SCENES[name]())
    except SandboxError:
        return
    speed = np.abs(world.snapshot.velocity).max()
    with suppress(SandboxError):
        for _ in range(300):
            world.advance()
    now = world.snapshot
    for values in (now.position, now.velocity, now.angle, now.angular_velocity):
        assert np.isfinite(values).all()
    assert np.abs(now.position).max() < FAR
    assert np.abs(now.velocity).max() <= max(100, 3 * speed)


COINCIDENT = """
from tests.physics.scenes import GRAVITY, disc, level
from sandbox.physics.run import build

bodies = {f"b{i}": disc((0, 1)) for i in range(COUNT)}
world = build(level(bodies, {**GRAVITY, "contact": {"overlaps": True}}))
world.advance(3)
print(bool((abs(world.snapshot.position) < 100).all()), flush=True)
"""

UNFREED = """
import os

os._exit(0)
"""
"""To free a space takes pymunk as long as its shapes times its contacts: half a minute for 1000."""

HELD = """
import gc

from tests.physics.scenes import GRAVITY, disc, floor, level
from sandbox.physics.run import build

rod = {"type": "rod", "ends": [[0, 2], "bob"]}
for _ in range(20):
    scene = level({"bob": disc((0, 0.5)), "floor": floor()}, {**GRAVITY, "contact": {}},
                  joints={"rod": rod})
    world = build(scene)
    world.grab("bob", (0, 0.5))
    world.advance(200)
    assert not any(body.is_sleeping for body in world.scene.bodies.values())
    del world
    gc.collect()
print(True)
"""


@pytest.mark.sweep
@pytest.mark.parametrize(
    "code",
    [
        pytest.param(COINCIDENT.replace("COUNT", "320") + UNFREED, marks=pytest.mark.sweep),
        pytest.param(COINCIDENT.replace("COUNT", "200"), marks=pytest.mark.sweep),
        COINCIDENT.replace("COUNT", "100"),
        HELD,
    ],
    ids=[
        "almost as many in one place as may be",
        "hundreds in one place, and freed",
        "a hundred in one place, and freed",
        "at rest",
    ],
)
def test_it_does_not_end_the_interpreter(code: str) -> None:
    """pymunk can crash where what sleeps is tied to its static body; nothing ever sleeps here."""
    done = python("-c", code)

    assert (done.returncode, done.stdout.strip()) == (0, "True"), done.stderr
