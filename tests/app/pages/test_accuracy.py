"""The page of the accuracy, driven by events."""

from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.frame_budget import FRAME, Load
from sandbox.app.pages.accuracy import work_precision_diagram
from sandbox.app.pages.accuracy.background_study import BackgroundStudy
from sandbox.app.pages.accuracy.panel import AccuracyPage
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.model.level import Scheme
from sandbox.physics.accuracy import calibration_cache, error_causes_and_costs
from sandbox.physics.accuracy.error_causes_and_costs import CurrentSetting, WorkPrecisionPoint
from sandbox.physics.accuracy.trusted_digits import certain_digits
from sandbox.physics.run import build
from tests.app import scenes, work
from tests.app.person import Person, until
from tests.patience import alive

DRAG = {"gravity": {"acceleration": [0, "-g"]}, "drag": {"linear": 0.1}}


def busy(person: Person) -> bool:
    return person.window.workers.of(BackgroundStudy).running


def waits(person: Person) -> bool:
    return person.session.waiting


@pytest.fixture
def player(person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Person]:
    """A person who has opened the page of the accuracy, with a ball that falls with drag."""
    monkeypatch.setattr(error_causes_and_costs, "study", work.short_study)
    person.open(tmp_path, scenes.falling(effects=DRAG, ghosts={}))
    person.press(pygame.K_a, "a")
    yield person
    person.window.close()


@pytest.fixture
def informed(player: Person) -> Person:
    """A person to whom the costs of the schemes are known, and now also the run's error."""
    studying = player.window.workers.of(BackgroundStudy)
    studying.points.append(WorkPrecisionPoint("leapfrog", 60, 1e-4, 1e-3))
    until(player, lambda: studying.here is not None and not studying.running)
    return player


def test_the_legend_below_the_diagram_has_room_for_all_schemes(player: Person) -> None:
    """The last two, of sixth and eighth order, were drawn in the diagram but cut off below it."""
    page, colors = player.page(AccuracyPage), work_precision_diagram.colors()
    points = [WorkPrecisionPoint(scheme, 60, 1e-4, 1e-3) for scheme in get_args(Scheme)]
    assert {point.scheme for point in points} == colors.keys()

    legend = work_precision_diagram.legend(page._sheet.pen, page._sheet.width, points)
    page._studying.points = points
    drawn = page._drawn()
    foot = drawn.subsurface((0, drawn.height - legend.height, *legend.size))

    pixels = pygame.surfarray.array3d(foot)
    assert (pixels == pygame.surfarray.array3d(legend)).all()
    assert all((pixels == color).all(axis=2).any() for color in colors.values())
    assert page._diagram.image.get_height() == drawn.height


@pytest.mark.sweep
def test_it_is_measured_without_being_asked_and_drawn(player: Person) -> None:
    studying = player.window.workers.of(BackgroundStudy)
    until(player, lambda: studying.here is not None and not studying.running)

    assert {"leapfrog", "symplectic-euler"} <= {point.scheme for point in studying.points}
    side = player.window.surface.subsurface(player.window.panels.layout.side)
    pixels = pygame.surfarray.array3d(side)
    for scheme in ("leapfrog", "symplectic-euler"):
        assert (pixels == work_precision_diagram.colors()[scheme]).all(axis=2).sum() > 60
    assert set(studying.splits(player.session)) == {0, 1}


def test_nothing_is_measured_where_nobody_looks(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, scenes.falling())
    person.wait(2)

    assert not person.window.workers.of(BackgroundStudy).running


def test_the_work_is_cancelled_by_its_button_and_begun_again(player: Person) -> None:
    player.wait(1)
    assert busy(player)
    assert player.page(AccuracyPage).button.text == "Cancel"

    player.click(player.page(AccuracyPage).button.rect)
    assert not busy(player)
    assert player.page(AccuracyPage).button.text == "Measure"
    player.wait(1)
    assert not busy(player)
    player.click(player.page(AccuracyPage).button.rect)

    assert busy(player)


def test_looking_for_a_setting_is_not_cut_short_by_measuring(player: Person) -> None:
    player.window.workers.of(BackgroundStudy).seek(player.session, 1e-12)
    pid = player.window.workers.of(BackgroundStudy)._work.pid
    player.wait(1)

    assert pid is not None
    assert player.window.workers.of(BackgroundStudy)._work.pid == pid


def test_what_was_looked_for_is_not_done_to_another_level(player: Person) -> None:
    player.window.workers.of(BackgroundStudy).seek(player.session, 1e-3)
    player.press(pygame.K_o, "o")

    player.press(pygame.K_DOWN)

    assert not busy(player)
    assert player.session.world.stepping == player.session.original.stepping


