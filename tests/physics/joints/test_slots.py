"""Slots turn with their body, hold to rounding, and exchange momentum with it."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import sandbox
from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build
from tests.physics.scenes import disc, level

SPIN = 2.0  # rad/s
HALF = 0.5  # m, half the length of the rod


def rod(**more: Any) -> dict[str, Any]:  # noqa: ANN401
    """A rod of 3 kg along its own x axis."""
    shape = {"type": "segment", "start": [-HALF, 0], "end": [HALF, 0]}
    return {"shape": shape, "mass": 3, **more}


def slot(at: tuple[float, float] = (0, 0), way: tuple[float, float] = (1, 0)) -> dict[str, Any]:
    return {"type": "slot", "ends": ["bead", {"body": "rod", "at": list(at)}], "direction": way}


def whirling(rate: int) -> Level:
    """A bead 0.1 m from the pin of a rod that turns freely."""
    bodies = {
        "rod": rod(angular_velocity=SPIN),
        "bead": disc((0.1, 0), mass=0.5, velocity=[0, 0.1 * SPIN], radius=0.05, moment=1e-9),
    }
    ties = {"pin": {"type": "pivot", "ends": ["rod", [0, 0]]}, "slot": slot()}
    return level(bodies, {"rotation": {}}, joints=ties, stepping={"rate": rate})


@pytest.mark.parametrize("rate", [120, 240])
def test_a_bead_on_a_free_rod_slows_it_down(rate: int) -> None:
    """(I + m r²) ω is kept, and r̈ = ω² r: of second order, as the energy is (6.6e-6 of 0.5 J)."""
    inertia, mass = 3 * HALF**2 / 3, 0.5
    spin = (inertia + mass * 0.1**2) * SPIN
    motion = solve_ivp(
        lambda _, s: (s[1], (spin / (inertia + mass * s[0] ** 2)) ** 2 * s[0]),
        (0, 0.8),
        (0.1, 0.0),
        rtol=1e-11,
        atol=1e-12,
    )
    world = build(whirling(rate))
    books = Ledger(world)
    for _ in range(int(0.8 * rate)):
        world.advance()
        books.note()
    (x, y), angle = world.snapshot.position[1], world.snapshot.angle[0]

    assert np.hypot(x, y) == pytest.approx(motion.y[0, -1], abs=2e-5 * (120 / rate) ** 2)
    assert abs(y * np.cos(angle) - x * np.sin(angle)) < 1e-14
    assert abs(books.balance.unexplained) < 1e-5 * (120 / rate) ** 2


def test_a_slot_off_the_centre_keeps_momentum() -> None:
    """Two free bodies: nothing from outside acts on them."""
    bodies = {
        "rod": rod(angular_velocity=SPIN, angle=0.3),
        "bead": disc((0.3, 0.5), mass=0.5, velocity=[1, -1], radius=0.05),
    }
    start = build(level(bodies, {"rotation": {}})).snapshot
    turned = np.exp(-0.3j) * complex(*start.position[1])
    ties = {"slot": slot((turned.real - 0.2, turned.imag + 0.1), (2, -1))}
    world = build(level(bodies, {"rotation": {}}, joints=ties))
    books = Ledger(world)
    for _ in range(120):
        world.advance()
        books.note()
    end = world.snapshot
    way = complex(2, -1) / abs(complex(2, -1))
    apart = np.exp(-1j * end.angle[0]) * (complex(*end.position[1]) - complex(*end.position[0]))

    assert abs(((apart - turned) * way.conjugate()).imag) < 1e-13
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-12


@pytest.mark.parametrize("phase", [0.0, 1.0])
def test_a_crank_swings_a_slotted_lever(phase: float) -> None:
    """The lever points from its pin to the crank's: tan θ = r sin φ / (d + r cos φ)."""
    far, radius, rate = 1.0, 0.4, 3.0
    pin = far + radius * np.exp(1j * phase)
    bodies = {
        "rod": rod(angle=np.angle(pin)),
        "bead": disc((far, 0), radius=0.4, mass=1, angle=phase),
    }
    ends = [{"body": "bead", "at": [radius, 0]}, "rod"]
    ties = {
        "hinge": {"type": "pivot", "ends": ["rod", [0, 0]]},
        "crank": {"type": "motor", "ends": [[far, 0], "bead"], "rate": rate},
        "slot": {"type": "slot", "ends": ends, "direction": [1, 0]},
    }
    world = build(level(bodies, {"rotation": {}}, joints=ties))
    for _ in range(60):
        state = world.advance()
        turned = far + radius * np.exp(1j * (phase + rate * state.t))
        assert state.angle[0] == pytest.approx(np.angle(turned), abs=1e-12)


def test_a_copy_of_a_group_takes_its_slot_along() -> None:
    """The direction is along the axes of the body, which the copy turns."""
    bodies = {"rod": rod(), "bead": disc((0.2, 0), mass=0.5, velocity=[1, 0], radius=0.05)}
    group = {"bodies": bodies, "joints": {"slot": slot()}}
    made = sandbox.make(
        {
            "format": 1,
            "title": "Copy",
            "groups": {"pair": group},
            "bodies": {"one": {"copy": "pair", "angle": "90*deg"}},
            "effects": {"rotation": {}},
        }
    )
    end = build(made).advance(60)

    assert end.position[1] == pytest.approx([0, 1.2], abs=1e-12)


def test_a_bead_beside_its_slot_is_refused() -> None:
    bodies = {"rod": rod(angle=0.5), "bead": disc((0.2, 0))}
    with pytest.raises(LevelError, match=r"must start in the slot, but it is 0\.0958851 m away"):
        level(bodies, {"rotation": {}}, joints={"slot": slot()})
