"""The window, driven by the events that a person causes."""

import gc
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING
from weakref import ref

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.level.panel import LevelPage
from sandbox.app.panels import stage_messages
from sandbox.app.panels.play_bar import PlayBar
from sandbox.app.panels.verdicts_and_energies import counts_in_words
from sandbox.app.panels.window_layout import divide
from sandbox.app.runs import run_file
from sandbox.app.runs.session import Session
from sandbox.app.words.language import Name
from sandbox.model import level_catalog
from sandbox.model.level import Stepping
from sandbox.model.loading import load
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from tests.app import scenes
from tests.app.person import Person

if TYPE_CHECKING:
    from sandbox.physics.measuring.grading import Verdict

RED = (255, 0, 0)


@pytest.fixture
def player(person: Person, tmp_path: Path) -> Person:
    """A person in front of a ball that is about to fall."""
    person.open(tmp_path, scenes.falling())
    person.window.stage.shown["names"] = person.window.stage.shown["arrows"] = False
    return person


def ball(player: Person) -> tuple[float, float]:
    x, y = player.session.world.snapshot.position[0]
    return float(x), float(y)


def beside(player: Person) -> tuple[float, float]:
    """Return a pixel on the ball, clear of the mark in its middle."""
    x, y = player.on_screen(ball(player))
    return x + 9, y + 5


def test_a_body_is_seen_where_the_camera_says_it_is(player: Person) -> None:
    player.wait()

    assert player.color_at(beside(player)) == RED


def test_a_falling_ball_goes_down_on_the_screen(player: Person) -> None:
    def red_rows() -> float:
        pixels = pygame.surfarray.array3d(player.window.surface)
        return float(np.nonzero((pixels == RED).all(axis=2))[1].mean())

    player.wait()
    before = red_rows()
    player.press(pygame.K_SPACE, " ")
    player.wait(0.7)

    assert red_rows() > before + 50


def test_play_and_pause_by_button(player: Person) -> None:
    play = player.window.panels.controls.button("play")

    player.click(play.rect)
    player.wait(0.2)
    assert player.session.playing
    assert play.text == "Pause"
    player.click(play.rect)
    steps = player.session.world.steps
    player.wait(0.2)

    assert steps > 5
    assert player.session.world.steps == steps


@pytest.mark.parametrize("key", ["-", "", "+"])
def test_in_a_window_the_run_ends_in_the_same_bits_as_headless(player: Person, key: str) -> None:
    for _ in range(3 if key else 0):
        player.press(pygame.key.key_code(key), key)
    assert player.session.speed == {"-": 0.1, "": 1, "+": 8}[key]
    player.press(pygame.K_SPACE, " ")
    for _ in range(1000):
        player.wait()
        if not player.session.playing:
            break

    headless = build(player.session.level)
    headless.advance(count_steps(headless))
    assert player.session.at_end
    assert np.array_equal(player.session.world.snapshot.position, headless.snapshot.position)


def test_a_single_step_by_key_and_by_button(player: Person) -> None:
    player.press(pygame.K_RIGHT)
    player.press(pygame.K_PERIOD, ".")
    player.click(player.window.panels.controls.button("step").rect)

    assert player.session.world.steps == 3


def test_restart_by_key_and_by_button(player: Person) -> None:
    player.press(pygame.K_RIGHT)
    player.press(pygame.K_r, "r")
    assert player.session.world.steps == 0

    player.press(pygame.K_RIGHT)
    player.click(player.window.panels.controls.button("restart").rect)
    assert player.session.world.steps == 0


def test_the_speed_is_changed_by_keys_and_buttons(player: Person) -> None:
    player.press(pygame.K_PLUS, "+")
    player.press(pygame.K_RIGHTBRACKET, "]")
    player.click(player.window.panels.controls.button("slower").rect)

    assert player.session.speed == 2


def test_a_level_is_opened_by_a_click_in_the_list(player: Person) -> None:
    assert player.window.panels.list is not None
    path = level_catalog.find("kinematics/free-fall")

    player.click(player.window.panels.list.button(path).rect)

    assert player.session.level.title == "Free fall"


