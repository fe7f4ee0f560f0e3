"""Back and forth in a run: however a step is reached, its state is the same to the bit."""

import json

import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.observing.impacts import RecordedImpact
from sandbox.app.pages.graph.chosen_quantities import Choice
from sandbox.app.panels.play_bar import PlayBar, notes
from sandbox.app.runs import keyframes, run_player
from sandbox.app.runs.session import Session
from sandbox.editing.run_as_level import as_it_stands
from sandbox.model.errors import SandboxError
from tests.app.person import Person
from tests.app.scenes import opened
from tests.levels.playing import fingerprint

LEVELS = ["newton/atwood", "momentum/cradle", "machines/seesaw", "lagrange/double-pendulum"]


@pytest.fixture(autouse=True, params=["from the start", "from keyframes"])
def spacing(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep no keyframe, or one at each step."""
    anew = request.param == "from the start"
    monkeypatch.setattr(keyframes, "SPACING", 1e9 if anew else 0.0)  # s
    monkeypatch.setattr(keyframes, "SHARE", 1e9)


def take(session: Session, steps: int) -> str:
    """Take some steps, and return a value that identifies the state there."""
    for _ in range(steps):
        session.step()
    return fingerprint(session.world.snapshot)


def go_to(session: Session, step: int) -> None:
    """Go to a step, however many frames it takes."""
    session.go_to(step)
    arrive_in(session)


def arrive_in(session: Session) -> None:
    """Show frames until the requested step is reached."""
    while session.sought is not None:
        session.update(1 / 60)


def lift(session: Session) -> None:
    """Put the left body of an Atwood machine a metre higher."""
    session.grab("left", (-0.6, 0.0))
    session.drag((-0.6, 1.0))
    session.release()


@pytest.mark.parametrize("name", LEVELS)
def test_a_run_that_goes_back_comes_to_the_same_states_again(name: str) -> None:
    session = opened(name)
    early = take(session, 20)
    late = take(session, 30)

    go_to(session, 20)
    assert fingerprint(session.world.snapshot) == early

    go_to(session, 50)
    assert fingerprint(session.world.snapshot) == late


def pulled() -> tuple[Session, dict[int, str]]:
    """Return a run at step 40, in which a hand held a body from 10 to 20; and its states."""
    session, states = opened("newton/atwood"), {}
    take(session, 10)
    session.playing = True
    session.grab("left", (-0.6, 0.0))
    session.drag((-0.6, 0.5))
    for step in range(11, 41):
        session._advance()
        states[step] = fingerprint(session.world.snapshot)
        if step == 15:
            session.drag((-0.6, 0.7))
        if step == 20:
            session.release()
    session.playing = False
    return session, states


def kinds(session: Session) -> list[str]:
    return [action.kind for action in session.all_actions]


def test_what_a_hand_did_is_done_again_back_and_ahead() -> None:
    session, states = pulled()
    done = ["grab", "drag", "drag", "release"]
    assert kinds(session) == done

    for step in (40, 15, 35, 12, 3, 17, 38):
        go_to(session, step)
        assert kinds(session) == done
        if step > 10:
            assert fingerprint(session.world.snapshot) == states[step]

    go_to(session, 5)
    session.playing = True
    while session.world.steps < 40:
        session._advance()
    assert fingerprint(session.world.snapshot) == states[40]
    free = opened("newton/atwood")
    assert fingerprint(session.world.snapshot) != take(free, 40)
    assert session.earlier == ()


def test_something_new_at_an_earlier_step_starts_another_future_and_the_old_one_stays() -> None:
    session, _ = pulled()
    go_to(session, 17)  # while the body is held

    lift(session)

    assert kinds(session) == ["grab", "drag", "drag", "release", "place"]
    assert [action.step for action in session.all_actions] == [10, 10, 15, 17, 17]
    (left,) = session.earlier
    assert left.label(session.values).startswith("left at ")
    assert left.world.steps == 40
    assert session.later is None
    state = take(session, 20)
    go_to(session, 0)
    go_to(session, 37)
    assert fingerprint(session.world.snapshot) == state


def test_a_branch_is_taken_again_back_and_ahead() -> None:
    session = opened("kinematics/projectile")
    take(session, 20)
    session.branch({"g": 3.0})
    state = take(session, 20)

    go_to(session, 5)
    assert session.values["g"] != 3.0
    go_to(session, 40)

    assert session.values["g"] == 3.0
    assert fingerprint(session.world.snapshot) == state
    assert len(session.earlier) == 1


def test_another_branch_at_an_earlier_step_takes_the_place_of_the_later_one() -> None:
    session = opened("kinematics/projectile")
    take(session, 20)
    session.branch({"g": 3.0})
    take(session, 60)
    go_to(session, 10)

    session.branch({"g": 5.0})

    assert kinds(session) == ["branch"]
    assert [run.world.steps for run in session.earlier] == [20, 80]


def test_what_was_recorded_on_both_sides_of_a_move_is_shown_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    session = opened("newton/atwood")
    early = take(session, 20)
    take(session, 10)
    lift(session)
    late = take(session, 20)
    take(session, 10)
    go_to(session, 25)
    slowly(monkeypatch)

    session.go_to(20)
    assert fingerprint(session.shown.snapshot) == early
    session.go_to(50)
    assert fingerprint(session.shown.snapshot) == late


def test_what_was_put_elsewhere_before_the_start_still_is_after_the_way_back_to_it() -> None:
    session = opened("momentum/cradle")
    session.grab("ball2", (0.2, 0.0))
    session.drag((-0.4, 0.25))
    session.release()
    lifted = fingerprint(session.world.snapshot)
    take(session, 30)

    go_to(session, 0)

    assert fingerprint(session.world.snapshot) == lifted
    assert len(session.actions) == 1


def slowly(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a way back take more than a frame from now on, as without keyframes."""
    monkeypatch.setattr(keyframes, "can_be_saved", lambda _: False)
    monkeypatch.setattr(run_player, "AT_ONCE", 0.0)  # s
    monkeypatch.setattr(run_player, "ON_THE_WAY", 1e-4)  # s: a few steps


def test_what_was_recorded_is_shown_before_a_long_way_is_done(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    session = opened("lagrange/double-pendulum")
    states = {step: (take(session, 1), step)[0] for step in range(1, 61)}
    slowly(monkeypatch)

    for step in (20, 5, 50):
        session.go_to(step)

        assert session.world.steps < step
        assert fingerprint(session.shown.snapshot) == states[step]
        session.update(1 / 60)
        assert session.shown is not session.world

    arrive_in(session)
    assert session.shown is session.world
    assert fingerprint(session.shown.snapshot) == states[50]


def test_nothing_recorded_is_shown_of_another_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pulling a body after going back makes the recorded rest that of another run."""
    session = opened("newton/atwood")
    take(session, 30)
    go_to(session, 10)
    lift(session)
    slowly(monkeypatch)

    session.go_to(25)
    assert session.shown is session.world
    arrive_in(session)
    session.go_to(20)
    assert session.shown is not session.world


def test_a_single_step_on_the_way_moves_what_is_sought(monkeypatch: pytest.MonkeyPatch) -> None:
    session = opened("lagrange/double-pendulum")
    take(session, 60)
    slowly(monkeypatch)
    session.go_to(40)

    session.step()
    assert session.sought == 41
    session.step_back()
    assert session.sought == 40


def test_a_run_on_its_way_does_not_branch(monkeypatch: pytest.MonkeyPatch) -> None:
    session = opened("kinematics/projectile")
    take(session, 60)
    slowly(monkeypatch)
    session.go_to(40)

    with pytest.raises(SandboxError, match="still on its way"):
        session.branch({"g": 3.0})


def test_a_body_that_was_put_elsewhere_is_put_there_again() -> None:
    session = opened("newton/atwood")
    take(session, 5)
    lift(session)
    moved = take(session, 10)
    take(session, 10)

    go_to(session, 15)

    assert session.world.disturbed
    assert fingerprint(session.world.snapshot) == moved


def test_single_steps_back_end_at_the_start() -> None:
    session = opened("kinematics/free-fall")
    start = fingerprint(session.world.snapshot)
    take(session, 3)

    for left in (2, 1, 0, 0):
        session.step_back()
        go_to(session, left)
        assert session.world.steps == left
    assert fingerprint(session.world.snapshot) == start


def test_no_way_leads_beyond_the_end_of_the_level() -> None:
    session = opened("kinematics/free-fall")

    go_to(session, 10**6)

    assert session.at_end
    assert not session.playing


def test_beyond_the_end_of_the_level_a_way_leads_as_far_as_the_run_has_been(
    person: Person,
) -> None:
    """The bar used to end with the level, so later steps could not be reached with it."""
    person.window.open_level("kinematics/free-fall")
    session = person.session
    take(session, session.end + 50)
    state = fingerprint(session.world.snapshot)
    track = track_of(person)
    assert next(notes(session))[0] == f"complete at {session.duration:.2f} s"

    person.click((track.x + track.width * session.end / (session.end + 50), track.centery))
    arrive(person)
    assert abs(session.world.steps - session.end) <= 2
    person.click((track.right - 1, track.centery))
    arrive(person)
    go_to(session, session.end + 50)

    assert fingerprint(session.world.snapshot) == state


def test_a_long_way_takes_some_frames_and_then_time_goes_on() -> None:
    session = opened("kinematics/free-fall")
    session.go_to(30)
    session.playing = True
    session._begin_again(20)
    assert session.sought == 20

    arrive_in(session)

    assert (session.world.steps, session.playing) == (20, True)


def test_an_earlier_run_with_other_parameters_stays_as_a_trail() -> None:
    session = opened("kinematics/projectile")
    take(session, 20)
    session.restart({"angle": 60})
    take(session, 20)
    session.restart({"angle": 30, "speed": 20})

    labels = [run.label(session.values) for run in session.earlier]
    assert labels == ["speed = 25, angle = 45", "speed = 25, angle = 60"]
    assert all(len(run.trail) == 21 for run in session.earlier)
    session.restart()
    assert len(session.earlier) == 2


def test_an_earlier_run_is_told_by_all_in_which_it_differs() -> None:
    session = opened("kinematics/projectile")
    take(session, 20)
    session.restart({"speed": 20})
    session.restart({"angle": 60, "speed": 20})

    labels = [run.label(session.values) for run in session.earlier]
    assert labels == ["speed = 25, angle = 45"]


def test_of_two_earlier_runs_with_one_value_alike_both_stay() -> None:
    session = opened("kinematics/projectile")
    take(session, 20)
    session.restart({"speed": 20, "angle": 45})
    session.restart({"speed": 25, "angle": 60})
    take(session, 20)
    session.restart({"speed": 20, "angle": 60})

    labels = [run.label(session.values) for run in session.earlier]
    assert labels == ["speed = 25, angle = 45", "speed = 25"]


def track_of(person: Person) -> pygame.Rect:
    controls = person.window.panels.controls
    assert isinstance(controls, PlayBar)
    return controls._track


def arrive(person: Person) -> None:
    while person.session.sought is not None:
        person.wait()


def test_a_click_on_the_bar_of_the_time_goes_there(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_SPACE, " ")
    person.wait(1.0)
    track = track_of(person)

    person.click((track.x + track.width * 0.25, track.centery))
    arrive(person)
    assert person.session.world.steps >= round(person.session.end / 4)

    person.press(pygame.K_SPACE, " ")
    person.drag((track.x + 2, track.centery), (track.right - 2, track.centery))
    arrive(person)
    assert person.session.world.steps >= person.session.end - 2
    person.press(pygame.K_LEFT)
    arrive(person)
    assert person.session.world.steps < person.session.end


def test_the_bar_of_the_time_marks_what_a_hand_did_and_scrubbing_keeps_it(person: Person) -> None:
    person.window.open_level("newton/atwood")
    for _ in range(30):
        person.press(pygame.K_RIGHT)
    x, y = person.session.world.snapshot.position[0]
    person.drag(person.on_screen((x, y)), person.on_screen((x, y + 0.5)))
    for _ in range(30):
        person.press(pygame.K_RIGHT)
    done, session = list(person.session.actions), person.session
    state = fingerprint(session.world.snapshot)
    assert done
    track = track_of(person)

    def at(step: int) -> tuple[float, float]:
        return track.x + track.width * step / session.end, float(track.centery)

    assert person.color_at((round(at(30)[0]), track.bottom + 1)) == theme.NOTICE
    person.drag(at(60), at(5))
    arrive(person)
    assert session.world.steps < 30
    person.wait()
    assert person.color_at((round(at(30)[0]), track.bottom + 1)) == theme.NOTICE
    person.drag(at(session.world.steps), at(60))
    arrive(person)

    assert list(session.actions) == done
    session.go_to(60)
    arrive(person)
    assert fingerprint(session.world.snapshot) == state


def test_the_column_says_of_what_time_it_tells_while_another_one_is_shown(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("lagrange/double-pendulum")
    take(person.session, 60)
    slowly(monkeypatch)
    person.session.go_to(40)
    person.wait()

    assert person.side.foot is not None
    pixel = person.side._sheet.container.rect.left + 2, person.side.foot.top + 2
    assert person.session.recalled
    assert person.color_at(pixel) == theme.RAISED
    arrive(person)
    person.wait()
    assert person.color_at(pixel) == theme.PANEL


def test_impacts_are_marked_and_a_click_near_a_mark_goes_exactly_there(person: Person) -> None:
    person.window.open_level("momentum/cradle")
    take(person.session, 400)
    person.wait()
    session, track = person.session, track_of(person)
    first = session.run.marks.shown[0]
    assert set(first.names) <= {"ball1", "ball2"}

    def mark() -> tuple[float, float]:
        return track.x + track.width * first.steps / session.end, float(track.centery)

    person.move(mark())
    controls = person.window.panels.controls
    assert isinstance(controls, PlayBar)
    ((told, _),) = controls._pointed_at(session)
    assert "ball 1 strikes ball 2" in told
    assert " N s" in told

    person.click((mark()[0] + 4, mark()[1]))
    arrive(person)
    assert session.world.steps == first.steps
    assert session.flashes

    go_to(session, 0)  # what is still to come again stays marked
    assert first in session.run.marks.shown
    session.grab("ball1", (0.0, 0.0))
    session.drag((0.1, 0.0))
    session.release()
    assert session.run.marks.shown == []


def test_a_run_with_very_many_impacts_has_no_marks() -> None:
    session = opened("hard/100-on-five")
    for step in range(1, 200):
        session.run.marks.note(
            [RecordedImpact(step, step / 60, (0.0, 0.0), 1.0, 0, ("a", "b"), 1.0)]
        )

    assert session.run.marks.shown == ()


def count(session: Session) -> int:
    """Return how many earlier runs are drawn over the present one."""
    return len(session.earlier)


def test_runs_with_other_bodies_are_not_laid_over_the_present_one(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("kinematics/projectile")
    session = person.session
    take(session, 60)
    session.restart({"angle": 60})
    take(session, 60)
    text = json.loads(as_it_stands(session.world, anew=False))
    text["bodies"]["extra"] = {
        "shape": {"type": "disc", "radius": 0.3}, "mass": 1, "position": [3, 5],
    }  # fmt: skip
    assert count(session) == 1
    person.press(pygame.K_d, "d")

    session.alter(json.dumps(text))
    person.wait()
    assert count(session) == 0
    person.window.workers.of(Choice).choose(session, ("extra.speed",))
    take(session, 20)
    person.wait()
    go_to(session, 10)
    person.wait()
    assert count(session) == 1
    slowly(monkeypatch)
    session.go_to(75)  # with the other body, while the run itself has not got it yet
    person.wait()
    assert session.recalled
    x, y = person.window.panels.layout.stage.center
    person.move((float(x), float(y)))
    arrive_in(session)
    person.wait()
    assert "extra" in session.level.bodies


def test_a_body_may_be_moved_in_a_run_that_goes_on_with_other_parts() -> None:
    session = opened("kinematics/projectile")
    take(session, 20)
    text = json.loads(as_it_stands(session.world, anew=False))
    text["bodies"]["other"] = text["bodies"].pop("ball")
    text["checks"] = [{"quantity": "other.speed", "formula": "1", "tolerance": 1}]
    text.pop("ghosts", None)
    session.alter(json.dumps(text))

    session.grab("other", (3.0, 3.0))
    session.drag((4.0, 4.0))
    session.release()
    take(session, 5)

    assert session.readings()
    assert session.world.steps == 25


@pytest.mark.sweep
def test_arrows_keep_their_scale_on_the_way_back(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("momentum/cradle")
    for _ in range(40):
        take(person.session, 10)
        person.wait()
    scale = person.window.stage.view.fastest
    slowly(monkeypatch)

    for step in (380, 60):
        person.session.go_to(step)
        person.wait()
        assert person.session.recalled
        assert person.window.stage.view.fastest == scale
        arrive(person)
        person.wait()
        assert person.window.stage.view.fastest == scale
