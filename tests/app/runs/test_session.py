"""A level is played, without a window."""

import json

import numpy as np
import pytest

from sandbox.app.pages.effects import switching_effects
from sandbox.app.runs import session as session_module
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.play_speed import SPEEDS, PlaySpeed
from sandbox.app.runs.run_start import begin
from sandbox.app.runs.session import Session
from sandbox.editing.run_as_level import as_it_stands
from sandbox.model import level_catalog
from sandbox.model.errors import ValueRangeError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.loading import choose, load, parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from tests.app import scenes
from tests.app.scenes import play
from tests.physics.scenes import disc, level

FRAME = 1 / 60  # s


def state(session: Session) -> bytes:
    snapshot = session.world.snapshot
    arrays = (snapshot.position, snapshot.velocity, snapshot.angle, snapshot.acceleration)
    return b"".join(array.tobytes() for array in arrays)


@pytest.mark.parametrize("speed", [0.1, 1.0, 8.0])
def test_the_speed_of_playing_does_not_change_a_single_bit(speed: float) -> None:
    level = scenes.level()
    session = Session(level)
    session.speed = speed
    headless = build(level)

    play(session, frame=0.0173)
    headless.advance(count_steps(headless))

    assert session.world.steps == headless.steps == 60
    assert np.array_equal(session.world.snapshot.position, headless.snapshot.position)
    assert np.array_equal(session.world.snapshot.velocity, headless.snapshot.velocity)


def test_stepping_by_hand_ends_in_the_same_state_as_playing() -> None:
    played, stepped = Session(scenes.level()), Session(scenes.level())

    play(played)
    for _ in range(60):
        stepped.step()

    assert state(played) == state(stepped)


@pytest.mark.parametrize("name", ["newton/atwood", "momentum/cradle", "machines/car-over-bumps"])
def test_a_run_that_is_restarted_is_the_same_to_the_last_bit(name: str) -> None:
    session = Session(load(level_catalog.find(name)))
    headless = build(session.level)
    for steps in (40, 25, 60):
        session.restart()
        for _ in range(steps):
            session.step()

    headless.advance(60)

    assert session.world.steps == headless.steps
    assert np.array_equal(session.world.snapshot.position, headless.snapshot.position)
    assert np.array_equal(session.world.snapshot.velocity, headless.snapshot.velocity)


def test_a_frame_takes_whole_steps_and_owes_the_rest() -> None:
    session = Session(scenes.level())
    session.toggle()

    for _ in range(5):
        session.update(0.0125)  # 0.75 steps each

    assert session.world.steps == 3


def test_what_one_frame_cannot_pay_the_next_one_makes_up_for() -> None:
    session = Session(scenes.level(stepping={"rate": 240}))
    session.toggle()

    session.update(1 / 60, budget=0.0)
    assert session.world.steps == 1
    session.update(1 / 60, budget=10.0)

    assert session.world.steps == 8
    assert session.pace.reduced is None


def test_steps_that_were_late_when_a_run_paused_are_not_made_up_for_later() -> None:
    session = Session(scenes.level(stepping={"rate": 240}))
    session.toggle()
    session.update(1 / 60, budget=0.0)

    session.pause()
    session.update(1 / 60)
    session.toggle()
    session.update(1 / 60, budget=10.0)

    assert session.world.steps == 5


def test_what_the_budget_cannot_pay_is_dropped_and_told() -> None:
    session = Session(scenes.level(duration=100))
    session.toggle()

    session.update(1.0, budget=0.0)

    assert session.world.steps == 1
    assert session.pace.reduced == pytest.approx(1 / 60)
    assert session.remaining == pytest.approx(60 * (100 - 1 / 60))
    session.playing = False
    assert session.remaining is None


def test_a_pace_forgets_what_is_more_than_half_a_second_ago() -> None:
    pace = PlaySpeed()

    pace.note(0.1, 0.05, dropped=3)
    for _ in range(6):
        pace.note(0.1, 0.1, dropped=0)

    assert pace.reduced is None


def test_a_run_pauses_by_itself_when_it_is_complete_and_goes_on_when_asked() -> None:
    session = Session(scenes.level())

    play(session)
    assert session.at_end
    assert session.t == pytest.approx(1.0)
    session.toggle()
    session.update(0.1, budget=10.0)

    assert session.playing
    assert session.world.steps == 66


def test_the_checks_judge_the_duration_only() -> None:
    session = Session(scenes.level())
    play(session)
    at_the_end = session.readings()

    for _ in range(30):
        session.step()

    assert session.readings() == at_the_end