def test_a_change_of_a_parameter_makes_what_was_known_void(informed: Person) -> None:
    studying = informed.window.workers.of(BackgroundStudy)
    assert studying.points
    assert studying.splits(informed.session)

    informed.session.restart({"g": 5})
    informed.wait()

    assert studying.points == []
    assert studying.here is None
    assert studying.splits(informed.session) == {}


def test_the_dial_asks_for_an_accuracy_and_the_level_is_played_so(player: Person) -> None:
    studying = player.window.workers.of(BackgroundStudy)
    knob = player.page(AccuracyPage).dial.sliding_button
    assert knob is not None
    start = knob.rect.center

    player.drag(start, (start[0] + 70, start[1]))
    asked = studying.target
    until(player, lambda: player.session.world.stepping.rate != 60)

    assert asked is not None
    assert asked < 1e-6
    assert studying.here is None or studying.here.error <= asked
    level = player.session.level
    assert player.session.companions == ()
    exact = build(level, player.session.values).stepping
    assert exact == player.session.world.stepping


def test_the_dial_goes_back_when_another_level_asks_for_nothing(
    player: Person, tmp_path: Path
) -> None:
    dial = player.page(AccuracyPage).dial
    before = dial.get_current_value()
    assert dial.sliding_button is not None
    start = dial.sliding_button.rect.center
    player.drag(start, (start[0] + 70, start[1]))
    player.wait()
    assert dial.get_current_value() > before

    player.open(tmp_path, scenes.falling())
    player.wait()

    assert player.page(AccuracyPage).dial.get_current_value() == before


ASKING = scenes.falling(effects=DRAG, ghosts={}, stepping={"accuracy": 1e-3})


