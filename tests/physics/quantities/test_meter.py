"""Every named quantity against its definition, on one state and on a run."""

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.model.quantities import QuantityError, quantities
from sandbox.physics.measuring import recording
from sandbox.physics.quantities import meter
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build, simulate
from sandbox.physics.state.motion import kinetic_energy
from sandbox.physics.state.snapshot import Snapshot
from tests.physics.scenes import GRAVITY, G, atwood, box, disc, fixed, level, run

SCENE = level(
    {
        "wheel": disc((1, 2), mass=2, velocity=[3, 4], angular_velocity=5),
        "post": fixed({"type": "disc", "radius": 0.1}, (50, 50)),
        "block": box((-1, 0), mass=4, velocity=[0, 1]),
    },
    {**GRAVITY, "rotation": {}},
)
INERTIA = 2 * 0.5**2 / 2  # kg m², of the wheel

AT_THE_START = {
    "t": 0,
    "wheel.position.x": 1,
    "wheel.position": 5**0.5,
    "wheel.speed": 5,
    "wheel.velocity": 5,
    "wheel.momentum.y": 8,
    "wheel.acceleration.y": -G,
    "wheel.angular_velocity": 5,
    "wheel.kinetic_energy": 2 * 25 / 2 + INERTIA * 25 / 2,
    "wheel.potential_energy": 2 * G * 2,
    "wheel.energy": 25 + INERTIA * 25 / 2 + 4 * G,
    "wheel.contact.normal": 0,
    "post.energy": 0,
    "post.position.x": 50,
    "system.center.x": (2 * 1 + 4 * -1) / 6,
    "system.center.y": 4 / 6,
    "system.momentum.x": 6,
    "system.momentum.y": 12,
    "system.kinetic_energy": 25 + INERTIA * 25 / 2 + 2,
    "system.potential_energy": 4 * G,
    "system.angular_momentum": 2 * (1 * 4 - 2 * 3) + INERTIA * 5 + 4 * (-1 * 1),
}


@pytest.mark.parametrize("name", AT_THE_START)
def test_a_quantity_is_what_its_definition_says(name: str) -> None:
    world = build(SCENE)

    assert Meter(world, [name])(world.snapshot)[name] == pytest.approx(
        AT_THE_START[name], rel=1e-12
    )


@pytest.mark.parametrize("scene", [SCENE, atwood(1, 2)], ids=["turning", "string"])
def test_every_quantity_is_the_same_on_a_run_as_on_each_of_its_states(scene: Level) -> None:
    names = [q.name for q in quantities(scene) if not (q.is_integral or q.needs_ledger)]
    world = build(scene)
    meter = Meter(world, names)
    states = [world.snapshot, *(world.advance() for _ in range(5))]
    each = [meter(state) for state in states]
    together = meter(type(states[0]).stack(states))

    for name in names:
        assert together[name].shape == (6,)
        assert together[name] == pytest.approx(
            [float(one[name]) for one in each], rel=1e-14, abs=1e-14
        )


def test_an_unknown_quantity_is_refused_by_name() -> None:
    with pytest.raises(QuantityError, match=r"wheel\.velocity"):
        Meter(build(SCENE), ["wheel.velocty"])


def test_angular_momentum_stays_where_nothing_turns_the_system() -> None:
    """A free wheel far from the origin: L about the origin is constant to rounding."""
    scene = level({"wheel": disc((3, 4), velocity=[1, -2], angular_velocity=7)}, {"rotation": {}})
    world = build(scene)
    momentum = Meter(world, ["system.angular_momentum"])(run(world, 60))["system.angular_momentum"]

    assert np.ptp(momentum) <= 1e-13 * abs(momentum[0])


FALL = level({"ball": disc(mass=3, velocity=[4, 5])}, GRAVITY, stepping={"rate": 100})


def test_the_action_is_the_integral_of_kinetic_less_potential_energy() -> None:
    """S = m (v² t / 2 − vy g t² + g² t³ / 3) of a throw; a trapezoid adds m g² dt² t / 6 to it."""
    found = simulate(FALL, duration=1, record=["ball.action", "system.action"])
    t = found.t
    action = 3 * (41 * t / 2 - 5 * G * t**2 + G**2 * t**3 / 3)
    excess = 3 * G**2 * 0.01**2 * t / 6

    assert found.columns["ball.action"] == pytest.approx(action + excess, rel=1e-12)
    assert found.columns["system.action"] == pytest.approx(found.columns["ball.action"])
    assert found.units["ball.action"] == "J·s"


def test_an_integral_does_not_care_in_which_pieces_a_run_is_measured(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    record = ["ball.action", "ball.position.y"]
    whole = simulate(FALL, duration=1, record=record).columns
    monkeypatch.setattr(recording, "MANY", 7)
    pieces = simulate(FALL, duration=1, record=record).columns

    assert pieces["ball.action"] == pytest.approx(whole["ball.action"], rel=1e-12)
    assert np.array_equal(pieces["ball.position.y"], whole["ball.position.y"])


def test_the_action_of_what_moves_freely_is_that_of_its_kinetic_energy() -> None:
    scene = level({"ball": disc(mass=3, velocity=[4, 0])}, {})
    meter = Meter(build(scene), ["ball.action"])

    assert meter(run(build(scene), 60))["ball.action"][-1] == pytest.approx(3 * 16 / 2)
    assert meter(build(scene).snapshot)["ball.action"] == 0


def test_what_quantities_of_many_bodies_share_is_computed_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The kinetic energies of all bodies were computed for each that was asked for."""
    scene = level({f"b{i}": disc((2.0 * i, 0), velocity=[i, 0]) for i in range(5)}, {})
    calls = 0
    real = kinetic_energy

    def counted(mass: Array, moment: Array, now: Snapshot) -> Array:
        nonlocal calls
        calls += 1
        return real(mass, moment, now)

    monkeypatch.setattr(meter, "kinetic_energy", counted)
    world = build(scene)
    names = [f"b{i}.kinetic_energy" for i in range(5)]
    found = Meter(world, names)(world.snapshot)

    assert [float(found[name]) for name in names] == [i**2 / 2 for i in range(5)]
    assert calls == 1
