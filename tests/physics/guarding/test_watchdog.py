"""A run that goes wrong stops in its last good state, and says what to do about it."""

import pickle

import numpy as np
import pytest

from sandbox.model.level import Level, Stepping
from sandbox.model.translatable_message import Message
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import (
    GRAVITY,
    G,
    Spec,
    box,
    disc,
    fixed,
    floor,
    level,
    orbit,
    straddle,
    strut,
)


def advance(world: World, steps: int) -> None:
    """Observe every step."""
    for _ in range(steps):
        world.advance()


def stopped(world: World, steps: int = 600) -> SimulationError:
    """Run until the watchdog stops the world, and return what it says."""
    with pytest.raises(SimulationError) as told:
        advance(world, steps)
    assert np.isfinite(world.snapshot.position).all()
    with pytest.raises(SimulationError) as again:
        world.advance()
    assert again.value is told.value
    return told.value


def holds(scene: Level, rate: float | None, steps: int = 600) -> None:
    """Run the scene at the advised rate."""
    assert rate is not None
    advance(build(scene, stepping=Stepping(rate=rate)), steps)


def test_a_spring_that_is_too_stiff_is_refused_with_a_rate_that_holds() -> None:
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 1e6, "length": 1}
    scene = level({"bob": disc((1.1, 0))}, {}, joints={"k": spring})

    with pytest.raises(SimulationError, match=r"'k' needs a 'rate' of at least 500") as told:
        build(scene)

    assert (told.value.subject, told.value.time, told.value.rate) == ("k", 0.0, 2000)
    holds(scene, told.value.rate)


def test_a_rate_that_no_level_may_have_is_not_advised() -> None:
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 1e12, "length": 1}

    with pytest.raises(SimulationError, match=r"at least 500,000") as told:
        build(level({"bob": disc((1.1, 0))}, {}, joints={"k": spring}))

    assert told.value.rate is None


@pytest.mark.sweep
def test_energy_from_nowhere_names_the_effect_that_a_step_is_too_long_for() -> None:
    """A planet falls almost into the sun: at 60 Hz it is thrown out faster than it came."""
    fall = orbit(speed=0.05)

    world = build(fall)
    told = stopped(world)

    assert told.subject == "planet"
    assert "have come from nowhere, most of them in 'planet'" in str(told)
    assert "the effect 'attraction' changes too fast for a step" in str(told)
    assert told.rate is not None
    assert told.rate > 1000
    assert np.hypot(*world.snapshot.velocity[0]) < 20  # as it still fell
    holds(fall, told.rate, int(5 * told.rate))


@pytest.mark.parametrize("quadratic", [1e4, 1e5, 1e7])
def test_a_drag_that_outgrows_the_step_is_named_with_a_rate_that_holds(quadratic: float) -> None:
    """It falls until c2 v² = m g; there the drag's slope is 2 c2 v, and asks for that rate."""
    drag = {"drag": {"quadratic": quadratic}}
    scene = level({"ball": disc()}, {**GRAVITY, **drag}, stepping={"rate": 240})

    told = stopped(build(scene))

    assert "the effect 'drag' changes too fast for a step; a higher 'rate' may help: " in str(told)
    assert told.rate == pytest.approx(4 * 2 * np.sqrt(quadratic * G), rel=0.13)
    holds(scene, told.rate)


@pytest.mark.parametrize("mass", [1, 1e-3])
def test_what_drag_gives_is_from_nowhere_where_a_force_does_work(mass: float) -> None:
    push = {"force": [{"body": "ball", "force": ["1e5*t", 0]}]}
    drag = {"drag": {"quadratic": 10 * mass}}
    scene = level({"ball": disc(mass=mass)}, {**push, **drag}, stepping={"rate": 240})

    told = stopped(build(scene))

    assert "have come from nowhere, most of them in 'ball': the effect 'drag'" in str(told)


