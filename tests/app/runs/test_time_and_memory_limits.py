"""A run that takes too much time or memory pauses, says so, and continues on request."""

from pathlib import Path

import pygame
import pytest

from sandbox.app.open_level_and_panels import MANY
from sandbox.app.runs import time_and_memory_limits
from sandbox.app.runs.session import Session
from sandbox.app.window import Window
from sandbox.physics.measuring import recording
from tests.app import scenes
from tests.app.person import Person

FRAME = 1 / 60  # s


@pytest.fixture
def slow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every step take too long."""
    monkeypatch.setattr(time_and_memory_limits, "SLOW", 0.0)


def played(*, patient: bool = False) -> Session:
    """Return a session that has played for the frames of the level's duration."""
    session = Session(scenes.level(), patient=patient)
    session.toggle()
    for _ in range(100):
        session.update(FRAME)
    return session


@pytest.mark.usefixtures("slow")
def test_a_run_whose_steps_take_long_pauses_after_two_and_says_so() -> None:
    session = played()

    assert session.world.steps == 2  # the first may have been held up by the machine
    assert not session.playing
    assert session.failure is None
    assert session.halted.startswith("A step takes 0.0")


@pytest.mark.usefixtures("slow")
def test_who_plays_it_all_the_same_is_not_asked_again() -> None:
    session = played()

    session.toggle()
    for _ in range(100):
        session.update(FRAME)

    assert session.at_end
    assert not session.halted


@pytest.mark.usefixtures("slow")
def test_a_way_ahead_ends_where_steps_take_long_and_can_be_taken_up_again() -> None:
    session = Session(scenes.level(), patient=False)

    session.go_to(40)
    assert (session.world.steps, session.sought) == (2, None)
    session.go_to(40)
    for _ in range(40):
        session.update(FRAME)
    assert (session.world.steps, session.sought) == (40, None)


@pytest.mark.usefixtures("slow")
def test_where_nobody_looks_no_run_pauses() -> None:
    assert played(patient=True).at_end


@pytest.mark.sweep
@pytest.mark.usefixtures("slow")
def test_the_window_says_why_it_has_paused_and_another_level_can_be_opened() -> None:
    window = Window((900, 600))
    window.open_level("kinematics/free-fall")
    window.do("play")
    for _ in range(4):
        window.frame(FRAME)

    assert window.session is not None
    assert window.session.world.steps == 2
    assert window.session.halted
    window.open_level("newton/atwood")
    assert not window.session.halted
    window.close()


def test_a_recording_ends_where_memory_should_hold_no_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "LARGEST", 8 * 3 * 20)
    session = played()

    count = len(session.trace.t)
    assert session.halted.startswith(f"{count} instants are recorded")
    assert session.world.steps == count - 1 < session.end
    session.toggle()
    for _ in range(100):
        session.update(FRAME)

    assert session.at_end
    assert len(session.trace.t) == count


def crowd(count: int) -> str:
    """Return the JSON of a number of falling discs."""
    disc = {"type": "disc", "radius": 0.1}
    bodies = {
        f"disc{i}": {"shape": disc, "mass": 1, "position": [0.3 * (i % 20), 0.3 * (i // 20)]}
        for i in range(count)
    }
    g = {"g": {"value": 10, "min": 0, "max": 20}}
    return scenes.falling(title="A crowd", bodies=bodies, parameters=g, checks=[], ghosts={})


@pytest.mark.parametrize(("count", "said"), [(MANY + 1, True), (20, False)])
def test_what_takes_long_to_build_is_said_before_it_is_built(
    person: Person, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, count: int, said: bool
) -> None:
    person.window.open_level("kinematics/free-fall")
    person.wait()
    before = pygame.image.tobytes(person.window.surface, "RGB")
    shown, build = [], Session

    def watched(*arguments: object, **options: object) -> object:
        shown.append(pygame.image.tobytes(person.window.surface, "RGB"))
        return build(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr("sandbox.app.open_level_and_panels.Session", watched)
    path = tmp_path / "crowd.json"
    path.write_text(crowd(count), encoding="utf-8")
    person.window.open_level(str(path))

    assert person.session.level.title == "A crowd"
    assert [picture != before for picture in shown] == [said]


def test_escape_stops_a_long_way_and_the_window_stays(person: Person) -> None:
    person.window.open_level("momentum/cradle")
    person.wait()
    session = person.session
    session.run.end = 100_000
    session.go_to(session.end)
    assert session.sought is not None
    here = session.world.steps

    person.press(pygame.K_ESCAPE)

    assert person.session.sought is None
    assert here <= session.world.steps < session.end
    assert not session.playing
    assert person.window.open
