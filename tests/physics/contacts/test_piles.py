"""Piles: they settle before the first step, stand, and fall the same way every time."""

import hashlib

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.level import Level, Stepping
from sandbox.physics.run import build
from tests.elsewhere import python
from tests.physics.scenes import GRAVITY, Spec, box, floor, level

PILES: Spec = {"piles": True}


def stack(count: int, contact: Spec, rate: float = 60, iterations: int = 10) -> Level:
    boxes = {f"box{i}": box((0, 0.5 + i), size=(1, 1), friction=0.7) for i in range(count)}
    return level(
        {**boxes, "floor": floor(friction=1)},
        {**GRAVITY, "contact": contact, "friction": {}, "rotation": {}},
        stepping={"rate": rate, "iterations": iterations},
    )


def drift(scene: Level, seconds: float) -> float:
    """Return how far the box that strayed most went [m]."""
    world = build(scene)
    start = world.snapshot.position
    strayed = [
        np.hypot(*(world.advance(round(scene.stepping.rate)).position - start).T).max()
        for _ in range(round(seconds))
    ]
    return float(max(strayed))


@pytest.mark.sweep
@pytest.mark.parametrize("contact", [PILES, {}])
def test_a_stack_of_ten_settles_before_its_first_step(contact: Spec) -> None:
    """With ten sweeps a kick it is let go with 1e-4 m/s, and falls within seconds."""
    assert drift(stack(10, contact), 20) <= 1e-9  # 1e-13


SWEPT: Spec = {"solver": "iterative"}


@pytest.mark.parametrize(("count", "direct"), [(10, True), (60, True), (120, False)])
def test_what_sweeps_do_not_settle_is_solved_directly(count: int, *, direct: bool) -> None:
    """Ten boxes because they are few, sixty as they do not settle; 120 are too high for either."""
    assert (build(stack(count, {})).scene.direct is not None) is direct


@pytest.mark.parametrize("count", [15, 60])
def test_a_level_that_chooses_its_solver_keeps_it(count: int) -> None:
    assert not build(stack(count, SWEPT)).scene.direct
    swept = build(stack(count, {}), stepping=Stepping(solver="iterative"))
    assert not swept.scene.direct


@pytest.mark.parametrize("rate", [60, 240])
def test_a_tower_of_thirty_stands(rate: float) -> None:
    """Left to sweeps, it falls at either rate."""
    assert drift(stack(30, {}, rate), 3) <= 1e-9  # 2e-12


@pytest.mark.sweep
@pytest.mark.parametrize(("rate", "lean"), [(60, 1.0), (240, 0.1)])
def test_left_to_sweeps_it_falls(rate: float, lean: float) -> None:
    assert drift(stack(30, SWEPT, rate), 6) > lean


@pytest.mark.sweep
def test_a_stack_of_fifteen_stands_for_a_minute() -> None:
    """For an hour, too, it stays within the same 6 mm."""
    assert drift(stack(15, {**PILES, **SWEPT}, 240, 30), 60) < 0.01


@pytest.mark.sweep
def test_without_settings_for_piles_it_is_stirred() -> None:
    """The check above can fail."""
    assert drift(stack(15, SWEPT, 240, 30), 60) > 0.02


@pytest.mark.parametrize("size", [0.1, 1.0])
def test_the_slop_of_piles_is_of_the_size_of_their_bodies(size: float) -> None:
    boxes = {"box": box((0, size / 2), size=(3 * size, size)), "floor": floor()}
    world = build(level(boxes, {**GRAVITY, "contact": PILES}))
    assert world.scene.space.collision_slop == pytest.approx(0.005 * size, rel=1e-6)


def test_a_slop_beside_piles_is_refused() -> None:
    with pytest.raises(LevelError, match="'piles' already chooses the 'slop'"):
        stack(1, {"piles": True, "slop": 1e-3})


def fallen() -> str:
    """Return a hash of where 144 boxes are after 600 steps: a wall that a heavy one falls on."""
    boxes = {
        f"box{i}": box((1.01 * (i % 12), 0.5 + i // 12), size=(1, 1), friction=0.5)
        for i in range(143)
    }
    boxes["heavy"] = box((6.3, 20), size=(2, 2), mass=50, angle=0.3, friction=0.5)
    scene = level(
        {**boxes, "floor": floor(friction=1)},
        {**GRAVITY, "contact": PILES, "friction": {}, "rotation": {}},
    )
    end = build(scene).advance(600)
    return hashlib.sha256(end.position.tobytes() + end.velocity.tobytes()).hexdigest()


@pytest.mark.sweep
def test_144_boxes_fall_the_same_way_every_time_and_everywhere() -> None:
    here = [fallen() for _ in range(3)]
    code = "from tests.physics.contacts.test_piles import fallen; print(fallen())"
    there = python("-c", code)

    assert set(here) == {there.stdout.strip()}, there.stderr
