"""What turns velocities does no work: speeds are kept to rounding, however long it acts."""

from dataclasses import dataclass
from math import log2

import numpy as np
import pytest

from sandbox.model.effects import EFFECTS, Effects
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.forces import declared_laws, velocity_rotation
from sandbox.physics.forces.law import Law, LawInputs, VelocityRotation
from sandbox.physics.run import build
from sandbox.physics.state.motion import Motion
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, disc, level, measured, run

OMEGA = 2.0
"""rad/s, at which velocities turn."""


@dataclass(frozen=True)
class Field:
    """Turns all velocities at a rate that may grow with x and with the spin."""

    omega: float
    growth: float = 0.0
    effect: Effect = EFFECTS["force"]
    spin: float = 0.0

    def rate(self, motion: Motion) -> Array:
        grown = self.growth * motion.position[..., 0] + self.spin * motion.angular_velocity
        return self.omega + grown


@pytest.fixture
def field(monkeypatch: pytest.MonkeyPatch) -> list[VelocityRotation]:
    """Something that turns velocities beside whatever a level declares."""
    turns: list[VelocityRotation] = [Field(OMEGA)]

    def with_field(
        effects: Effects, given: LawInputs
    ) -> tuple[tuple[Law, ...], tuple[VelocityRotation, ...]]:
        return declared_laws.laws(effects, given)[0], tuple(turns)

    monkeypatch.setattr("sandbox.physics.scene.make_scene.laws", with_field)
    return turns


def ball(effects: Spec | None = None, rate: float = 60, **rest: object) -> Level:
    """A ball that moves to the right at 3 m/s; a turn without strength lets momentum be booked."""
    pushed = {"force": [{"body": "ball", "force": [0, "0*t"]}]}
    bodies = {"ball": disc(velocity=[3, 0], mass=2)}
    return level(bodies, {**pushed, **(effects or {})}, stepping={"rate": rate}, **rest)


@pytest.mark.sweep
@pytest.mark.usefixtures("field")
def test_the_speed_is_kept_to_rounding_over_ten_thousand_steps() -> None:
    speed = np.hypot(*run(build(ball()), 10_000).velocity[:, 0].T)

    assert np.abs(speed / 3 - 1).max() < 1e-12  # 6e-15


@pytest.mark.usefixtures("field")
def test_velocities_turn_as_fast_as_they_should_at_any_step() -> None:
    seen = run(build(ball(rate=10)), 600)
    vx, vy = seen.velocity[:, 0].T

    assert np.abs(vx - 3 * np.cos(OMEGA * seen.t)).max() < 1e-11
    assert np.abs(vy - 3 * np.sin(OMEGA * seen.t)).max() < 1e-11


def circle_error(rate: float) -> float:
    """The way is a circle of 3/ω m about (0, 3/ω)."""
    seen, radius = run(build(ball(rate=rate)), round(5 * rate)), 3 / OMEGA
    angle = OMEGA * seen.t
    expected = np.stack((radius * np.sin(angle), radius * (1 - np.cos(angle))), axis=1)
    return float(np.abs(seen.position[:, 0] - expected).max())


@pytest.mark.usefixtures("field")
def test_a_circle_is_of_second_order() -> None:
    assert circle_error(60) < 1e-3  # 1.4e-4: (ω h)² / 24 of 3 m
    assert log2(circle_error(60) / circle_error(120)) >= 1.95  # 2.00


def drift_error(rate: float) -> float:
    """Gravity across a field: a cycloid, whose mean velocity is g/ω along the level.

    From rest, x = (g/ω²) (ω t − sin ω t), y = −(g/ω²) (1 − cos ω t), for v' = g + ω J v.
    """
    this = level(
        {"ball": disc(mass=2)},
        {**GRAVITY, "force": [{"body": "ball", "force": [0, "0*t"]}]},
        stepping={"rate": rate},
    )
    seen = run(build(this), round(3 * rate))
    angle = OMEGA * seen.t
    way = np.stack((angle - np.sin(angle), np.cos(angle) - 1), axis=1) * G / OMEGA**2
    return float(np.abs(seen.position[:, 0] - way).max())


@pytest.mark.usefixtures("field")
def test_gravity_across_a_field_drives_a_cycloid_of_second_order() -> None:
    assert drift_error(60) < 1e-2
    assert log2(drift_error(60) / drift_error(120)) >= 1.95


