"""Kinematic bodies that follow formulas are where these say, and what they hold goes with them."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from sandbox.model.errors import LevelError
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.run import simulate
from tests.physics.scenes import GRAVITY, G, box, disc, level

A, W = 0.05, 9.0  # m, rad/s: A W² is 0.41 G


def told(motion: dict[str, Any], shape: dict[str, Any] | None = None, **rest: object) -> Any:  # noqa: ANN401
    plate = {"type": "box", "width": 2, "height": 0.2}
    return {"type": "kinematic", "shape": shape or plate, "motion": motion, **rest}


def shaker(rate: float, effects: dict[str, Any] | None = None, amplitude: float = A) -> Level:
    shaken = told({"displacement": [0, f"{amplitude}*(1 - cos({W}*t))"]}, position=[0, -0.1])
    bodies = {"plate": shaken, "block": box((0, 0.25), mass=2)}
    return level(bodies, {**GRAVITY, "contact": {}, **(effects or {})}, stepping={"rate": rate})


def columns(scene: Level, duration: float, *names: str) -> list[Array]:
    trace = simulate(scene, duration=duration, record=["t", *names])
    return [trace.columns[name] for name in ("t", *names)]


@pytest.mark.sweep
@pytest.mark.parametrize("solver", ["iterative", "direct"])
def test_a_block_goes_with_the_plate_that_shakes_it(solver: str) -> None:
    """To rounding at every step, 5e-15 m; its weight swings by m A ω², of second order.

    The force is that of the second difference: smaller by (ω dt)² / 12, 2.4e-4 N of 8.1 N.
    """
    scene = shaker(480, {"contact": {"solver": solver}})
    names = ("block.position.y", "plate.position.y", "plate.velocity.y", "block.contact.normal")
    t, block, plate, speed, force = columns(scene, 2, *names)
    lift = A * (1 - np.cos(W * t))

    assert plate + 0.1 == pytest.approx(lift, abs=1e-13)
    assert block - 0.25 == pytest.approx(lift, abs=1e-13)
    assert speed == pytest.approx(A * W * np.sin(W * t), abs=4e-5)
    assert force[1:] == pytest.approx(2 * (G + A * W**2 * np.cos(W * t))[1:], abs=3e-4)


@pytest.mark.sweep
@pytest.mark.parametrize("solver", ["iterative", "direct"])
def test_the_work_of_a_shaker_is_booked(solver: str) -> None:
    """All that the block has, and no impact takes any of it: to 2e-13 J of 0.4 J."""
    scene = shaker(240, {"contact": {"solver": solver}})
    books = ("system.unexplained_energy", "system.loss.impacts", "system.unexplained_momentum")
    _, energy, lost, momentum = columns(scene, 2, *books)

    assert np.abs(energy).max() < 1e-11
    assert np.abs(lost).max() < 1e-11
    assert np.abs(momentum).max() < 1e-11


def test_a_block_leaves_a_plate_that_falls_faster_than_it_can() -> None:
    """A ω² = 1.65 g: it is thrown up as the plate slows down, where A ω² cos ωt = −g."""
    t, block, plate = columns(
        shaker(960, amplitude=0.2), 0.4, "block.position.y", "plate.position.y"
    )
    leaves = np.arccos(-G / (0.2 * W**2)) / W

    assert np.abs((block - plate - 0.35)[t < leaves]).max() < 1e-6
    assert (block - plate - 0.35)[t > leaves + 0.1].min() > 1e-3


def sprung(rate: float, damping: float) -> tuple[float, float]:
    """Return the error of a mass on a spring whose base is shaken, and what is unexplained."""
    base = told({"displacement": [f"0.1*(1 - cos({W}*t))", 0]})
    spring = {"type": "spring", "ends": ["base", "m"], "stiffness": 60, "damping": damping}
    scene = level(
        {"base": base, "m": box((2, 0), mass=1.5)},
        {},
        joints={"s": spring},
        stepping={"rate": rate},
    )
    t, x, left = columns(scene, 2, "m.position.x", "system.unexplained_energy")

    def slope(t: float, z: Array) -> list[float]:
        pull = 60 * (z[0] - 2 - 0.1 * (1 - np.cos(W * t)))
        pull += damping * (z[1] - 0.1 * W * np.sin(W * t))
        return [z[1], -pull / 1.5]

    exact = solve_ivp(slope, (0, 3), [2, 0], t_eval=t, rtol=1e-11, atol=1e-12).y[0]
    return float(np.abs(x - exact).max()), float(np.abs(left).max())


@pytest.mark.sweep
@pytest.mark.parametrize("damping", [0.0, 0.7])
def test_a_spring_that_is_shaken_is_of_second_order_and_so_are_its_books(damping: float) -> None:
    """The work of the base is booked: nothing is left but what leapfrog is too coarse for."""
    coarse, fine = sprung(120, damping), sprung(240, damping)

    for one, other in zip(coarse, fine, strict=True):
        assert one / other == pytest.approx(4, rel=0.1)
    assert fine[0] < 2e-4


@pytest.mark.sweep
def test_a_pendulum_swings_from_a_pivot_that_is_moved() -> None:
    """l θ'' = −(g + a) sin θ for a pivot that goes up with a; the rod holds all the same."""
    pivot = told({"displacement": [0, "0.1*(1 - cos(5*t))"]}, {"type": "disc", "radius": 0.05})
    bodies = {"pivot": pivot, "bob": disc((0.6, -0.8), radius=0.1)}
    rod = {"type": "rod", "ends": ["pivot", "bob"]}

    def worst(rate: float) -> float:
        scene = level(bodies, GRAVITY, joints={"rod": rod}, stepping={"rate": rate})
        t, x, length, left = columns(
            scene, 3, "bob.position.x", "rod.length", "system.unexplained_energy"
        )
        start = [np.arctan2(0.6, 0.8), 0.0]
        swing = solve_ivp(
            lambda t, z: [z[1], -(G + 2.5 * np.cos(5 * t)) * np.sin(z[0])],
            (0, 4), start, t_eval=t, rtol=1e-11, atol=1e-12,
        )  # fmt: skip
        assert length == pytest.approx(1, abs=1e-12)
        assert np.abs(left).max() < 1e-2
        return float(np.abs(x - np.sin(swing.y[0])).max())

    assert worst(240) / worst(480) == pytest.approx(4, rel=0.1)
    assert worst(480) < 2e-3


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        ({"motion": {"displacement": ["1 + t", 0]}}, "is 1 m at the start, but must be 0"),
        ({"motion": {"displacement": ["sqrt(t)", 0]}}, "no finite velocity at the start"),
        ({"motion": {"turn": "where(t < 0.5, 0, 1)"}}, "the motion jumps by 1 rad at t = 0.5 s"),
        ({"motion": {"turn": "1/(t - 0.5) + 2"}}, "has no finite value at t = 0.5 s"),
        ({"motion": {"turn": "t"}, "velocity": [1, 0]}, "already determines the velocity"),
        ({"type": "static"}, "a static body has no motion"),
        ({"type": "dynamic", "mass": 1}, "a dynamic body has no motion"),
    ],
)
def test_a_motion_that_cannot_be_is_told(change: dict[str, Any], rule: str) -> None:
    plate = {**told({"turn": "t"}), **change}
    with pytest.raises(LevelError, match=rule):
        level({"plate": plate, "ball": disc((0, 3))}, GRAVITY, duration=1)


def test_a_motion_rules_out_fourth_order() -> None:
    with pytest.raises(LevelError, match="which rules out the motion of 'plate'"):
        level(
            {"plate": told({"turn": "t"}), "ball": disc((0, 3))},
            GRAVITY,
            stepping={"scheme": "fourth-order"},
        )
