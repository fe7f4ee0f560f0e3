"""Corners that come down within a step are met there, and not where the step ends."""

from math import radians

import numpy as np
import pytest

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, Spec, box, fixed, level

DIRECT: Spec = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
GROUND = fixed({"type": "box", "width": 40, "height": 1}, (0, -0.5), friction=0.7)

KNOWN = 1e-6
"""J: 20 boxes of 1 kg weigh 196 N, and heights are known to some 1e-9 m."""


def shoved(speed: float, rate: float) -> World:
    """Return a stack of 20 boxes of 0.5 m, the eleventh of which is shoved [m/s]."""
    boxes = {f"box{i}": box((0, 0.25 + 0.5 * i), friction=0.7) for i in range(20)}
    boxes["box10"]["velocity"] = [speed, 0]
    return build(level({"ground": GROUND, **boxes}, DIRECT, stepping={"rate": rate}))


def rocking(angle: float, rate: float, e: float = 0.0) -> World:
    """Return a box of 0.5 m that stands on a corner, and falls back on its side."""
    tilt = radians(angle)
    height = 0.25 * (np.cos(tilt) + np.sin(tilt))
    bounces: Spec = {"restitution": e} if e else {}
    scene = {
        "ground": {**GROUND, **bounces},
        "box": {**box((0, height), angle=tilt, friction=0.7), **bounces},
    }
    effects = {**DIRECT, **({"restitution": {}} if e else {})}
    return build(level(scene, effects, stepping={"rate": rate}))


def energies(world: World, steps: int) -> np.ndarray:
    """Return the energies in the books after so many steps, between each and the next [J]."""
    ledger, found = Ledger(world), []
    for _ in range(steps):
        world.advance()
        ledger.note()
        balance = ledger.balance
        found.append(balance.kinetic + sum(balance.potential.values()))
    return np.array(found)


def grown(energy: np.ndarray) -> float:
    """Return by how much it grows again, at the most."""
    return float((energy - np.minimum.accumulate(energy)).max())


def lowest(seen: Snapshot) -> float:
    """Return how high the lowest corner of the box is [m]."""
    turned = np.exp(1j * seen.angle[-1]) * np.array([1 + 1j, 1 - 1j, -1 + 1j, -1 - 1j]) * 0.25
    return float(seen.position[-1, 1] + turned.imag.min())


@pytest.mark.parametrize(("speed", "rate"), [(0.03, 480), (0.1, 240), (0.2, 60)])
def test_a_stack_that_is_shoved_gains_no_energy_and_comes_to_rest(speed: float, rate: int) -> None:
    """Found where the step ended, corners gave 1e-3, 3e-2 and 6e-4 J, for up to 0.7 s."""
    world = shoved(speed, rate)

    assert grown(energies(world, rate // 10)) <= KNOWN
    assert np.abs(world.snapshot.velocity).max() <= 1e-9


@pytest.mark.parametrize("rate", [60, 240, 960])
def test_a_corner_that_comes_down_stops_at_the_floor(rate: int) -> None:
    """Met where the step ends it was 9.2, 2.0 and 0.24 mm deep, and lifted again."""
    world = rocking(10, rate)

    deepest = min(lowest(world.advance()) for _ in range(rate // 2))
    assert deepest >= -1e-7
    assert abs(world.snapshot.angular_velocity[-1]) <= 1e-9


@pytest.mark.parametrize("rate", [60, 240])
def test_what_falls_back_on_its_side_gains_no_energy(rate: int) -> None:
    """It gained 1.9e-2 and 2.2e-3 J."""
    assert grown(energies(rocking(10, rate), rate // 2)) <= 1e-7


def test_what_would_go_right_through_lands_on_its_foremost_side() -> None:
    """At 1000 g a box of 1 m falls 11 m in a step: four of its corners come through a side."""
    heavy: Spec = {**DIRECT, "gravity": {"acceleration": [0, -9810.0]}}
    boxes = {f"box{i}": box((0, y), size=(1, 1), friction=0.6) for i, y in enumerate((0.5, 33.5))}
    world = build(level({"ground": GROUND, **boxes}, heavy, stepping={"rate": 60}))

    seen = world.advance(8)

    assert seen.position[2, 1] == pytest.approx(1.5, abs=1e-7)


def test_what_bounces_on_its_corners_does_so_to_second_order() -> None:
    """With impacts where the step ends, the angles differed by 9e-3 and 3e-3 rad."""
    angles = [
        rocking(10, rate, e=0.9).advance(round(0.45 * rate)).angle[-1] for rate in (60, 240, 960)
    ]
    coarse, fine = np.abs(np.diff(angles))

    assert coarse <= 3e-4
    assert coarse / fine >= 14
