"""Located impacts of bodies that exact joints hold: the direct solver's own."""

from math import cos, radians, sin, sqrt

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build, simulate
from sandbox.physics.state.snapshot import Snapshot
from tests.physics.scenes import GRAVITY, Spec, box, disc, fixed, floor, level, run, worst

MODES = ["together", "sequence"]
RATES = [60, 240, 960]


def located(impacts: str, *names: str, **rest: object) -> Spec:
    """The effects in which the impacts of some bodies are located."""
    restitution = {"impacts": impacts}
    return {"contact": {"located": names}, "restitution": restitution, "rotation": {}, **rest}


def dumbbell(
    impacts: str,
    rate: float,
    *,
    angle: float = 35,
    masses: tuple[float, float] = (1, 3),
    e: float = 1,
    gap: float = 0.31,
    **rest: object,
) -> Level:
    """Two discs on a rod of 1 m that fall at 3 m/s, the lower one a gap above a floor."""
    across, up = cos(radians(angle)), sin(radians(angle))
    both: Spec = {"radius": 0.1, "restitution": sqrt(e), "velocity": [0.7, -3]}
    bodies = {
        "low": disc((0, 0.1 + gap), mass=masses[0], **both),
        "high": disc((across, 0.1 + gap + up), mass=masses[1], **both),
        "floor": floor(restitution=sqrt(e)),
    }
    effects = located(impacts, "low", "high", **rest)
    rod = {"type": "rod", "ends": ["low", "high"]}
    return level(bodies, effects, joints={"rod": rod}, stepping={"rate": rate})


def bounced(angle: float, masses: tuple[float, float], e: float) -> Array:
    """Return the velocities of a dumbbell's discs right after its bounce, (2, 2), and its spin.

    The impulse P along y at the lower disc reverses that disc's approach.
    """
    low, high = masses
    whole, arm = low + high, cos(radians(angle)) * high / (low + high)
    moment = low * high / whole
    push = 3 * (1 + e) / (1 / whole + arm**2 / moment)
    return np.array([0.7, -3 + push / whole, -arm * push / moment])


def motion(masses: tuple[float, float], now: Snapshot) -> Array:
    """Return the velocity of a dumbbell's centre, and its spin."""
    share = np.array(masses) / sum(masses)
    way, rate = (state[1] - state[0] for state in (now.position, now.velocity))
    return np.array([*(share @ now.velocity[:2]), way[0] * rate[1] - way[1] * rate[0]])


@pytest.mark.parametrize("impacts", MODES)
@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(
    ("angle", "masses", "e"),
    [(35, (1, 3), 1), (35, (1, 3), 0.5), (70, (1, 100), 0.8), (10, (50, 1), 0.3)],
)
def test_a_dumbbell_bounces_as_it_should(
    angle: float, masses: tuple[float, float], e: float, rate: float, impacts: str
) -> None:
    """Its joint was 1e-5 m off at 60 Hz, and its spin 1e-3 rad/s."""
    world = build(dumbbell(impacts, rate, angle=angle, masses=masses, e=e))
    while not world.impacts:
        world.advance()
        assert world.t < 0.2
        assert world.scene.joints.parting()[1] <= 1e-12
    ((pair, time),) = world.impacts

    assert pair == {"low", "floor"}
    assert time == pytest.approx(0.31 / 3, rel=1e-7)  # the floor has a skin of 1e-8 m
    expected = bounced(angle, masses, e)
    assert np.abs(motion(masses, world.snapshot) - expected).max() <= 1e-10
    assert np.abs(motion(masses, world.advance()) - expected).max() <= 1e-10
    assert world.scene.joints.parting()[1] <= 1e-12


def whip(impacts: str, rate: float) -> Level:
    """A chain of six discs that falls on a floor, one end first."""
    links = {
        f"link{i}": disc(
            (0.3 * i * cos(0.5), 1 + 0.3 * i * sin(0.5)), radius=0.05, mass=0.2, restitution=0.8
        )
        for i in range(6)
    }
    rods = {f"rod{i}": {"type": "rod", "ends": [f"link{i}", f"link{i + 1}"]} for i in range(5)}
    effects = {**GRAVITY, **located(impacts, *links)}
    bodies = {**links, "floor": floor(restitution=1)}
    return level(bodies, effects, joints=rods, stepping={"rate": rate})