@pytest.fixture
def in_the_background(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is computed in the window's process, and nothing was computed before."""

    def calibrate(*_: object, **__: object) -> None:
        pytest.fail("the window waits")

    monkeypatch.setattr(calibration_cache, "folder", lambda: tmp_path / "cache")
    monkeypatch.setattr(calibration_cache, "_unkept", {})
    monkeypatch.setattr(calibration_cache, "calibrate", calibrate)


@pytest.mark.usefixtures("in_the_background")
def test_a_level_that_asks_for_an_accuracy_waits_for_it_and_the_window_does_not(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, ASKING)
    person.press(pygame.K_SPACE, " ")
    person.wait(0.3)
    assert waits(person)
    assert person.session.world.steps == 0

    until(person, lambda: not waits(person))
    person.wait(0.3)

    assert person.session.setting is not None
    assert person.session.world.stepping == person.session.setting.chosen.stepping
    assert person.session.world.steps > 0
    person.session.restart()  # it is known now
    assert not waits(person)
    person.session.restart({"g": 5})  # it is not known of this one
    assert waits(person)
    person.window.close()


@pytest.mark.usefixtures("in_the_background")
def test_an_accuracy_that_cannot_be_had_is_told_instead_of_a_run(
    person: Person, tmp_path: Path
) -> None:
    pushed = {"type": "kinematic", "shape": {"type": "disc", "radius": 1}, "velocity": [1, 0]}
    nothing: dict[str, object] = {"parameters": {}, "effects": {}, "checks": [], "ghosts": {}}
    asks = scenes.falling(**nothing, bodies={"ball": pushed}, stepping={"accuracy": 1e-6})
    person.open(tmp_path, asks)

    until(person, lambda: person.session.failure is not None)

    assert "nothing moves freely" in str(person.session.failure)
    assert not person.session.playing


@pytest.mark.usefixtures("in_the_background")
def test_a_search_that_is_cancelled_is_no_setting(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, ASKING)
    until(person, lambda: busy(person))

    person.window.workers.of(BackgroundStudy).cancel()
    person.wait(0.1)

    assert "cancelled" in str(person.session.failure)
    assert not busy(person)


@pytest.mark.usefixtures("in_the_background")
def test_an_accuracy_that_was_asked_for_beside_the_level_outlives_a_reload(
    person: Person, tmp_path: Path
) -> None:
    path = tmp_path / "level.json"
    path.write_text(scenes.falling(), encoding="utf-8")
    person.window.open_level(str(path), accuracy=1e-3)

    person.press(pygame.K_F5)

    assert person.session.level.stepping.accuracy == 1e-3


@pytest.mark.sweep
def test_only_digits_that_survive_are_shown_and_how_far_they_go(informed: Person) -> None:
    window = informed.window
    informed.press(pygame.K_SPACE, " ")
    informed.wait(1.2)
    informed.press(pygame.K_o, "o")
    with_digits = window.surface.subsurface(window.panels.layout.side).copy()

    window.workers.of(BackgroundStudy)._splits.clear()
    informed.press(pygame.K_o, "o")

    side = window.surface.subsurface(window.panels.layout.side)
    assert pygame.image.tobytes(side, "RGB") != pygame.image.tobytes(with_digits, "RGB")


@pytest.mark.parametrize(
    ("value", "off", "digits"),
    [
        (3.14159, 2e-4, 4),
        (3.14159, 9e-4, 3),
        (3.14159, 2e-9, 8),
        (7.0, 1.0, 1),
        (0.02, 1.0, 0),
        (0.0, 1.0, 5),
        (7.0, 0.0, 5),
    ],
)
def test_digits_survive_that_are_larger_than_the_error(
    value: float, off: float, digits: int
) -> None:
    assert certain_digits(value, off) == digits


def test_digits_survive_in_the_unit_that_is_read() -> None:
    """0.1 rad ± 4e-4 has three digits, but 5.73° ± 0.023° only two."""
    assert formatting.trusted_value(0.1, 4e-4, "rad") == "5.7°"
    assert formatting.trusted_value(1234.0, 40.0, "J") == "1.2×10³ J"
    assert formatting.trusted_value(0.02, 1.0, "m") == "0 m"


def test_closing_the_window_ends_the_work(player: Person) -> None:
    player.wait(1)
    pid = player.window.workers.of(BackgroundStudy)._work.pid
    assert pid is not None

    player.window.close()

    assert not alive(pid)


def test_frames_go_on_while_it_is_measured(player: Person) -> None:
    player.press(pygame.K_SPACE, " ")
    player.wait(0.7)
    assert player.window.workers.of(BackgroundStudy).running

    before = player.session.world.steps
    player.wait(0.25)

    assert player.session.world.steps == before + 15


def test_a_load_is_smoothed_and_adds_up() -> None:
    load = Load()
    for _ in range(200):
        load.note_steps(0.5 * FRAME, 0.2 * FRAME)
        load.note_drawing(0.1 * FRAME)

    assert load.shares == pytest.approx({"physics": 0.3, "hooks": 0.2, "drawing": 0.1})


def test_hooks_are_timed_only_when_it_is_asked_for_and_change_no_bit() -> None:
    plain, timed = (Session(scenes.level(effects=DRAG)) for _ in range(2))
    timed.world.kicks.time_calls()
    for session in (plain, timed):
        for _ in range(30):
            session.step()

    assert plain.world.kicks.seconds == 0
    assert timed.world.kicks.seconds > 0
    assert timed.world.snapshot.position.tobytes() == plain.world.snapshot.position.tobytes()


def test_a_diagram_stands_on_whole_powers_of_ten(pen: Pen) -> None:
    points = [
        WorkPrecisionPoint("leapfrog", 60, 2e-4, 2e-3),
        WorkPrecisionPoint("leapfrog", 120, 5e-5, 4e-3),
    ]
    here = CurrentSetting("leapfrog", 240, 1e-5, 8e-3)

    drawn = work_precision_diagram.draw(pen, (278, 158), points, here)

    across = work_precision_diagram.axis(
        [2.0, 4.0, 8.0], work_precision_diagram.LEFT, 278 - work_precision_diagram.RIGHT
    )
    assert (across.low, across.high) == (0, 1)
    x, y = (
        across.pixel(2.0),
        work_precision_diagram.axis(
            [2e-4, 5e-5, 1e-5], 158 - work_precision_diagram.BELOW, 8
        ).pixel(2e-4),
    )
    color = drawn.get_at((round(x), round(y)))[:3]
    assert color == pytest.approx(work_precision_diagram.colors()["leapfrog"], abs=3)
    empty = pygame.surfarray.array3d(work_precision_diagram.draw(pen, (278, 158), [], None))
    assert (empty[:, :60] == theme.STAGE).all()
    assert (empty[:, 60:100] != theme.STAGE).any()  # it says that nothing is measured yet


def test_a_study_forgets_what_it_knew_of_another_run() -> None:
    studying, session = BackgroundStudy(), Session(scenes.level())
    studying.follow(session, 0.0, watched=True)
    studying._take(CurrentSetting("leapfrog", 60, 1e-5, 1e-3))

    studying.follow(Session(scenes.level()), 0.0, watched=False)

    assert studying.here is None