@pytest.mark.parametrize("push", ["1e-3*sin(t)", "-t"])
def test_work_that_is_put_in_hides_no_energy_from_nowhere(push: str) -> None:
    """The same planet is pushed; that a force may give energy explains none of this."""
    pushed = {"body": "planet", "force": [push, 0]}
    planet = disc((1, 0), radius=0.1, velocity=[0, 0.05])
    scene = level({"planet": planet}, {"attraction": [{"mu": 1}], "force": [pushed]})

    told = stopped(build(scene))

    assert "have come from nowhere, most of them in 'planet'" in str(told)
    assert "the effect 'attraction' changes too fast for a step" in str(told)


@pytest.mark.sweep
def test_what_a_force_gives_is_not_from_nowhere() -> None:
    """A blow of a step gives a ball at rest 50 J, and a spring at ω dt = 1.9 swings with it."""
    blow = {"body": "bob", "force": ["600 if abs(t - 0.5) < 0.001 else 0", 0]}
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 12996, "length": 1}
    world = build(level({"bob": disc((1, 0))}, {"force": [blow]}, joints={"k": spring}))

    advance(world, 600)

    swing = np.abs(world.snapshot.position[0, 0] - 1)
    assert 0.01 < swing < 0.3


@pytest.mark.parametrize(("height", "surface"), [(2, 0), (0.3, 1e3), (7, -0.1)])
def test_what_floats_in_balance_has_no_energy_from_nowhere(height: float, surface: float) -> None:
    """A box lies half deep in a liquid of twice its density: it trembles by rounding alone."""
    afloat = box((0, surface), mass=10 * height, size=(1, height))
    liquid = {"density": 20, "gravity": G, "surface": surface}
    world = build(level({"box": afloat}, {**GRAVITY, "buoyancy": liquid}))
    advance(world, 600)

    assert abs(world.snapshot.position[0, 1] - surface) <= 1e-12 * (1 + abs(surface))


def test_a_latch_that_stops_a_door_at_once_takes_energy_and_gives_none() -> None:
    """The spring stores 3e-15 J more than was booked, while the door has no energy left."""
    latch = {"type": "rod", "ends": [{"body": "door", "at": [0.5, 0]}, [1.3, 0.4]]}
    closer = {
        "rotation": {},
        "torsion": [{"body": "door", "stiffness": 20, "angle": -0.2}],
        "torque": [{"body": "door", "torque": "-6*omega"}],
    }
    closed = {"event": "crossing", "quantity": "door.angle", "value": 0.02, "direction": "down"}
    scene = level(
        {"door": box(size=(1, 0.05), mass=25, moment=8.3, angle=1.2)},
        closer,
        joints={"hinge": {"type": "pivot", "ends": [[0, 0], "door"]}, "latch": latch},
        events={"click": {"at": closed, "tie": ["latch"]}},
        stepping={"rate": 240},
    )
    world = build(scene)

    advance(world, 480)

    assert world.snapshot.angle == pytest.approx(0.02, abs=1e-6)


def test_a_swing_that_is_only_coarse_goes_on() -> None:
    """A spring at ω dt = 1.9 has ten times its energy now and then, and gives it back."""
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 12996, "length": 1}
    world = build(level({"bob": disc((1, 0), velocity=[1, 0])}, {}, joints={"k": spring}))

    advance(world, 600)

    assert np.abs(world.snapshot.position).max() < 1.1


def test_a_body_that_is_deep_in_another_is_stopped() -> None:
    """A ball that a step carries through a floor's surface."""
    ball = disc((0, 0.95), radius=0.1, velocity=[0, -21])
    ground = fixed({"type": "box", "width": 4, "height": 1}, (0, -0.5))
    scene = level({"ball": ball, "floor": ground}, {"contact": {}})

    told = stopped(build(scene))

    assert told.subject == "ball"
    assert "m deep in 'floor', more than half its thickness" in str(told)
    assert "at 21 m/s a step is too long for it; a higher 'rate' may help: 420, not 60" in str(told)
    holds(scene, told.rate)


def test_what_presses_too_hard_is_told_apart_from_what_is_too_fast() -> None:
    """A thousand tonnes on a box of a gram, with one sweep of the solver a step."""
    scene = level(
        {
            "light": box((0, 0.25), mass=1e-3),
            "heavy": box((0, 0.75), mass=1e6),
            "floor": fixed({"type": "box", "width": 4, "height": 1}, (0, -0.5)),
        },
        {**GRAVITY, "contact": {"solver": "iterative"}},
        stepping={"iterations": 1},
    )

    told = stopped(build(scene))

    assert told.subject in ("light", "heavy")
    assert "the load on it is too much for the solver" in str(told)