def test_a_reading_of_every_step_shows_the_present_and_the_worst_error() -> None:
    session = Session(scenes.level())
    for _ in range(15):
        session.step()

    height, half_way = session.readings()

    assert height.measured == pytest.approx(5 - 10 * 0.25**2 / 2)
    assert height.expected == pytest.approx(height.measured, rel=1e-12)
    assert height.result.verdict == "passed"
    assert half_way.result.verdict == "waiting"
    assert (half_way.measured, half_way.expected) == (2.5, 5.0)  # of now, and of then


def test_a_change_of_a_parameter_starts_the_run_anew() -> None:
    session = Session(scenes.level())
    session.toggle()
    session.update(0.5)

    session.restart({"g": 20})

    assert session.t == 0
    assert session.playing
    assert session.values["g"] == 20
    assert session.values["mass"] == 1


def test_a_value_out_of_range_is_refused_and_changes_nothing() -> None:
    session = Session(scenes.level())
    world = session.world

    with pytest.raises(ValueRangeError):
        session.restart({"g": 21})

    assert session.world is world


def test_a_body_is_pulled_while_time_runs() -> None:
    session = Session(scenes.level())
    session.toggle()

    session.grab("ball", (0, 5))
    for _ in range(30):
        session.drag((2, 5))
        session.update(FRAME)

    x, y = session.world.snapshot.position[0]
    assert x > 1
    assert y > 4
    assert session.world.disturbed


def test_a_hand_for_which_the_rate_is_too_low_stops_the_run_and_says_so() -> None:
    """A bob turns by 1 rad per step: the rod can follow parts of a step, but not a whole one."""
    session = Session(
        level(
            {"bob": disc((1, 0), velocity=[0, 17])},
            {},
            joints={"rod": {"type": "rod", "ends": [[0, 0], "bob"]}},
            stepping={"rate": 16, "scheme": "fourth-order"},
        )
    )
    session.toggle()
    session.update(0.2)

    session.grab("bob", (1, 0))
    session.drag((1, 1))

    assert not session.playing
    assert "nothing keeps 'rod' as it is" in str(session.failure)


def test_a_body_is_put_elsewhere_while_time_stands() -> None:
    session = Session(scenes.level())

    session.grab("ball", (0.2, 5.1))
    session.drag((2.2, 3.1))
    session.release()

    assert session.world.snapshot.position[0] == pytest.approx([2.0, 3.0])
    assert session.t == 0
    assert session.world.disturbed


def test_to_hold_a_body_without_moving_disturbs_nothing() -> None:
    session = Session(scenes.level())
    session.toggle()

    session.grab("ball", (0, 5))
    session.update(0.1)
    session.release()

    assert not session.world.disturbed


def test_a_body_that_is_held_when_time_stops_is_put_from_then_on() -> None:
    session = Session(scenes.level())
    session.toggle()
    session.grab("ball", (0, 5))
    session.drag((1, 5))
    session.update(0.1)

    session.toggle()
    session.drag((3, 3))

    assert session.world.snapshot.position[0] == pytest.approx([3, 3], abs=0.2)


def test_a_string_that_cannot_be_kept_stops_the_run_and_leaves_the_last_good_state() -> None:
    session = Session(parse(scenes.runaway()))

    play(session)

    assert session.failure is not None
    assert "string" in str(session.failure)
    assert np.isfinite(session.world.snapshot.position).all()
    session.toggle()
    assert not session.playing
    session.restart()
    assert session.failure is None


def test_the_energies_of_a_fall_are_exchanged() -> None:
    session = Session(scenes.level())
    play(session)

    start, now = session.books.start, session.books.energies

    assert start.kinetic == 0
    assert now.kinetic == pytest.approx(50)
    assert now.total == pytest.approx(start.total)


def test_energies_are_compared_with_those_that_a_hand_has_left() -> None:
    """The work of the hand does not count as a change that the run has made itself."""
    session = Session(scenes.level())
    run = session.run

    run.act("place", "ball", (0.0, 30.0))
    assert run.books.start.total == pytest.approx(300)
    for _ in range(20):
        session.step()
    assert run.books.energies.total == pytest.approx(run.books.start.total)
    run.act("grab", "ball", (0.0, 30.0))
    run.act("drag", "", (5.0, 40.0))
    for _ in range(20):
        session.step()
    assert run.books.energies.total > 1.1 * run.books.start.total
    run.act("release", "", (0.0, 0.0))
    for _ in range(10):
        session.step()

    assert run.books.energies.total == pytest.approx(run.books.start.total, rel=1e-3)


