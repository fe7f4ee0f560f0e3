"""Advice is tried before it is given."""

import pickle
from itertools import pairwise
from time import perf_counter, process_time

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.advising import remedy_trials
from sandbox.physics.advising.preflight_faults import refusal
from sandbox.physics.advising.remedy_trials import (
    advice_in_background,
    advise,
    creep_warning,
    leaning_warning,
    with_advice,
)
from sandbox.physics.run import simulate
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, box, disc, fixed, floor, level, orbit


def strut(load: float = 100) -> Level:
    """A load on a rod on a box of 1 kg, by forces that are found in turn."""
    rod = {"type": "rod", "ends": ["box", "load"]}
    rail = {"type": "rail", "ends": [[0, 0], "load"], "direction": [0, 1]}
    return level(
        {"box": box((0, 0.25)), "load": disc((0, 1.5), radius=0.2, mass=load), "floor": floor()},
        {**GRAVITY, "contact": {"solver": "iterative"}},
        joints={"rod": rod, "rail": rail},
        stepping={"rate": 480},
        duration=0.3,
    )


def stop(scene: Level) -> SimulationError:
    """Run until it stops, and return why."""
    with pytest.raises(SimulationError) as told:
        simulate(scene, duration=10)
    return told.value


@pytest.mark.sweep
def test_a_higher_rate_that_does_not_help_is_not_advised() -> None:
    """The load hops at any rate; solved together it stands."""
    scene = strut()
    found = with_advice(stop(scene), scene, scene.defaults, scene.stepping)

    assert "a higher 'rate' may help" not in str(found)
    assert "a higher rate does not help (1,920 and 3,840 Hz)" in str(found)
    assert 'with "contact": {"solver": "direct"} it runs to its end, t = 0.3 s' in str(found)
    assert found.rate is None


@pytest.mark.sweep
def test_a_rate_is_advised_with_how_far_it_held() -> None:
    scene = orbit(speed=0.05)
    found = advise(stop(scene), scene, scene.defaults, scene.stepping, 1.5)

    assert found.rate is not None
    assert found.text == f"tried: at {found.rate:,.0f} Hz it runs to its end, t = 1.5 s"


def rope(links: int = 5, mass: float = 2e-4) -> Level:
    """Two loads on a rope of light discs, which rolls over a drum and leaves it at one side."""
    angles = np.linspace(np.pi, 0, links + 1)
    bodies = {
        f"k{i}": disc((0.52 * np.cos(a), 0.52 * np.sin(a)), radius=0.02, mass=mass, friction=1)
        for i, a in enumerate(angles.tolist())
    }
    bodies["drum"] = fixed({"type": "disc", "radius": 0.5}, friction=0.3)
    bodies["left"] = disc((-0.52, -1.5), radius=0.1, mass=10, friction=1)
    bodies["right"] = disc((0.52, -1.5), radius=0.1, mass=14, friction=1)
    ends = ["left", *(f"k{i}" for i in range(links + 1)), "right"]
    joints = {f"r{i}": {"type": "rod", "ends": list(two)} for i, two in enumerate(pairwise(ends))}
    effects = {**GRAVITY, "contact": {}, "friction": {}, "rotation": {}}
    return level(bodies, effects, joints=joints, stepping={"rate": 60}, duration=0.6)


@pytest.mark.sweep
def test_the_rate_that_the_start_needs_is_tried_as_well() -> None:
    """A link that has left the drum swings at 1 kHz, which no fault tells beforehand."""
    scene = rope()
    found = with_advice(stop(scene), scene, scene.defaults, scene.stepping)

    assert found.rate is not None
    assert 1000 < found.rate < 10_000
    assert "Hz it stops as well, but at" in str(found)
    assert "it runs to its end, t = 0.6" in str(found)


@pytest.mark.sweep
def test_trying_ends_in_time_and_says_so() -> None:
    scene = strut()
    why, start = stop(scene), perf_counter()
    found = advise(why, scene, scene.defaults, scene.stepping, 1e6, seconds=0.05)

    assert perf_counter() - start < 30  # it would go on for hours
    assert "to its end" not in found.text
    assert found.rate is None or "until t" in found.text


def test_eulers_scheme_is_advised_against() -> None:
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 900, "length": 1}
    scene = level(
        {"bob": disc((1.1, 0))}, {}, joints={"k": spring},
        stepping={"rate": 60, "scheme": "explicit-euler"}, duration=2,
    )  # fmt: skip
    found = advise(stop(scene), scene, scene.defaults, scene.stepping)

    assert found.text == "tried: with the scheme 'leapfrog' it runs to its end, t = 2 s"