@pytest.mark.sweep
def test_a_field_that_is_not_uniform_keeps_the_speed_too(field: list[VelocityRotation]) -> None:
    field[:] = [Field(OMEGA, growth=0.7)]
    speed = np.hypot(*run(build(ball()), 10_000).velocity[:, 0].T)

    assert np.abs(speed / 3 - 1).max() < 1e-12


def spin_error(rate: float) -> float:
    """A torque speeds up the spin, ω = ω0 + α t, and the velocity turns by k (ω0 t + α t²/2)."""
    disc_spins = disc(velocity=[3, 0], mass=2, moment=2, angular_velocity=4)
    torque = {"torque": [{"body": "ball", "torque": 3}]}
    this = level({"ball": disc_spins}, {"rotation": {}, **torque}, stepping={"rate": rate})
    seen = run(build(this), round(2 * rate))
    turned = 0.35 * (4 * seen.t + 1.5 * seen.t**2 / 2)
    way = 3 * np.stack((np.cos(turned), np.sin(turned)), axis=1)
    return float(np.abs(seen.velocity[:, 0] - way).max())


def test_a_rate_that_follows_a_spin_is_that_at_the_step(field: list[VelocityRotation]) -> None:
    """Such as that of the Magnus force, F = S ω × v. Half a step late, it would err by 0.16 m/s."""
    field[:] = [Field(0.0, spin=0.35)]

    assert spin_error(10) < 1e-11


def test_two_fields_turn_as_fast_as_both(field: list[VelocityRotation]) -> None:
    field[:] = [Field(0.5), Field(1.5)]
    both = build(ball()).advance(100).velocity
    field[:] = [Field(2.0)]

    assert build(ball()).advance(100).velocity == pytest.approx(both, rel=1e-13)


def swing(rate: float) -> float:
    """By how much the energy of a pendulum swings that goes right round [J]."""
    bodies = {"ball": disc((1, 0), velocity=[0, 7], mass=2)}
    pushed = {"force": [{"body": "ball", "force": [0, "0*t"]}]}
    rod = {"type": "rod", "ends": ["ball", [0, 0]]}
    this = level(bodies, {**GRAVITY, **pushed}, joints={"rod": rod}, stepping={"rate": rate})
    return float(np.ptp(measured(build(this), round(3 * rate), "system.energy")["system.energy"]))


@pytest.mark.sweep
@pytest.mark.usefixtures("field")
def test_a_rod_in_a_field_is_of_second_order() -> None:
    """The rotation is about the velocity that the rod's own pull belongs to, by its last pull.

    Without that it would be of first order: at 240 Hz the energy would swing by 6 J, not 0.004.
    """
    assert swing(240) < 0.02
    assert log2(swing(240) / swing(480)) > 1.9


def booked(world: World, steps: int) -> Ledger:
    books = Ledger(world)
    for _ in range(steps):
        world.advance()
        books.note()
    return books


@pytest.mark.usefixtures("field")
@pytest.mark.parametrize("effects", [{}, {"drag": {"linear": 0.5}}, GRAVITY], ids=str)
def test_a_field_gives_momentum_and_no_energy(effects: Spec) -> None:
    books = booked(build(ball(effects, rate=240)), 500).balance

    assert np.abs(books.impulse["force"][:2]).max() > 1
    assert np.abs(books.unexplained_impulse[:2]).max() < 1e-11
    assert abs(books.unexplained) < 1e-11
    assert books.work["force"] == 0


def test_what_turns_too_fast_for_a_step_is_refused(field: list[VelocityRotation]) -> None:
    """2 rad a step, as springs go up to ω h = 2."""
    field[:] = [Field(121.0)]

    with pytest.raises(SimulationError, match="on 'ball' needs a 'rate' of at least 61, not 60"):
        build(ball())


def test_without_its_rotation_the_same_force_would_not_keep_the_speed() -> None:
    """As a force at the velocity before the kick, each step adds (ω h)² / 2 to it."""
    velocity, h, rate = np.array([[3.0, 0.0]]), 1 / 60, np.array([OMEGA])
    for _ in range(100):
        velocity = velocity + h * OMEGA * np.column_stack((-velocity[:, 1], velocity[:, 0]))
    assert np.hypot(*velocity[0]) > 3.1

    velocity = np.array([[3.0, 0.0]])
    for _ in range(100):
        velocity = velocity + h * velocity_rotation.turning_acceleration(
            rate, velocity, np.zeros((1, 2)), h
        )
    assert np.hypot(*velocity[0]) == pytest.approx(3, rel=1e-13)