@pytest.mark.sweep
@pytest.mark.all_levels
@pytest.mark.steps(100_000)  # it takes as long as so many
def test_every_level_can_be_walked_to_and_stepped_by_keyboard(player: Person) -> None:
    seen = set()
    for _ in range(len(level_catalog.names()) + 1):
        player.press(pygame.K_DOWN)
        assert player.window.session is not None, player.window.panels.refusal
        player.press(pygame.K_RIGHT)
        assert player.session.world.steps == 1, player.session.level.title
        seen.add(player.session.level.title)

    assert len(seen) == len(level_catalog.names()) + 1
    last = player.session.level.title
    player.press(pygame.K_UP)
    assert player.session.level.title != last


def test_the_panel_of_a_low_window_is_scrolled_by_keyboard(player: Person) -> None:
    player.resize((1024, 400))
    player.wait(0.1)
    field = player.side.parameters.row("g").field
    before, page = field.rect.y, player.side._sheet.container.rect.height

    player.press(pygame.K_PAGEDOWN)
    player.wait(0.1)
    assert field.rect.y <= before - 0.4 * page
    player.press(pygame.K_PAGEUP)
    player.wait(0.1)

    assert field.rect.y == before


def test_a_slider_changes_a_parameter_and_starts_anew(player: Person) -> None:
    row = player.side.parameters.row("g")
    knob = row.slider.sliding_button
    assert knob is not None
    start = knob.rect.center
    player.press(pygame.K_RIGHT)

    player.drag(start, (start[0] + 60, start[1]))

    assert player.session.world.steps == 0
    assert 12 < player.session.values["g"] < 18
    assert float(row.field.get_text()) == player.session.values["g"]


def test_a_number_is_typed_into_a_field(player: Person) -> None:
    field = player.side.parameters.row("g").field

    player.press(pygame.K_TAB)
    assert field.is_focused
    player.type("3.5")
    player.press(pygame.K_RETURN, "\r")

    assert player.session.values["g"] == 3.5
    assert not player.session.playing


def test_what_is_typed_after_a_click_into_a_field_takes_the_place_of_its_number(
    player: Person,
) -> None:
    field = player.side.parameters.row("g").field

    player.click(field.rect)
    player.type("7")
    player.press(pygame.K_RETURN, "\r")

    assert player.session.values["g"] == 7


@pytest.mark.parametrize(
    ("typed", "value"), [("500 g", 0.5), ("g/8", 1.25), ("1,5 kg", 1.5), ("2*0.75", 1.5)]
)
def test_a_parameter_may_have_another_unit_or_be_a_formula_of_the_others(
    player: Person, typed: str, value: float
) -> None:
    player.click(player.side.parameters.row("mass").field.rect)
    player.type(typed)
    player.press(pygame.K_RETURN, "\r")

    assert player.session.values["mass"] == value


@pytest.mark.parametrize("typed", ["5 km", "none", "1/0", "1e999", "*", "nan"])
def test_nonsense_in_the_field_of_a_parameter_is_refused_with_its_reason(
    player: Person, typed: str
) -> None:
    field = player.side.parameters.row("mass").field
    player.click(field.rect)
    player.type(typed)
    player.press(pygame.K_RETURN, "\r")

    assert player.session.values["mass"] == 1
    assert field.get_text() == "1"
    assert player.side.parameters.refusal
    _note_beside(player, field.rect)


def _note_beside(player: Person, field: pygame.Rect) -> None:
    """Assert that a note is framed below a field, until the next key."""
    edge = field.centerx, field.bottom
    assert player.color_at(edge) == theme.FAILED
    player.press(pygame.K_LEFT)
    assert player.side.parameters.refusal == ""
    assert player.color_at(edge) != theme.FAILED


