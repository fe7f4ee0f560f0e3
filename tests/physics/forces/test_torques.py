"""Torques between bodies turn both, store what springs do, and are refused where they cannot be."""

from typing import Any

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import disc, level

Said = dict[str, Any]


def wheels(effects: Said, rate: float = 240, **rest: object) -> Level:
    """Return two wheels of 0.5 and 12.5 kg m², of which one turns."""
    bodies = {
        "small": disc((0, 0), angular_velocity=2, moment=0.5),
        "large": disc((3, 0), moment=12.5),
    }
    return level(bodies, {"rotation": {}, **effects}, stepping={"rate": rate}, **rest)


@pytest.mark.sweep
def test_a_torsion_spring_between_two_bodies_keeps_their_angular_momentum_and_energy() -> None:
    """Relative to each other they swing with ω² = k (1 / I + 1 / J); order 2."""
    record = ["t", "small.angle", "large.angle", "system.angular_momentum"]
    record += ["system.unexplained_energy", "system.potential_energy.torsion"]
    spring = {"torsion": [{"body": "small", "against": "large", "stiffness": 3}]}

    def error(rate: float) -> float:
        found = simulate(wheels(spring, rate), duration=4, record=record).columns
        omega = np.sqrt(3 * (1 / 0.5 + 1 / 12.5))
        twist = found["small.angle"] - found["large.angle"]
        assert np.ptp(found["system.angular_momentum"]) < 1e-13
        assert np.abs(found["system.unexplained_energy"]).max() < 1e-3
        assert found["system.potential_energy.torsion"] == pytest.approx(1.5 * twist**2, abs=1e-12)
        return float(np.abs(twist - 2 / omega * np.sin(omega * found["t"])).max())

    assert error(120) / error(240) == pytest.approx(4, rel=0.05)
    assert error(240) < 1e-4


@pytest.mark.sweep
def test_a_brake_between_two_wheels_takes_them_to_one_rate() -> None:
    """I ω / (I + J), whatever the brake does in between; it works on both, and all is booked.

    The books begin half a kick after the start: 0.4 N m · 2 rad/s · dt / 2 is not in them.
    """
    brake = {
        "torque": [
            {"body": "small", "against": "large", "torque": "-sign(omega)*min(0.4, 9*abs(omega))"}
        ]
    }
    record = ["small.angular_velocity", "large.angular_velocity", "system.work.torque"]
    found = simulate(
        wheels(brake), duration=6, record=[*record, "system.unexplained_energy"]
    ).columns
    together = 0.5 * 2 / 13

    assert found["small.angular_velocity"][-1] == pytest.approx(together, rel=1e-9)
    assert found["large.angular_velocity"][-1] == pytest.approx(together, rel=1e-9)
    assert found["system.work.torque"][-1] == pytest.approx(13 / 2 * together**2 - 1, abs=2e-3)
    assert np.abs(found["system.unexplained_energy"]).max() < 1e-12


@pytest.mark.sweep
def test_a_torque_against_what_moves_as_told_is_work_of_that() -> None:
    """A clutch on a shaft that turns at 5 rad/s: what the wheel gains and the clutch takes.

    That of the first half kick, 2 per mille, is before the books are opened.
    """
    shaft = {"type": "kinematic", "shape": {"type": "disc", "radius": 0.2}, "angular_velocity": 5}
    clutch = {
        "torque": [{"body": "wheel", "against": "shaft", "torque": "-0.5*omega"}],
        "rotation": {},
    }
    scene = level(
        {"shaft": shaft, "wheel": disc((2, 0), moment=0.5)}, clutch, stepping={"rate": 240}
    )
    record = ["t", "wheel.angular_velocity", "system.work.bodies", "system.work.torque"]
    found = simulate(scene, duration=20, record=[*record, "system.unexplained_energy"]).columns

    assert found["wheel.angular_velocity"] == pytest.approx(5 - 5 * np.exp(-found["t"]), abs=2e-5)
    assert found["system.work.bodies"][-1] == pytest.approx(12.5, rel=3e-3)
    assert np.abs(found["system.unexplained_energy"]).max() < 1e-11


def test_a_brake_that_would_throw_a_wheel_back_is_refused_with_the_rate_it_needs() -> None:
    """c (1 / I + 1 / J) is 2080 a second for c = 1000, of which a step may take all."""
    brake = {"torque": [{"body": "small", "against": "large", "torque": "-1000*omega"}]}
    with pytest.raises(
        SimulationError, match="the effect 'torque' on 'small' needs a 'rate' of at least 2,0"
    ):
        build(wheels(brake))
    build(wheels(brake, rate=2090))


@pytest.mark.parametrize(
    ("effects", "told"),
    [
        ({"torsion": [{"body": "a", "against": "a", "stiffness": 1}], "rotation": {}}, "itself"),
        ({"torque": [{"body": "a", "torque": 1}]}, "'torque' is used but the effect 'rotation'"),
        ({"torque": [{"body": "a", "torque": "x"}], "rotation": {}}, "unknown parameter 'x'"),
    ],
)  # fmt: skip
def test_a_torque_that_cannot_be_is_told(effects: Said, told: str) -> None:
    with pytest.raises(LevelError, match=told):
        level({"a": disc(), "b": disc((3, 0))}, effects)