def test_the_speeds_go_from_a_twentieth_to_sixteen_and_no_further() -> None:
    session = Session(scenes.level())

    for _ in range(20):
        session.slower()
    assert session.speed == 0.05
    for _ in range(20):
        session.faster()

    assert session.speed == SPEEDS[-1] == 16


def test_a_full_trail_is_thinned_and_keeps_its_beginning() -> None:
    session = Session(scenes.level(duration=1000))
    for _ in range(4500):
        session.step()

    assert len(session.trail) <= 4000
    assert session.trail.version == 1
    assert session.trail.points[0, 0] == pytest.approx([0, 5])
    assert session.trail.points[-1, 0] == pytest.approx(
        session.world.snapshot.position[0], rel=1e-3
    )


def test_a_run_that_is_no_longer_to_be_trusted_goes_on_if_somebody_wants_it() -> None:
    session = Session(parse(json.dumps(crowd("gas", 300))))
    session.toggle()
    while session.failure is None:
        session.update(0.1, budget=10.0)
    assert session.doubted

    session.toggle()
    at = session.t
    session.update(0.5, budget=10.0)

    assert goes_on(session)
    assert session.t > at
    assert session.milestones() == ()


def goes_on(session: Session) -> bool:
    return session.failure is None and session.playing


def test_a_run_that_is_lost_does_not_go_on() -> None:
    session = scenes.play(Session(parse(scenes.runaway())))
    assert session.failure is not None

    session.toggle()

    assert session.failure is not None
    assert not session.playing


def test_a_run_with_parameters_of_its_own_begins_anew_in_any_form_of_its_level() -> None:
    """A run that was edited has other parameters than its level, without those no longer used.

    When it was restarted in another form of the level, they ended the window.
    """
    session = Session(load(level_catalog.find("newton/incline")))
    session.step()
    changed = json.loads(as_it_stands(session.world, anew=False))
    changed["parameters"]["F"] = {"value": 1, "min": 0.5, "max": 2}
    changed["bodies"]["block"]["mass"] = "F*mass"
    session.alter(json.dumps(changed))
    assert session.values.keys() != session.original.parameters.keys()

    session.play_as(session.original)
    session.restart()

    assert session.failure is None
    assert session.values == session.original.defaults


def test_a_run_with_a_value_that_its_level_does_not_allow_begins_anew_without_it() -> None:
    """A run that was edited may have other ranges; restarting it ended the window."""
    session = Session(
        load(level_catalog.find("newton/incline")), values={"angle": 40.0, "mass": 3.0, "g": 9.0}
    )
    session.step()
    changed = json.loads(as_it_stands(session.world, anew=False))
    changed["parameters"]["mass"] = {"value": 1e3, "min": 0.5, "max": 1e4}
    session.alter(json.dumps(changed))
    assert session.values["mass"] > session.original.parameters["mass"].max

    session.restart()

    assert session.failure is None
    assert session.values == {"angle": 40.0, "mass": 3.0, "g": 9.0}


def test_another_pace_takes_a_run_that_was_changed_from_the_start_of_its_level() -> None:
    """It used to restart where the run had been edited, as if that were a level."""
    session = Session(load(level_catalog.find("newton/incline")))
    begun = session.world.snapshot.position.tobytes()
    for _ in range(30):
        session.step()
    session.alter(as_it_stands(session.world, anew=False))

    switching_effects.play_with_stepping(session, session.world.stepping)

    assert session.world.snapshot.position.tobytes() == begun
    assert session.values == session.original.defaults


def test_a_run_records_what_the_checks_of_its_own_level_need() -> None:
    level = scenes.level()
    begun = begin(level, level.defaults, (), patient=True)
    run = LiveRun(level.model_copy(update={"checks": ()}), begun)
    for _ in range(10):
        run.advance()

    assert len(run.readings(hurried=False)) == len(level.checks)
    assert level.checks


def test_what_a_level_must_fulfil_is_evaluated_when_a_value_changes_only(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It took 20 of the 30 ms of each frame of a level whose rods shrink."""
    session = Session(load(level_catalog.find("rotation/collapsing-star")))
    asked: list[object] = []

    def noted(level: Level, settings: Values) -> Values:
        asked.append(settings)
        return choose(level, settings)

    monkeypatch.setattr(session_module, "choose", noted)
    for _ in range(10):
        assert session.values_for(session.begun_as) == session.values
        session.step()
    assert len(asked) == 1

    name = next(iter(session.values))
    session.restart({name: session.level.parameters[name].max})
    assert session.values_for(session.begun_as) == session.values