def test_after_a_number_was_typed_space_plays(player: Person) -> None:
    """The field kept the focus and swallowed the key, and afterwards the letters of commands."""
    field = player.side.parameters.row("g").field
    player.click(field.rect)
    player.type("7")
    player.press(pygame.K_RETURN, "\r")

    played = []
    for typed in ("", "", "3"):
        player.type(typed)
        player.press(pygame.K_SPACE, " ")
        played.append(player.session.playing)

    assert played == [True, False, True]
    assert field.get_text() == "7"


def test_the_foot_counts_the_checks_and_leads_to_them(player: Person) -> None:
    player.resize((1024, 640))
    player.press(pygame.K_d, "d")
    side = player.side
    assert side.foot is not None
    assert side.foot.verdicts is not None
    assert side.foot.verdicts.text.startswith("Checks: ")

    player.click(side.foot.verdicts.rect)
    player.wait(0.1)

    side = player.side
    assert isinstance(side.page, LevelPage)
    checks, seen = side._sheet.checks, side._sheet.container.rect
    assert checks is not None
    assert seen.top <= checks.rect.top < seen.bottom - 40


def test_the_checks_are_counted_in_words() -> None:
    verdicts: list[Verdict] = ["passed", "waiting", "passed", "failed", "not applicable"]

    assert counts_in_words(verdicts) == "2 hold, 1 fails, 1 waits, 1 does not apply"


def test_a_field_that_is_left_keeps_what_was_typed(player: Person) -> None:
    player.press(pygame.K_TAB)
    player.type("7")
    player.press(pygame.K_TAB)

    assert player.session.values["g"] == 7


def test_arrows_change_the_number_in_a_field(player: Person) -> None:
    title = player.session.level.title
    player.press(pygame.K_TAB)
    player.press(pygame.K_UP)
    player.press(pygame.K_UP, mod=pygame.KMOD_LSHIFT)

    assert player.session.values["g"] == pytest.approx(10 + 11 * 0.2)
    assert player.session.level.title == title


@pytest.mark.parametrize("typed", ["99", "-", "1e999"])
def test_an_impossible_value_is_told_and_taken_back(player: Person, typed: str) -> None:
    field = player.side.parameters.row("g").field
    player.press(pygame.K_TAB)
    player.type(typed)

    player.press(pygame.K_RETURN, "\r")
    player.wait()

    assert player.session.values["g"] == 10
    assert field.get_text() == "10"
    _note_beside(player, field.rect)


def test_a_long_count_of_the_checks_fits_below_a_narrow_panel(person: Person) -> None:
    """In German the last word was cut off."""
    person.window.comfort.choose(language="de")
    person.resize((900, 600))
    person.window.open_level("machines/drawbridge")
    person.press(pygame.K_SPACE, " ")
    person.wait(1.0)
    foot = person.side.foot
    assert foot is not None
    assert foot.verdicts is not None

    told = foot.verdicts.text

    assert told == "2 bestanden, 1 wartet, 2 nicht anwendbar"
    assert person.window.pen.write(told, 13).width < foot.verdicts.rect.width


def test_a_note_at_the_end_of_the_panel_is_above_its_field(player: Person) -> None:
    player.window.open_level("machines/trebuchet")
    player.resize((900, 600))
    container = player.side._sheet.container.rect
    low = next(r for r in _fields(player) if r.bottom > container.bottom - 40)
    assert low.bottom < container.bottom
    player.click(low)
    player.type("none")
    player.press(pygame.K_RETURN, "\r")

    assert player.color_at((low.centerx, low.top - 1)) == theme.FAILED


def _fields(player: Person) -> list[pygame.Rect]:
    parameters = player.side.parameters
    return [parameters.row(name).field.rect for name in player.session.level.parameters]


def test_keys_that_are_typed_into_a_field_are_no_commands(player: Person) -> None:
    player.press(pygame.K_TAB)
    player.press(pygame.K_PERIOD, ".")

    assert player.session.world.steps == 0


def test_escape_leaves_a_field_before_it_closes_the_window(player: Person) -> None:
    player.press(pygame.K_TAB)
    player.type("3")

    player.press(pygame.K_ESCAPE)
    assert player.window.open
    assert player.session.values["g"] == 10
    player.press(pygame.K_ESCAPE)
    assert player.window.open
    player.press(pygame.K_ESCAPE)

    assert not player.window.open