@pytest.mark.sweep
def test_advice_goes_to_and_fro_between_processes() -> None:
    scene = orbit(speed=0.05)
    why = stop(scene)
    [found] = advice_in_background(why, scene, scene.defaults, scene.stepping, 1.3)
    told = pickle.loads(pickle.dumps(why.advised(found.text, found.rate)))

    assert str(told).endswith(found.text)
    assert told.rate == found.rate


def test_the_rate_that_a_check_tells_has_been_tried() -> None:
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 1e5, "length": 1}
    scene = level({"bob": disc((1.1, 0))}, {}, joints={"k": spring}, duration=0.2)
    told = refusal(scene, advised=True)

    assert str(told).endswith("; tried: at 633 Hz it runs to its end, t = 0.2006 s")


@pytest.mark.sweep
def test_a_check_does_not_wait_for_a_long_run() -> None:
    spring = {"type": "spring", "stiffness": 1e5, "length": 1}
    bobs = {f"bob{i}": disc((1.1, i)) for i in range(100)}
    springs = {f"k{i}": {**spring, "ends": [[0, i], f"bob{i}"]} for i in range(100)}
    scene = level(bobs, {}, joints=springs, duration=5000)
    begun = process_time()
    told = refusal(scene, advised=True)

    assert "; tried: at 633 Hz it runs until t = " in str(told)
    assert process_time() - begun < 2.0  # for a run that has stopped remedies get four seconds


def tower(count: int, **contact: object) -> Level:
    """Boxes of 1 m on each other."""
    boxes = {f"box{i}": box((0, i + 0.5), size=(1, 1), friction=0.6) for i in range(count)}
    effects = {**GRAVITY, "contact": contact, "friction": {}, "rotation": {}}
    return level({"floor": floor(friction=0.6), **boxes}, effects, duration=0.1)


@pytest.mark.parametrize(
    ("scene", "leans"),
    [(tower(5), False), (tower(15, solver="iterative"), True), (tower(15), False)],
)
def test_a_run_tells_whether_what_rests_at_its_start_has_settled(scene: Level, leans: bool) -> None:
    """Sweeps leave velocities of 2e-7 m/s to fifteen boxes, and these fall within 10 s."""
    assert simulate(scene).may_lean is leans


def dropped(columns: int, solver: str | None = None) -> Level:
    """Columns of twenty boxes, a centimetre above each other."""
    boxes = {
        f"box{c}_{r}": box((2.0 * c, 0.5 + 1.01 * r), size=(1, 1), friction=0.6)
        for c in range(columns)
        for r in range(20)
    }
    contact = {"solver": solver} if solver else {}
    effects = {**GRAVITY, "contact": contact, "friction": {}, "rotation": {}}
    ground = {"floor": floor(friction=0.6)}
    return level({**ground, **boxes}, effects, duration=0.3, stepping={"rate": 240})


@pytest.mark.sweep
def test_of_bodies_that_pile_up_later_it_is_said_what_sweeps_left_unbalanced() -> None:
    """Sixty are left to sweeps by default, and lean by 0.04 rad; solved directly they stand."""
    swept, solved = (simulate(dropped(3, solver)) for solver in (None, "direct"))

    assert not swept.may_lean
    assert swept.unbalanced > 0.05  # measured: 0.2
    assert "% of the forces between bodies that rest on each other unbalanced" in creep_warning(
        swept
    )
    assert creep_warning(swept).endswith("ms (tried)")
    assert solved.unbalanced == 0
    assert creep_warning(solved) == ""


def test_a_trial_is_cut_short_within_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """A step of a wall of a hundred bricks that lands can take 20 s if solved directly."""
    monkeypatch.setattr(remedy_trials, "SECONDS", 0.0)

    assert creep_warning(simulate(dropped(3))).endswith("they may creep, lean or fall")


def test_of_a_pile_that_does_not_settle_it_is_said_what_was_seen_to_help() -> None:
    scene, large = tower(15, solver="iterative"), tower(1200)

    assert leaning_warning(scene, {}, scene.stepping).endswith('"direct"} its forces are found')
    # too many for that
    assert leaning_warning(large, {}, large.stepping).endswith("it may lean or fall")


def test_no_remedy_is_tried_for_bodies_that_overlap_at_the_start(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """No rate and no solver moves them apart: three builds were in vain, 2.4 s for 300 polygons."""
    scene = level({"a": box(), "b": box((0.1, 0))}, {"contact": {}})
    error = refusal(scene)
    assert error
    monkeypatch.setattr(remedy_trials, "build", None)

    assert with_advice(error, scene, scene.defaults, scene.stepping) is error
