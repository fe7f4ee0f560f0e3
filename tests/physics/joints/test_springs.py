"""Springs as force laws, and as pymunk's own."""

from math import pi, sqrt

import numpy as np
import pytest

from sandbox.model.contact_solver_choice import MOST_SPRUNG, is_direct
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.run import build, simulate
from sandbox.physics.state.motion import Motion
from tests.physics.joints.test_scene_joints import order
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, level, measured, run, worst


def spring(stiffness: float, *ends: object, **rest: object) -> Spec:
    return {"type": "spring", "ends": list(ends), "stiffness": stiffness, **rest}


def oscillator(rate: float, damping: float = 0.0) -> Level:
    """2 kg on 50 N/m, drawn out by 0.1 m: ω0 = 5 /s."""
    return level(
        {"mass": disc((1.1, 0), mass=2)},
        {},
        joints={"coil": spring(50, [0, 0], "mass", length=1, damping=damping)},
        stepping={"rate": rate},
    )


def damped(t: Array, damping: float) -> Array:
    """x'' + 2 β x' + ω0² x = 0 from rest, in all its three cases."""
    beta, omega = damping / 4, 5.0
    root = np.sqrt(complex(beta**2 - omega**2))
    if not root:
        return np.asarray(0.1 * np.exp(-beta * t) * (1 + beta * t))
    motion = np.exp(-beta * t) * (np.cosh(root * t) + beta / root * np.sinh(root * t))
    return np.asarray(0.1 * motion.real)


@pytest.mark.parametrize("damping", [0.0, 4.0, 20.0, 50.0])
def test_a_spring_swings_creeps_or_rests_as_its_damping_says(damping: float) -> None:
    """ω0 dt = 0.08 at 60 Hz: (ω0 dt)² / 24 = 3e-4 a radian."""

    def error(rate: float) -> float:
        found = measured(build(oscillator(rate, damping)), round(2 * rate), "mass.position.x", "t")
        return worst(found["mass.position.x"] - 1, damped(found["t"], damping))

    assert error(60) < 1e-2  # 1e-3 to 2e-3
    assert order(error, 120) >= 1.9


@pytest.mark.sweep
def test_a_spring_that_pushes_only_turns_a_body_round_and_lets_it_go() -> None:
    """Half a swing: F = v √(k m) at the most, for π √(m / k), and nothing before and after."""
    scene = level(
        {"cart": box((0, 0), mass=2, velocity=[1, 0])},
        {},
        joints={"bumper": spring(400, [2, 0], "cart", length=1, pushes_only=True)},
        stepping={"rate": 1000},
    )
    found = measured(build(scene), 2500, "bumper.tension", "cart.velocity.x", "system.energy", "t")
    touches = found["bumper.tension"] < 0

    assert found["bumper.tension"].min() == pytest.approx(-sqrt(800), rel=1e-4)  # 3e-5
    assert found["bumper.tension"].max() == 0
    assert touches.sum() / 1000 == pytest.approx(pi * sqrt(2 / 400), abs=1e-3)
    assert found["cart.velocity.x"][-1] == pytest.approx(-1, rel=1e-4)
    assert worst(found["system.energy"], 1) <= 2e-4  # 5e-5


def test_a_spring_that_pushes_only_hangs_free_where_it_has_let_go() -> None:
    scene = level(
        {"cart": box((3, 0))},
        {},
        joints={"bumper": spring(400, [0, 0], "cart", length=1, pushes_only=True)},
    )
    world = build(scene)
    start, end = world.scene.joints.springs["bumper"].span(world.snapshot)

    assert (complex(start), complex(end)) == (0, 1)


@pytest.mark.parametrize("kind", ["between bodies", "off centre", "held by what moves"])
def test_pymunk_pulls_a_plain_spring_as_a_force_law_does(kind: str) -> None:
    """To rounding, and without any callback; where a spring damps it is the law that pulls."""
    bodies = {
        "a": disc((0, 0), velocity=[0, 1], angular_velocity=1),
        "b": disc((3, 0), mass=3),
        "mover": {**box((0, 4)), "type": "kinematic", "velocity": [0.5, 0]},
    }
    del bodies["mover"]["mass"]
    ends: dict[str, list[object]] = {
        "between bodies": ["a", "b"],
        "off centre": [{"body": "a", "at": [0, 0.3]}, [0, 3]],
        "held by what moves": ["a", "mover"],
    }
    plain, hooked = (
        build(
            level(
                bodies,
                {**GRAVITY, "rotation": {}},
                joints={
                    "coil": spring(20, *ends[kind], length=1.5, damping=damping),
                    "other": spring(9, "b", [6, 0], damping=damping),
                },
                stepping={"rate": 240},
            )
        )
        for damping in (0, 1e-30)
    )

    one, other = run(plain, 240), run(hooked, 240)

    assert (plain.hooks, hooked.hooks) == (0, 1)
    assert np.abs(one.position - other.position).max() <= 1e-13
    assert np.abs(one.angular_velocity - other.angular_velocity).max() <= 1e-12
    assert np.abs(one.position[-1] - one.position[0]).max() > 0.5