def test_a_body_is_dragged_while_time_stands(player: Person) -> None:
    player.drag(player.on_screen((0, 5)), player.on_screen((3, 2)))

    assert ball(player) == pytest.approx((3, 2), abs=0.05)
    assert player.color_at(beside(player)) == RED
    assert player.session.world.disturbed


def test_the_energy_is_that_of_where_a_body_was_put(player: Person) -> None:
    def panel() -> bytes:
        side = player.window.surface.subsurface(player.window.panels.layout.side)
        return pygame.image.tobytes(side, "RGB")

    player.drag(player.on_screen((0, 5)), player.on_screen((0, 4)))
    player.wait()
    higher = panel()
    player.drag(player.on_screen((0, 4)), player.on_screen((0, 2)))
    player.wait()

    assert panel() != higher


def test_a_body_is_dragged_while_time_runs(player: Person) -> None:
    player.press(pygame.K_SPACE, " ")

    player.drag(player.on_screen((0, 5)), player.on_screen((2, 5)), let_go=False)
    player.wait(0.3)
    assert ball(player) == pytest.approx((2, 5), abs=0.5)
    player.button(False, player.on_screen((2, 5)))
    player.wait(0.3)

    assert ball(player)[1] < 4.8


def test_a_click_on_a_body_disturbs_nothing(player: Person) -> None:
    player.press(pygame.K_SPACE, " ")
    player.click(player.on_screen((0, 5)))

    assert not player.session.world.disturbed


@pytest.mark.parametrize("which", [1, 2, 3])
def test_the_view_is_moved_by_dragging_the_stage(player: Person, which: int) -> None:
    x, y = player.on_screen((4, 0))

    player.drag((x, y), (x + 40, y + 20), which)

    assert player.on_screen((4, 0)) == pytest.approx((x + 40, y + 20), abs=1)
    player.press(pygame.K_f, "f")
    assert player.on_screen((4, 0)) == pytest.approx((x, y))


def test_the_wheel_zooms_about_the_mouse(player: Person) -> None:
    before = player.window.stage.camera.scale
    place = player.on_screen((2, 1))
    player.move(place)

    pygame.event.post(pygame.Event(pygame.MOUSEWHEEL, x=0, y=1, precise_x=0.0, precise_y=1.0))
    player.wait()

    assert player.window.stage.camera.scale > before
    assert player.on_screen((2, 1)) == pytest.approx(place, abs=1)


def test_the_tape_measures_in_metres(player: Person, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pygame.key, "get_mods", lambda: pygame.KMOD_LSHIFT)

    player.drag(player.on_screen((-3, 0)), player.on_screen((1, 3)))

    assert player.window.hand.tape is not None
    assert player.window.hand.tape.text.startswith(("5.0", "4.9"))


@pytest.mark.parametrize("size", [(1024, 640), (1280, 800), (2560, 1440)])
def test_a_window_of_another_size_is_filled_without_overlap(
    player: Person, size: tuple[int, int]
) -> None:
    player.resize(size)
    player.wait(0.1)

    parts = player.window.panels.layout
    rects = [parts.levels, parts.stage, parts.side, parts.controls]
    assert sum(rect.width * rect.height for rect in rects) == size[0] * size[1]
    assert all(len(rect.collidelistall(rects)) == 1 for rect in rects)
    assert parts.stage.width >= size[0] * 0.45
    assert player.color_at(beside(player)) == RED


def test_a_tiny_window_is_no_trouble(player: Person) -> None:
    player.resize((120, 90))
    player.wait(0.1)

    assert player.window.open


def test_the_buttons_of_a_small_window_do_not_overlap(player: Person) -> None:
    player.resize((1024, 640))
    controls = player.window.panels.controls

    rects = [controls.button(name).rect for name in ("play", "step", "restart", "slower", "faster")]
    rects += [controls.button(name).rect for name in ("arrows", "trail", "ghosts", "fit", "help")]

    assert all(len(rect.collidelistall(rects)) == 1 for rect in rects)
    assert all(rect.right <= 1024 and rect.bottom <= 640 for rect in rects)