def test_an_overlap_at_the_start_may_part_gently() -> None:
    """Two boxes three quarters within each other; they only must not sink any deeper."""
    scene = level(
        {"low": box((0, 0.25)), "high": box((0.02, 0.38)), "floor": floor()},
        {**GRAVITY, "contact": {"overlaps": True}, "rotation": {}},
    )
    world = build(scene)

    advance(world, 300)

    assert np.abs(world.snapshot.velocity[:2]).max() < 1.0


@pytest.mark.parametrize(
    ("apart", "says"),
    [(0.6, "the joint 'rod' has parted by"), (0.9, "J have come from nowhere")],
)
def test_joints_against_which_contacts_push_are_stopped(apart: float, says: str) -> None:
    """Overlapping discs are pushed apart while a rod holds them at their distance."""
    rod = {"type": "rod", "ends": ["a", "b"]}
    scene = level(
        {"a": disc((-apart / 2, 0)), "b": disc((apart / 2, 0))},
        {"contact": {"solver": "iterative", "overlaps": True}},
        joints={"rod": rod},
    )

    assert says in str(stopped(build(scene)))


@pytest.mark.sweep
def test_joints_that_hold_bodies_in_each_other_do_so_in_peace() -> None:
    """Solved together, contacts push as hard as the rod holds, and nothing parts or moves."""
    scene = level(
        {"a": disc((-0.3, 0)), "b": disc((0.3, 0))},
        {"contact": {"overlaps": True}},
        joints={"rod": {"type": "rod", "ends": ["a", "b"]}},
    )
    world = build(scene)

    last = world.advance(300)

    assert np.abs(last.velocity).max() == 0.0
    assert last.position[1, 0] - last.position[0, 0] == 0.6


def test_a_chain_too_stiff_for_the_step_says_which_rate_would_do() -> None:
    """Twenty links swing with ten thousand times the mass at the end."""
    names = [f"link{i}" for i in range(20)]
    links = {n: disc((0.1 * (i + 1), 0), radius=0.03, mass=0.01) for i, n in enumerate(names)}
    links["link19"] = {**links["link19"], "mass": 100}
    rods = {
        f"rod{i}": {"type": "rod", "ends": [names[i - 1] if i else [0, 0], n]}
        for i, n in enumerate(names)
    }
    scene = level(links, GRAVITY, joints=rods)

    told = stopped(build(scene))

    assert told.subject.startswith("rod")
    assert "a higher 'rate' may help: " in str(told)
    assert told.rate is not None
    assert told.rate > 60


@pytest.mark.parametrize(
    ("force", "when"), [("sqrt(0.25 - t)", 0.25), ("1/(t - 0.5)", 0.5)], ids=["ends", "pole"]
)
def test_a_force_that_has_no_value_any_more_is_named(force: str, when: float) -> None:
    """Beyond the duration, up to which it was looked at."""
    pushed = {"force": [{"body": "ball", "force": [force, 0]}]}
    told = stopped(build(level({"ball": disc()}, pushed, duration=0.2)))

    assert told.subject == "ball"
    assert told.time == pytest.approx(when, abs=1 / 59)
    assert str(told).endswith(
        "position of 'ball' is no longer finite: the effect 'force' no longer has a finite value"
    )
    assert told.rate is None


BEYOND = "'ball' is so fast, so far away or so heavy that its energy is not finite"


@pytest.mark.parametrize("scheme", ["leapfrog", "symplectic-euler"])
@pytest.mark.parametrize(
    "effects",
    [
        {"gravity": {"acceleration": [0, -1e300]}},
        {"force": [{"body": "ball", "force": [1e300, 0]}]},
        {"force": [{"body": "ball", "force": ["1e300*t", 0]}]},
    ],
    ids=["gravity", "force", "force of time"],
)
@pytest.mark.usefixtures("boundless")
def test_an_energy_beyond_all_numbers_ends_the_run(effects: Spec, scheme: str) -> None:
    told = stopped(build(level({"ball": disc()}, effects, stepping={"scheme": scheme})))

    assert BEYOND in str(told)