def hammer(impacts: str, rate: float) -> Level:
    """A pendulum whose head, welded to its arm, strikes a wall."""
    bodies = {
        "arm": box((0.5, 0), size=(1, 0.05), mass=0.5, restitution=0.9),
        "head": box((1.1, 0), size=(0.2, 0.3), mass=2, restitution=0.9),
        "wall": fixed({"type": "box", "width": 0.2, "height": 3}, (-0.3, -1), restitution=1),
    }
    joints = {
        "pin": {"type": "pivot", "ends": [{"body": "arm", "at": [-0.5, 0]}, [0, 0]]},
        "weld": {"type": "weld", "ends": ["arm", "head"]},
    }
    effects = {**GRAVITY, **located(impacts, "arm", "head")}
    effects["contact"]["apart"] = [["arm", "wall"]]
    return level(bodies, effects, joints=joints, stepping={"rate": rate})


def trolley(impacts: str, rate: float) -> Level:
    """A cart on two wheels whose bumper, welded to it, strikes a wall."""
    wheel: Spec = {"radius": 0.2, "mass": 0.5, "velocity": [3, 0], "restitution": 0.9}
    rest: Spec = {"velocity": [3, 0], "restitution": 0.9}
    wall = {"type": "box", "width": 0.2, "height": 3}
    bodies = {
        "cart": box((0, 0.35), size=(1, 0.2), mass=2, **rest),
        "rear": disc((-0.4, 0.2), **wheel),
        "front": disc((0.4, 0.2), **wheel),
        "bumper": box((0.8, 0.35), size=(0.1, 0.3), mass=0.2, **rest),
        "floor": floor(restitution=0),
        "wall": fixed(wall, (2.03, 1.6), restitution=1),
    }
    joints = {
        "one": {"type": "pivot", "ends": [{"body": "cart", "at": [-0.4, -0.15]}, "rear"]},
        "other": {"type": "pivot", "ends": [{"body": "cart", "at": [0.4, -0.15]}, "front"]},
        "weld": {"type": "weld", "ends": ["cart", "bumper"]},
    }
    effects = {**GRAVITY, **located(impacts, "cart", "bumper", "rear", "front")}
    effects["contact"]["jointed"] = False
    return level(bodies, effects, joints=joints, stepping={"rate": rate})


SCENES = {"whip": whip, "hammer": hammer, "trolley": trolley}


@pytest.mark.sweep
@pytest.mark.parametrize("impacts", MODES)
@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("scene", SCENES)
def test_exact_joints_hold_through_located_impacts(scene: str, rate: float, impacts: str) -> None:
    """They were off by up to 3e-3, 2e-5 and 4e-7 m at the step after an impact."""
    world = build(SCENES[scene](impacts, rate))
    books, met, off = Ledger(world), 0, 0.0
    for _ in range(round(1.2 * rate)):
        world.advance()
        books.note()
        met += len(world.impacts)
        off = max(off, world.scene.joints.parting()[1])

    assert met > 0
    assert off <= 1e-9
    assert np.abs(books.balance.unexplained_impulse).max() <= 1e-11