def test_a_spring_keeps_its_energy_and_tells_its_tension() -> None:
    names = ("system.energy", "coil.tension", "coil.length", "coil.potential_energy", "t")
    found = measured(build(oscillator(240)), 2400, *names)

    assert worst(found["system.energy"], 0.25) < 1e-3
    assert found["coil.tension"][0] == pytest.approx(5, rel=1e-12)
    assert found["coil.potential_energy"][0] == pytest.approx(0.25, rel=1e-12)
    assert worst(found["coil.tension"], 50 * (found["coil.length"] - 1)) <= 1e-12


def test_what_a_spring_pulls_is_found_only_where_it_is_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Once for a whole run, not at each of its steps."""
    asked, pull = [0], SpringForce.tension

    def counted(coil: SpringForce, motion: Motion) -> Array:
        asked[0] += 1
        return pull(coil, motion)

    monkeypatch.setattr(SpringForce, "tension", counted)
    simulate(oscillator(240), record=["mass.position.x"], duration=1)
    assert asked == [0]
    simulate(oscillator(240), record=["coil.tension"], duration=1)
    assert asked == [1]


@pytest.mark.parametrize(("sign", "omega"), [(1, 5.0), (-1, 5.0 * sqrt(3))])
def test_coupled_oscillators_swing_in_their_normal_modes(sign: int, omega: float) -> None:
    """Three equal springs: ω² = k/m where both go along, 3 k/m against each other."""
    scene = level(
        {"a": disc((1.1, 0), mass=2), "b": disc((2 + 0.1 * sign, 0), mass=2)},
        {},
        joints={
            "left": spring(50, [0, 0], "a", length=1),
            "middle": spring(50, "a", "b", length=1),
            "right": spring(50, "b", [3, 0], length=1),
        },
        stepping={"rate": 240},
    )
    found = measured(build(scene), 480, "a.position.x", "b.position.x", "t")
    swing = 0.1 * np.cos(omega * found["t"])

    assert worst(found["a.position.x"] - 1, swing) < 2e-3
    assert worst(found["b.position.x"] - 2, sign * swing) < 2e-3


def pogo(contact: Spec, riders: int = 1) -> Level:
    """A rider of 80 kg on a light foot, by a spring of 20 kN/m, falls 0.5 m."""
    return level(
        {
            "floor": fixed({"type": "segment", "start": [-9, 0], "end": [99, 0]}),
            "foot": box((0, 0.55), size=(0.3, 0.1)),
            **{
                f"rider{i}": box((2 * i, 1.8), size=(0.4, 1), mass=80, velocity=[0, 0])
                for i in range(riders)
            },
        },
        {**GRAVITY, "contact": contact},
        joints={"leg": spring(2e4, "foot", "rider0", length=1.25)},
        stepping={"rate": 240},
    )


@pytest.mark.sweep
def test_what_a_spring_presses_on_the_ground_does_not_sink_in() -> None:
    """Sweeps leave it 2 cm deep, and taking that back lifts the rider."""
    world, deepest = build(pogo({})), 0.0
    for _ in range(720):
        world.advance()
        deepest = max(deepest, float(world.contacts.depth.max(initial=0)))
    assert deepest <= 2e-8  # 1e-9
    closing = simulate(pogo({}), duration=3, books=True).closing
    assert closing
    assert closing.closes
    assert closing.overlaps == 0
    assert closing.unexplained <= 2.0  # 1.6 of 586 J; with sweeps 71


@pytest.mark.parametrize(
    ("scene", "direct"),
    [
        (pogo({}), True),
        (pogo({"solver": "iterative"}), False),
        (pogo({"located": ["foot"]}), False),
        (pogo({}, riders=MOST_SPRUNG - 1), True),
        (pogo({}, riders=MOST_SPRUNG), False),
    ],
)
def test_contacts_of_few_bodies_on_springs_are_solved_directly(
    scene: Level, *, direct: bool
) -> None:
    assert is_direct(scene) is direct
