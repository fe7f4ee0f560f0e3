"""Drifts in parts: what has no solution through a whole step has one through a part of it."""

from itertools import pairwise

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.contacts.direct import solver
from sandbox.physics.contacts.direct.drifts import fallback_subdivision
from sandbox.physics.contacts.direct.kicks.kick_records import KickResult
from sandbox.physics.contacts.direct.kicks.kick_with_impacts import KickStart, solve_kick
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solver import DirectSolver
from sandbox.physics.contacts.direct.solving.warm_start import WarmStart
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import NoForces, SimulationError
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, level

EFFECTS = {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}}
PLANK = 0.6


def hanging_bridge(wheel: float, rate: float, planks: int = 10, duration: float = 0.5) -> Level:
    """Planks of 1 kg, hinged in a row, that fall into their rods, and a wheel on them."""
    names = [f"plank{i}" for i in range(planks)]
    width = planks * PLANK
    bodies: dict[str, Spec] = {
        name: box(((i + 0.5) * PLANK - width / 2, 3), size=(PLANK - 0.02, 0.06), friction=0.9)
        for i, name in enumerate(names)
    }
    left, right = {"at": [-PLANK / 2, 0]}, {"at": [PLANK / 2, 0]}
    joints: dict[str, Spec] = {
        f"hinge{i}": {"type": "pivot", "ends": [{"body": a, **right}, {"body": b, **left}]}
        for i, (a, b) in enumerate(pairwise(names))
    }
    for name, end, side in (("first", left, -1), ("last", right, 1)):
        plank = names[0 if side < 0 else -1]
        far = [side * (width / 2 + 0.5), 3.2]
        joints[name] = {"type": "rod", "ends": [{"body": plank, **end}, far]}
    bodies["wheel"] = disc(
        (0.5 - width / 2, 3.33), radius=0.3, mass=wheel, friction=0.9,
        velocity=[1.5, 0], angular_velocity=-5,
    )  # fmt: skip
    return level(bodies, EFFECTS, joints=joints, stepping={"rate": rate}, duration=duration)


@pytest.mark.sweep
def test_a_wheel_whips_light_planks_straight_and_rolls_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """At whose jerks the equations of a whole step have no solution."""
    scene = hanging_bridge(50, 480)
    world, divided = build(scene), set[int]()
    for _ in range(240):
        world.advance()
        direct = world.scene.direct
        assert direct
        if direct.drifts.drift_after and direct.drifts.drift_after.first_fraction < 1:  # no landing
            divided.add(len(direct.drifts.drift_after.kicks_between))
        assert world.scene.joints.parting()[1] < 1e-9
    assert divided

    monkeypatch.setattr(fallback_subdivision, "PARTS", (1,))
    with pytest.raises(SimulationError, match=r"no forces were found|nothing keeps"):
        build(scene).advance(240)


@pytest.mark.sweep
@pytest.mark.parametrize(("wheel", "rate"), [(50, 480), (200, 1920)])
def test_a_bridge_gains_no_energy_by_it(wheel: float, rate: float) -> None:
    trace = simulate(hanging_bridge(wheel, rate), record=["system.energy"], books=True)
    energy = trace.columns["system.energy"]

    assert energy.max() <= energy[0] * (1 + 1e-9)
    assert trace.closing
    assert abs(trace.closing.unexplained) <= trace.closing.bound


def double_pendulum(rate: float) -> Level:
    """A heavy bob on two rods; it could touch its elbow, and so contacts are solved with them."""
    return level(
        {"elbow": disc((0.6, 2.2), radius=0.1), "bob": disc((1.4, 2.2), radius=0.1, mass=20)},
        {**GRAVITY, "contact": {"solver": "direct"}},
        joints={
            "arm": {"type": "rod", "ends": [[0, 3], "elbow"]},
            "forearm": {"type": "rod", "ends": ["elbow", "bob"]},
        },
        stepping={"rate": rate},
    )


def end(rate: float) -> Array:
    """Return where elbow and bob are after half a second: (2, 2) [m]."""
    return build(double_pendulum(rate)).advance(round(rate / 2)).position


def in_two(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every drift be taken in two parts."""

    def refuse(
        kick: Kick, start: KickStart, warm_start: WarmStart, *, placed: bool = False
    ) -> KickResult:
        if kick.joints.drift == start.step and start.lead > 0:
            raise NoForces(0, 1)
        return solve_kick(kick, start, warm_start, placed=placed)

    def together(direct: DirectSolver, _until: float) -> None:
        direct._solve_all()

    monkeypatch.setattr(solver, "solve_kick", refuse)
    monkeypatch.setattr(DirectSolver, "_solve_joints", together)


@pytest.mark.sweep
def test_a_drift_in_two_parts_is_as_close_as_two_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """If every drift is divided: an error of second order falls to a quarter."""
    exact = end(3840)
    whole, half = (np.abs(end(rate) - exact).max() for rate in (60, 120))

    in_two(monkeypatch)
    world = build(double_pendulum(60))
    divided = np.abs(world.advance(30).position - exact).max()

    assert world.scene.direct
    assert world.scene.direct.drifts.drift_after
    assert len(world.scene.direct.drifts.drift_after.kicks_between) == 2
    assert half < whole / 3.5
    assert divided == pytest.approx(half, rel=0.2)


def booked(rate: float) -> tuple[float, float]:
    """Return what is unexplained of energy [J] and momenta after half a second, at the most."""
    world = build(double_pendulum(rate))
    ledger, energy, momentum = Ledger(world), 0.0, 0.0
    for _ in range(round(rate / 2)):
        world.advance()
        ledger.note()
        energy = max(energy, abs(ledger.balance.unexplained))
        momentum = max(momentum, float(np.abs(ledger.balance.unexplained_impulse).max()))
    return energy, momentum


def test_the_books_of_drifts_in_two_parts_close_as_those_of_two_steps(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """They leave 1.5 J of 200; read as one whole drift, whose velocity no part has, 5.9 J."""
    (whole, _), (half, _) = booked(60), booked(120)

    in_two(monkeypatch)
    divided, momentum = booked(60)

    assert half < whole / 2.5
    assert divided < 1.5 * half
    assert momentum < 1e-12 * 20 * G


def test_joints_alone_go_on_from_the_last_part_of_a_drift(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not from the mean velocity of all its parts: that took 0.13 kg m/s away."""
    world = build(double_pendulum(60))
    world.advance(10)
    ledger = Ledger(world)
    with monkeypatch.context() as patch:
        in_two(patch)
        world.advance()
        ledger.note()
    direct = world.scene.direct
    assert direct
    assert direct.drifts.drift_after
    world.advance()
    ledger.note()

    assert direct.drifts.drift_before
    assert np.abs(ledger.balance.unexplained_impulse).max() < 1e-12 * 20 * G