@pytest.mark.parametrize("impacts", MODES)
@pytest.mark.parametrize("rate", RATES)
def test_elastic_dumbbells_keep_energy_and_momentum(rate: float, impacts: str) -> None:
    both: Spec = {"radius": 0.1, "restitution": 1}
    bodies = {
        "a": disc((-1, 0.5), velocity=[1.5, 0], mass=1, **both),
        "b": disc((-1, -0.5), velocity=[1.5, 0], mass=2, **both),
        "c": disc((0.3, 0.4), velocity=[-1, 0.2], mass=3, **both),
        "d": disc((0.9, -0.4), velocity=[-1, 0.2], mass=1, **both),
    }
    rods = {ends: {"type": "rod", "ends": [*ends]} for ends in ("ab", "cd")}
    scene = level(bodies, located(impacts, *bodies), joints=rods, stepping={"rate": rate})
    world = build(scene)
    flight, mass = run(world, round(1.5 * rate)), world.scene.mass
    linear = mass @ flight.velocity
    x, y = flight.position[..., 0], flight.position[..., 1]
    turning = (x * flight.velocity[..., 1] - y * flight.velocity[..., 0]) @ mass
    energy = np.sum(flight.velocity**2, axis=2) @ mass

    assert np.abs(flight.velocity[-1] - flight.velocity[0]).max() > 0.5, "they have met"
    assert np.abs(linear - linear[0]).max() <= 1e-12
    assert abs(turning[-1] - turning[0]) <= 1e-12
    assert worst(energy[-1:], energy[0]) <= 1e-12


@pytest.mark.parametrize("gap", [0.2, 0.5, 0.9])
@pytest.mark.parametrize("e", [0, 0.5, 1])
def test_what_lands_within_the_first_step_lands_at_its_time(e: float, gap: float) -> None:
    """It bounced at the step, from up to 4 cm within the floor."""
    scene = dumbbell("together", 60, e=e, gap=gap * 3 / 60, **GRAVITY)
    world = build(scene)
    books = Ledger(world)
    world.advance()
    books.note()
    fine = build(scene, stepping=scene.stepping.model_copy(update={"rate": 7680})).advance(128)

    assert np.abs(world.snapshot.position[:2] - fine.position[:2]).max() <= 1e-4  # 7e-5
    assert np.abs(books.balance.unexplained_impulse).max() <= 1e-13
    ((_, time),) = world.impacts
    assert time == pytest.approx(gap / 60, rel=0.1)


def test_an_impact_on_what_sticks_reaches_both() -> None:
    bodies = {
        "clay": box((-1, 0), velocity=[2, 0]),
        "block": box(mass=2),
        "ball": disc((4, 0.1), radius=0.1, mass=0.5, velocity=[-3, 0]),
    }
    sticking = {"pairs": [{"bodies": ["clay", "block"]}]}
    effects = {"contact": {"located": ["ball"]}, "rotation": {}, "sticking": sticking}
    world = build(level(bodies, effects))
    flight = run(world, 120)

    assert flight.angular_velocity[-1, 0] == pytest.approx(flight.angular_velocity[-1, 1])
    assert abs(flight.angular_velocity[-1, 0]) > 0.5
    assert world.scene.joints.parting()[1] <= 1e-9


def test_a_meeting_knows_when_bodies_bounce_directly() -> None:
    """A `contact` event was measured a step later."""
    scene = dumbbell("together", 60, e=1, contact={}, **GRAVITY)
    trace = simulate(scene, duration=0.3, record=["low.velocity.y"])
    meeting = trace.meetings[frozenset(("low", "floor"))][0]

    fall = (sqrt(9 + 2 * 9.81 * 0.31) - 3) / 9.81
    assert meeting.time == pytest.approx(fall, rel=1e-7)


ROD: Spec = {"rod": {"type": "rod", "ends": [[0, 3], "ball"]}}


@pytest.mark.parametrize(
    ("contact", "rest", "impacts"),
    [
        ({"located": ["ball"], "solver": "iterative"}, {}, "together"),
        ({"solver": "iterative"}, {}, "sequence"),
        ({"located": ["ball"]}, {"friction": {"located": ["box"]}}, "together"),
    ],
)
def test_what_hinders_the_direct_solver_is_refused(contact: Spec, rest: Spec, impacts: str) -> None:
    rubs: Spec = {"friction": 1} if rest else {}
    bodies = {
        "ball": disc((0, 1), restitution=1, **rubs),
        "box": box((3, 0.25), restitution=1, **rubs),
        "floor": floor(restitution=1, **rubs),
    }
    effects = {**GRAVITY, "contact": contact, "restitution": {"impacts": impacts}, **rest}

    with pytest.raises(LevelError, match="need contacts that are solved directly; leave this out"):
        level(bodies, effects, joints=ROD)