def test_in_the_smallest_window_the_clock_can_be_read(player: Person) -> None:
    """The buttons for the speed make room for it."""
    player.resize((480, 300))
    player.wait(0.1)
    controls = player.window.panels.controls

    assert isinstance(controls, PlayBar)
    assert controls._clock.width > 100
    assert controls._clock.right < controls.button("help").rect.left


def test_with_large_letters_the_time_has_room_beside_the_buttons(player: Person) -> None:
    """In German at 150 % it was cut off after a digit, beside a time bar of 40 px."""
    player.window.comfort.choose(language="de", size=150)
    player.resize((900, 600))
    player.wait(0.1)
    controls = player.window.panels.controls

    assert isinstance(controls, PlayBar)
    assert controls._clock.width > player.window.pen.write("t = 10.00 s", 15, bold=True).width
    rects = [controls.button(name).rect for name in ("play", "restart", "slower", "faster", "help")]
    assert all(len(rect.collidelistall([*rects, controls._clock])) == 1 for rect in rects)


@pytest.mark.parametrize("language", ["en", "de"])
def test_in_a_narrow_window_the_time_can_be_scrubbed_and_home_be_reached(
    player: Person, language: Name
) -> None:
    """In German at 900 x 600 the bar was 50 px long, beside a stage of 370 px."""
    player.window.comfort.choose(language=language)
    player.resize((900, 600))
    player.wait(0.1)
    controls = player.window.panels.controls

    assert isinstance(controls, PlayBar)
    assert controls._clock.width >= 180
    assert player.window.panels.layout.stage.width >= 460
    player.click(controls.button("home").rect)
    assert player.window.panels.home.open
    assert player.window.panels.list is not None


def test_a_search_in_a_narrow_window_goes_to_the_cards(player: Person) -> None:
    player.resize((900, 600))

    player.press(pygame.K_SLASH, "/")
    player.type("cradle")

    assert player.window.panels.home.open
    assert player.window.panels.search_text == "cradle"


def test_in_a_narrow_window_the_columns_make_way_for_the_stage(player: Person) -> None:
    player.resize((640, 480))
    parts = player.window.panels.layout

    assert (parts.levels.width, parts.side.width, parts.stage.width) == (0, 0, 640)
    assert parts.controls.bottom == 480


def test_a_complaint_goes_when_it_is_mended(player: Person) -> None:
    player.press(pygame.K_TAB)
    player.type("99")
    player.press(pygame.K_RETURN, "\r")
    player.wait()
    assert player.side.parameters.refusal
    player.type("12")
    player.press(pygame.K_RETURN, "\r")
    player.wait()

    assert player.session.values["g"] == 12
    assert not player.side.parameters.refusal


def test_columns_are_hidden_to_make_room_for_the_stage(player: Person) -> None:
    player.press(pygame.K_l, "l")
    player.press(pygame.K_p, "p")

    assert player.window.panels.layout.stage.width == 1280
    player.wait()
    player.press(pygame.K_l, "l")
    assert player.window.panels.list is not None


def test_the_help_lists_every_key_until_it_is_closed(player: Person) -> None:
    before = player.window.surface.copy()
    player.press(pygame.K_F1)
    shown = player.window.surface.copy()

    player.press(pygame.K_ESCAPE)

    middle = player.window.panels.layout.stage.center
    assert shown.get_at((middle[0] - 150, middle[1])) != before.get_at((middle[0] - 150, middle[1]))
    assert player.window.open


@pytest.mark.parametrize(("key", "letter"), [(pygame.K_SLASH, "/"), (pygame.K_l, "l")])
def test_a_list_for_which_there_is_no_room_is_there_when_there_is(
    player: Person, key: int, letter: str
) -> None:
    player.resize((760, 560))
    before = player.window.surface.copy()

    player.press(key, letter)

    told = pygame.Rect(60, 14, 400, 40)
    after = player.window.surface
    assert before.subsurface(told).get_buffer().raw != after.subsurface(told).get_buffer().raw
    player.resize((1280, 800))
    assert player.window.panels.list is not None