@pytest.mark.parametrize(
    "ball",
    [disc(velocity=[1e300, 0]), disc((1e300, 0)), disc(mass=1e300, velocity=[1e5, 0])],
    ids=["fast", "far", "heavy"],
)
@pytest.mark.parametrize("effects", [{}, {"force": [{"body": "ball", "force": ["t", 0]}]}])
@pytest.mark.usefixtures("boundless")
def test_an_energy_beyond_all_numbers_is_no_start(ball: Spec, effects: Spec) -> None:
    with pytest.raises(SimulationError, match=f"bodies.ball: {BEYOND}"):
        build(level({"ball": ball}, effects))


def test_eulers_schemes_may_be_as_bad_as_they_are() -> None:
    world = build(orbit(speed=0.3, scheme="explicit-euler"))

    advance(world, 600)

    assert np.hypot(*world.snapshot.position[0]) > 10


def test_a_bare_step_is_not_watched(monkeypatch: pytest.MonkeyPatch) -> None:
    world = build(orbit())

    def bark(*_: object, **__: object) -> None:
        raise AssertionError

    monkeypatch.setattr(world._watch, "check", bark)

    for _ in range(10):
        world.step()


def test_why_a_run_stopped_can_be_told_in_another_process() -> None:
    error = SimulationError("ball", 1.5, Message("it is lost"), 240.0)
    error.place = "level.json, line 3, column 5"

    told = pickle.loads(pickle.dumps(error))

    assert str(told) == str(error) == "level.json, line 3, column 5: it is lost"
    assert (told.subject, told.time, told.rate) == ("ball", 1.5, 240)


@pytest.mark.sweep
@pytest.mark.parametrize("rate", [240, 960, 2000])
def test_a_load_that_hops_on_its_strut_is_stopped_before_it_hops_far(rate: float) -> None:
    """At rest there is no energy to hop with: it had been allowed to rise as high as it is wide."""
    world = build(strut(rate))

    told = stopped(world)

    assert "have come from nowhere" in str(told)
    assert "contact forces and those of exact joints are solved in turn here" in str(told)
    assert abs(world.snapshot.position[1, 1] - 1.5) < 0.02  # 11 mm at 240 Hz; it was metres


def test_a_load_stands_on_its_strut_where_both_are_solved_together() -> None:
    advance(build(strut(240, "direct")), 240)


def test_what_is_pressed_through_a_floor_is_stopped_as_it_comes_out_below() -> None:
    """Beyond the middle of a line it is pushed out on the far side, and no longer deep in it."""
    told = stopped(build(straddle(60)))

    assert "'left' is pressed through 'floor'" in str(told)


@pytest.mark.parametrize("driven", [False, True])
def test_energy_that_eulers_scheme_multiplies_is_named(driven: bool) -> None:
    """Each step takes a spring's energy times 1 + (ω dt)² = 1.25."""
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 900, "length": 1}
    push = {"force": [{"body": "bob", "force": ["1e-3*sin(t)", 0]}]} if driven else {}
    scene = level(
        {"bob": disc((1.1, 0))}, push, joints={"k": spring},
        stepping={"rate": 60, "scheme": "explicit-euler"},
    )  # fmt: skip

    told = stopped(build(scene))

    assert "the scheme 'explicit-euler' adds energy in every step" in str(told)
    assert told.time < 1.2  # 1.25^n = 10^4 after 41 steps


def test_what_takes_back_overlaps_lifts_and_gives_nothing_from_nowhere() -> None:
    """Boxes made in each other are moved apart: the upper rises by 10 cm, and is not stopped."""
    scene = level(
        {"low": box((0, 0.25)), "high": box((0, 0.65)), "floor": floor()},
        {**GRAVITY, "contact": {"solver": "iterative", "overlaps": True}},
    )
    world = build(scene)

    advance(world, 120)

    assert world.snapshot.position[1, 1] > 0.74