@pytest.mark.parametrize("size", [(1600, 1000), (1280, 800), (900, 600), (700, 500), (480, 320)])
def test_the_help_stands_whole_in_a_window_of_any_size(pen: Pen, size: tuple[int, int]) -> None:
    surface = pygame.Surface(size)

    stage_messages.draw_help(
        surface,
        pen,
        divide(size, levels=True, side=True).stage,
        stage_messages.window_keys_and_mouse(),
    )

    drawn = np.argwhere(pygame.surfarray.array3d(surface).any(axis=2))
    (left, top), (right, bottom) = drawn.min(axis=0), drawn.max(axis=0)
    x, y = (left + right) // 2, (top + bottom) // 2
    rim = [surface.get_at(place) for place in ((left, y), (right, y), (x, top), (x, bottom))]
    assert all(color.b > 2 * theme.PANEL[2] for color in rim)


def test_in_a_small_window_with_large_text_the_help_stands_on_sheets_that_can_be_read(
    player: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    player.resize((900, 600))
    player.window.comfort.choose(size=150)
    player.wait()
    shown: list[str] = []
    table = stage_messages._table

    def noted(pen: Pen, rows: Sequence[tuple[str, str]], *rest: int) -> pygame.Surface:
        shown.extend(text for _, text in rows)
        return table(pen, rows, *rest)

    monkeypatch.setattr(stage_messages, "_table", noted)
    sheets = 0
    player.press(pygame.K_h, "h")
    while player.window.help:
        sheets += 1
        assert player.window.help == sheets
        player.press(pygame.K_h, "h")

    assert sheets == player.window.sheets > 1
    assert {text for _, text in stage_messages.window_keys_and_mouse()} <= set(shown)
    player.press(pygame.K_F1)
    player.press(pygame.K_ESCAPE)
    assert not player.window.help


def test_a_level_with_mistakes_is_told_whole_and_the_app_stays_usable(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, scenes.falling(effects={"gravty": {"acceleration": [0, "-g"]}}))

    assert person.window.session is None
    assert person.window.panels.refusal is not None
    assert "gravty" in person.window.panels.refusal.text
    assert "gravity" in person.window.panels.refusal.text
    person.press(pygame.K_SPACE, " ")
    (tmp_path / "level.json").write_text(scenes.falling(), encoding="utf-8")
    person.press(pygame.K_F5)
    assert person.session.level.title == "A falling ball"
    assert person.window.panels.refusal is None


def test_the_list_says_what_an_edited_level_is_called_now(person: Person, tmp_path: Path) -> None:
    path = tmp_path / "level.json"
    person.open(tmp_path, scenes.falling())
    path.write_text(scenes.falling(title="A stone"), encoding="utf-8")

    person.press(pygame.K_F5)

    assert person.window.panels.list is not None
    assert person.window.panels.list.button(path.resolve()).text == "A stone"
    assert pygame.display.get_caption()[0] == "A stone – Mechanics sandbox"
    path.unlink()
    person.press(pygame.K_F5)
    assert pygame.display.get_caption()[0] == "Mechanics sandbox"


def test_a_level_that_does_not_exist_is_told_and_another_can_be_chosen(person: Person) -> None:
    person.window.open_level("kinematics/free-fal")
    person.wait()

    assert person.window.panels.refusal is not None
    assert "free-fall" in person.window.panels.refusal.text
    person.press(pygame.K_DOWN)
    assert person.window.session is not None


def test_a_setting_out_of_range_is_told(person: Person) -> None:
    person.window.open_level("kinematics/free-fall", {"no such": 1.0})

    assert person.window.session is None
    assert person.window.panels.refusal is not None


def test_a_level_is_opened_by_dropping_its_file(person: Person, tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    path.write_text(scenes.falling(), encoding="utf-8")

    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
    person.wait()

    assert person.session.level.title == "A falling ball"


def test_a_run_is_played_again_by_dropping_its_file(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, scenes.falling())
    session, body = person.session, "ball"
    x, y = map(float, session.world.snapshot.position[list(session.world.scene.bodies).index(body)])
    for step in range(20):
        if step == 2:
            session.grab(body, (x, y))
            session.drag((x + 0.5, y))
        if step == 12:
            session.release()
        session.step()
    saved = run_file.run_of(person.session)
    path = tmp_path / f"mine{run_file.SUFFIX}"
    run_file.save(saved, path)
    person.window.open_level("kinematics/free-fall")

    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
    person.wait()
    assert person.window.session is not None, person.window.panels.refusal
    assert person.session.playing
    while person.session.world.steps < saved.steps:
        person.session.step()

    assert run_file.is_same(saved, person.session)
    assert person.window.path is None
    assert person.window.banner.is_showing(f"{path.name} plays again, with all of your actions")
    assert person.session.actions


def test_the_window_does_not_stand_still_while_a_run_looks_for_its_setting(
    person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file requests an accuracy; the search for it runs beside the frames."""
    level = load(level_catalog.find("kinematics/projectile"))
    asking = level.model_copy(update={"stepping": Stepping(accuracy=1e-6)})
    stated = asking.model_dump(mode="json", by_alias=True, exclude_defaults=True)
    saved = run_file.run_of(Session(level)).model_copy(update={"level": stated})
    path = tmp_path / f"mine{run_file.SUFFIX}"
    run_file.save(saved, path)
    monkeypatch.setattr(
        "sandbox.physics.accuracy.calibration_cache.calibrated", lambda *_: pytest.fail("waits")
    )

    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
    person.wait()

    assert person.session.level.stepping.accuracy == 1e-6


def test_a_file_of_a_run_that_is_none_says_so(person: Person, tmp_path: Path) -> None:
    path = tmp_path / f"mine{run_file.SUFFIX}"
    path.write_text("{}", encoding="utf-8")

    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
    person.wait()

    assert person.window.session is None
    assert person.window.panels.refusal is not None
    assert "is not the file of a run" in person.window.panels.refusal.text


def test_a_run_that_had_to_stop_says_why_and_restarts(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, scenes.runaway())
    person.press(pygame.K_SPACE, " ")
    person.wait(3)

    assert person.session.failure is not None
    stage = person.window.panels.layout.stage
    column = [person.color_at((x, 40)) for x in range(stage.left, stage.right)]
    assert theme.FAILED in column
    person.press(pygame.K_r, "r")
    assert person.session.failure is None


def test_the_end_of_a_run_is_announced(player: Person) -> None:
    player.press(pygame.K_SPACE, " ")
    player.wait(1.2)

    stage = player.window.panels.layout.stage
    row = [player.color_at((x, 36)) for x in range(stage.left, stage.right)]
    assert theme.ACCENT in row


def test_the_sound_system_is_never_started(player: Person) -> None:
    assert pygame.mixer.get_init() is None
    assert player.window.open


def test_what_was_there_before_the_first_frame_is_not_looked_through_in_one(
    player: Person,
) -> None:
    """The garbage collector took 24 ms of a frame; for newer objects it takes 4."""
    player.window.open = False
    try:
        player.window.run()
        kept, all_there = gc.get_freeze_count(), len(gc.get_objects())
    finally:
        gc.unfreeze()

    assert kept > 10 * all_there


@pytest.mark.sweep
def test_frozen_widgets_are_given_up_when_all_are_made_anew(player: Person) -> None:
    """Otherwise a window kept 23 MB more from its first change of theme on."""
    pictures = player.window.pictures()
    try:
        next(pictures), next(pictures)  # frozen after the first
        old = ref(player.window.panels.manager)
        player.window.comfort.choose(theme="light")
        for _ in range(3):
            next(pictures)

        assert old() is None
    finally:
        gc.unfreeze()
