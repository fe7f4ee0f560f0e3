"""Graphs show the measured values, at the right place."""

from pathlib import Path
from typing import Any

import numpy as np
import pygame
import pytest
from pygame_gui.elements import UIButton

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.files import save_folder
from sandbox.app.observing.thinned_history import ThinnedHistory
from sandbox.app.observing.thinned_series import CAPACITY
from sandbox.app.pages.accuracy.background_study import BackgroundStudy
from sandbox.app.pages.graph.card import graphs, measured, span_of
from sandbox.app.pages.graph.chosen_quantities import Choice, offered
from sandbox.app.pages.graph.panel import GraphPage
from sandbox.app.pages.graph.zoom import NOTCH, Zoom
from sandbox.app.widgets import plot
from sandbox.app.widgets.plot import Scale, Series
from sandbox.app.words import formatting
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.physics.accuracy.trusted_digits import Trust
from tests.app.person import Person, until
from tests.app.scenes import opened


def test_a_history_gives_back_every_state_it_has_noted() -> None:
    session = opened("newton/atwood", 30)

    states = session.history.snapshots

    assert len(session.history) == 31
    assert states.t[-1] == session.world.snapshot.t
    np.testing.assert_array_equal(states.position[-1], session.world.snapshot.position)
    np.testing.assert_array_equal(states.tension[-1], session.world.snapshot.tension)


def test_a_history_is_bounded_and_then_has_every_second_state() -> None:
    world = opened("kinematics/free-fall", 0).world
    history = ThinnedHistory(world.snapshot)
    for _ in range(2 * CAPACITY):
        history.note(world.snapshot)

    assert len(history) <= CAPACITY


def test_what_is_drawn_is_what_the_closed_form_says() -> None:
    session = opened("kinematics/projectile", 60)

    columns, units = measured(session.world, session.history, ["t", "ball.position.y"])

    rise = 25 * np.sin(np.pi / 4)
    expected = rise * columns["t"] - 9.81 * columns["t"] ** 2 / 2
    np.testing.assert_allclose(columns["ball.position.y"], expected, atol=1e-12)
    assert units == {"t": "s", "ball.position.y": "m"}


def test_every_quantity_that_is_offered_can_be_drawn() -> None:
    for name in ("newton/atwood", "momentum/cradle", "rotation/motor", "lagrange/bead-on-a-wire"):
        session = opened(name, 5)
        names = offered(session.level)
        columns, _ = measured(session.world, session.history, names)
        assert all(columns[each].shape == (6,) for each in names)


def test_a_line_goes_through_its_points(pen: Pen) -> None:
    span = plot.horizontal_scale(pen, 300, [np.array([0.0, 1.0])])
    y = np.array([0.0, 1.0])
    drawn = plot.draw(pen, (300, 150), [Series((255, 0, 0), y, y)], span, cursor=None)

    pixels = pygame.surfarray.array3d(drawn)
    red = np.argwhere((pixels[..., 0] > 100) & (pixels[..., 1] < 60))
    assert red[:, 0].min() <= plot.LEFT + 1
    assert red[:, 0].max() >= 300 - plot.RIGHT - 1
    corner = red[red[:, 0].argmin()], red[red[:, 0].argmax()]
    assert corner[0][1] > corner[1][1]  # it rises


@pytest.mark.parametrize(("low", "high"), [(0, 1), (-3e-9, 7e-9), (1e9, 5e9), (-1, -0.999)])
def test_ticks_are_round_few_and_inside(low: float, high: float) -> None:
    ticks = list(Scale(low, high, 0, 100).ticks(4))

    assert 1 <= len(ticks) <= 6
    assert all(low <= tick <= high for tick in ticks)


def test_what_hardly_changes_is_drawn_beyond_an_offset_and_rounding_is_a_straight_line() -> None:
    noise = plot.scale([np.array([5.0, 5.0 + 1e-14])], 0, 1, 0.06)
    assert noise.high - noise.low > 1
    at_rest = plot.scale([np.array([-3e-14, 4e-14])], 0, 1, 0.06)
    assert at_rest.high - at_rest.low > 1

    nothing = plot.scale([np.array([np.nan, np.inf])], 0, 1, 0.06)
    assert np.isfinite([nothing.low, nothing.high]).all()


def row(page: GraphPage, name: str) -> UIButton:
    """Return the row of a quantity in the list of those that can be drawn."""
    assert page.up.item_list_container is not None
    rows = [each for each in page.up.item_list_container.elements if isinstance(each, UIButton)]
    return next(each for each in rows if each.text == name)


@pytest.mark.sweep
def test_quantities_are_chosen_from_lists_and_stay_chosen(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_d, "d")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.3)
    choice = person.window.workers.of(Choice)
    assert choice.up(person.session) == ("ball.position.x",)

    person.click(row(person.page(GraphPage), "ball.position.y").rect)
    person.wait(0.1)  # the list tells it two frames after its button
    assert choice.up(person.session) == ("ball.position.x", "ball.position.y")

    person.press(pygame.K_o, "o")
    person.press(pygame.K_d, "d")
    assert set(person.page(GraphPage).up.get_multi_selection()) == {
        "ball.position.x",
        "ball.position.y",
    }


def test_some_letters_find_a_quantity_and_what_was_chosen_before_stays(person: Person) -> None:
    person.window.open_level("momentum/cradle")
    person.press(pygame.K_d, "d")
    choice = person.window.workers.of(Choice)
    before = choice.up(person.session)

    person.click(person.page(GraphPage).sought.rect)
    person.type("ball3.energy")
    person.wait(0.1)
    assert [each["text"] for each in person.page(GraphPage).up.item_list] == ["ball3.energy"]
    person.click(row(person.page(GraphPage), "ball3.energy").rect)
    person.wait(0.1)

    assert choice.up(person.session) == (*before, "ball3.energy")


def test_what_never_moves_comes_last() -> None:
    names = offered(load(level_catalog.find("momentum/cradle")))

    assert names[0].startswith("ball1.")
    assert names[-1].startswith("beam.")


def test_how_far_a_quantity_can_be_trusted_stands_above_its_graph(pen: Pen) -> None:
    session, name = opened("kinematics/projectile", 30), "ball.position.y"
    told = Trust(name, size=8.0, off=1e-4, until=1.25, order=2.0)

    without, _ = graphs(pen, 278, session, [name], "t", None)
    known, _ = graphs(pen, 278, session, [name], "t", None, {name: told})

    assert known.height - without.height == 2 * pen.height(12)
    assert formatting.trusted(told) == "4 digits hold; predictable until t = 1.25 s"
    assert formatting.next_digit(told) == "the next digit takes 3.2 times the computing"


def test_no_price_is_told_of_a_digit_that_a_smaller_step_does_not_give() -> None:
    stuck = Trust("x", size=1.0, off=1e-3, until=None)

    assert formatting.next_digit(stuck) == "a smaller step does not give the next digit"
    assert formatting.next_digit(Trust("x", size=1.0, off=1e-16, until=None)) == ""


def test_an_open_graph_has_its_digits_found_out(person: Person) -> None:
    """They were known only once the page Accuracy had been open."""
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_d, "d")

    until(person, lambda: bool(person.window.workers.of(BackgroundStudy).trust(person.session)))

    assert not person.window.workers.of(BackgroundStudy).points


def test_a_quantity_that_is_all_error_has_no_digits() -> None:
    assert formatting.trusted(Trust("x", size=1.0, off=2.0, until=None)) == "no digit holds"
    assert formatting.trusted(Trust("x", size=1.0, off=0.3, until=None)) == "1 digit holds"


def test_a_quantity_is_drawn_against_another(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_d, "d")
    choice = person.window.workers.of(Choice)

    choice.choose(person.session, ("ball.position.y",))
    choice.against(person.session, "ball.position.x")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.5)

    assert choice.across(person.session) == "ball.position.x"
    graph = pygame.surfarray.array3d(person.page(GraphPage)._graphs.image)
    assert (graph == theme.BODIES[0]).all(axis=2).any()


@pytest.mark.parametrize(("size", "rows"), [(100, 6), (125, 2)])
def test_in_a_low_window_names_to_choose_from_are_in_view(
    person: Person, size: int, rows: int
) -> None:
    """At 900 x 600 the list began below the page; it was some rows below the buttons."""
    person.window.comfort.choose(size=size)
    person.resize((900, 600))
    person.window.open_level("momentum/cradle")
    person.press(pygame.K_d, "d")
    person.wait(0.1)

    page, seen = person.page(GraphPage), person.side._sheet.container.rect
    assert seen.bottom - page.up.rect.top >= rows * 20 * size / 100
    person.window.comfort.choose(size=100)
    person.resize((1280, 800))
    person.wait(0.1)
    assert person.page(GraphPage)._zooming.graphs[0].place.height == 150


def test_a_value_that_is_rounding_beside_the_others_is_written_as_zero(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The arm that has stopped had an angular acceleration of 7.6e-10 after -1400 °/s²."""
    session = opened("machines/trebuchet", 240)
    written: list[str] = []
    quantity = formatting.quantity

    def noted(*told: Any) -> str:  # noqa: ANN401
        written.append(quantity(*told))
        return written[-1]

    monkeypatch.setattr(formatting, "quantity", noted)
    graphs(pen, 280, session, ["arm.angular_acceleration"], "t", None)

    assert "0°/s²" in written


def test_the_mouse_over_a_graph_tells_the_values_there(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_d, "d")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.5)
    person.press(pygame.K_SPACE, " ")
    graph = person.page(GraphPage)._graphs.rect

    person.move((graph.centerx, graph.y + 60))

    assert person.page(GraphPage)._cursor == pytest.approx(person.session.t / 2, rel=0.2)
    person.move((600, 300))
    assert person.page(GraphPage)._cursor is None


def test_the_cursor_and_the_lines_have_one_scale_where_an_earlier_run_reaches_further(
    pen: Pen,
) -> None:
    session = opened("kinematics/projectile", 100)
    session.restart({"angle": 60})
    for _ in range(20):
        session.step()

    span = span_of(pen, 300, session, "t")

    assert span.high == pytest.approx(100 / 60, rel=1e-9)


def zoomed(person: Person) -> Zoom:
    return person.window.workers.of(Choice).zoom(person.session)


@pytest.fixture
def grapher(person: Person) -> Person:
    """A person who looks at the graph of a whole throw, from 0 to the level's duration."""
    person.window.open_level("kinematics/projectile")
    for _ in range(person.session.end):
        person.session.step()
    person.press(pygame.K_d, "d")
    return person


def on_graph(person: Person, t: float, rise: float = 0.5) -> tuple[int, int]:
    """Return where a time [s] is in the first graph, at a part of its height [px]."""
    graph, corner = (
        person.page(GraphPage)._zooming.graphs[0],
        person.page(GraphPage)._graphs.rect.topleft,
    )
    x = float(graph.across.pixels(np.array(t))) + graph.place.x + corner[0]
    y = graph.up.start + (graph.up.end - graph.up.start) * rise + graph.place.y + corner[1]
    return round(x), round(y)


def test_a_box_that_is_dragged_is_what_is_seen(grapher: Person) -> None:
    rises = grapher.page(GraphPage)._zooming.graphs[0].up
    low, high = (rises.low + share * (rises.high - rises.low) for share in (0.2, 0.8))

    grapher.drag(on_graph(grapher, 1.0, 0.2), on_graph(grapher, 2.0, 0.8))

    pixel = 0.03  # s, about
    assert zoomed(grapher).across == pytest.approx((1.0, 2.0), abs=pixel)
    assert zoomed(grapher).up["m"] == pytest.approx((low, high), rel=0.03)


def test_a_flat_box_leaves_the_height_as_it_is(grapher: Person) -> None:
    grapher.drag(on_graph(grapher, 1.0), on_graph(grapher, 2.0))

    assert zoomed(grapher).across == pytest.approx((1.0, 2.0), abs=0.03)
    assert zoomed(grapher).up == {}


def test_the_wheel_zooms_about_the_mouse_and_does_not_scroll_the_page(grapher: Person) -> None:
    grapher.move(on_graph(grapher, 1.0))
    before = grapher.page(GraphPage)._graphs.rect.y
    for _ in range(5):
        pygame.event.post(pygame.Event(pygame.MOUSEWHEEL, x=0, y=1, precise_x=0.0, precise_y=1.0))
        grapher.wait()

    across = zoomed(grapher).across
    assert across is not None
    low, high = across
    assert high - low == pytest.approx(grapher.session.t * NOTCH**5, rel=1e-6)
    assert (1.0 - low) / (high - low) == pytest.approx(1.0 / grapher.session.t, abs=0.02)
    assert grapher.page(GraphPage)._graphs.rect.y == before


def test_the_other_button_moves_what_is_seen(grapher: Person) -> None:
    grapher.drag(on_graph(grapher, 1.0), on_graph(grapher, 2.0))
    before = zoomed(grapher).across
    assert before is not None

    grapher.drag(on_graph(grapher, 1.75), on_graph(grapher, 1.25), which=3)

    assert zoomed(grapher).across == pytest.approx((before[0] + 0.5, before[1] + 0.5), abs=0.03)


def test_a_double_click_shows_all_again(grapher: Person, monkeypatch: pytest.MonkeyPatch) -> None:
    grapher.drag(on_graph(grapher, 1.0), on_graph(grapher, 2.0))
    pixel = on_graph(grapher, 1.5)
    monkeypatch.setattr(pygame.time, "get_ticks", lambda: 10_000)

    grapher.click(pixel)
    assert zoomed(grapher)
    grapher.click(pixel)

    assert not zoomed(grapher)


@pytest.mark.sweep
def test_a_click_on_a_graph_over_time_goes_there_and_what_comes_later_stays_fainter(
    grapher: Person,
) -> None:
    before, span = grapher.session.t, grapher.page(GraphPage)._zooming.graphs[0].across

    grapher.click(on_graph(grapher, 1.5))
    until(grapher, lambda: grapher.session.sought is None)
    grapher.wait(0.2)

    assert grapher.session.t == pytest.approx(1.5, abs=0.03)
    assert grapher.page(GraphPage)._zooming.graphs[0].across == span
    faint = theme.faded(theme.BODIES[0], 0.5)
    line = grapher.window.surface.subsurface(grapher.page(GraphPage)._graphs.rect)
    seen = {tuple(map(int, rgb)) for rgb in pygame.surfarray.array3d(line).reshape(-1, 3)}
    assert tuple(faint[:3]) in seen

    grapher.click(on_graph(grapher, before))
    until(grapher, lambda: grapher.session.sought is None)
    assert grapher.session.t == pytest.approx(before, abs=0.03)
    assert grapher.session.later is None


def test_a_click_on_a_graph_against_something_else_goes_nowhere(grapher: Person) -> None:
    grapher.window.workers.of(Choice).against(grapher.session, "ball.position.x")
    grapher.page(GraphPage).update()

    grapher.click(on_graph(grapher, 20.0))

    assert grapher.session.at_end


def test_home_shows_all_again_and_restarts_only_then(grapher: Person) -> None:
    grapher.drag(on_graph(grapher, 1.0), on_graph(grapher, 2.0))

    grapher.press(pygame.K_HOME)
    assert not zoomed(grapher)
    assert grapher.session.at_end
    grapher.press(pygame.K_HOME)
    assert grapher.session.world.steps == 0


def test_buttons_zoom_and_move_along_for_those_who_have_no_mouse(grapher: Person) -> None:
    whole = grapher.session.t

    def press(caption: str) -> None:
        panels = grapher.window.panels
        for _ in range(300):
            grapher.press(pygame.K_TAB)
            if panels.focus.element(panels.manager, panels.layout) is grapher.page(
                GraphPage
            ).button(caption):
                break
        grapher.press(pygame.K_RETURN, "\r")

    press("+")
    assert zoomed(grapher).across == pytest.approx((0.1 * whole, 0.9 * whole), rel=1e-9)
    press(">")
    assert zoomed(grapher).across == pytest.approx((0.3 * whole, 1.1 * whole), rel=1e-9)
    press("<")
    press("−")
    assert zoomed(grapher).across == pytest.approx((0.0, whole), abs=1e-9)
    press("All")
    assert not zoomed(grapher)


def test_of_a_zoomed_line_every_point_that_is_seen_is_drawn(pen: Pen) -> None:
    """Of 100,000 points a few hundred are drawn; zoomed in, a peak of a single point is seen."""
    x = np.linspace(0.0, 1.0, 100_001)
    y = np.where(np.arange(len(x)) == 50_001, 1.0, 0.0)
    series = [Series((255, 0, 0), x, y)]
    span = plot.horizontal_scale(pen, 300, [x])
    near = span._replace(low=0.4999, high=0.5001)

    far_off, close = (plot.draw(pen, (300, 150), series, each, None) for each in (span, near))

    def highest(drawn: pygame.Surface) -> int:
        pixels = pygame.surfarray.array3d(drawn)
        return int(np.argwhere((pixels[..., 0] > 100) & (pixels[..., 1] < 60))[:, 1].min())

    assert highest(close) <= plot.ABOVE + 12 < highest(far_off)


def test_what_lies_far_beyond_a_closely_seen_part_leaves_its_line_there(pen: Pen) -> None:
    x = np.array([0.0, 1.0])
    series = [Series((255, 0, 0), x, x), Series((0, 0, 255), x, 1 - x, dashed=True)]
    span = plot.horizontal_scale(pen, 300, [x])._replace(low=0.5 - 1e-7, high=0.5 + 1e-7)
    up = plot.vertical_scale(pen, 150, [x])._replace(low=0.5 - 1e-7, high=0.5 + 1e-7)

    pixels = pygame.surfarray.array3d(plot.draw(pen, (300, 150), series, span, None, up))

    for channel in (0, 2):
        drawn = np.argwhere(pixels[..., channel] > pixels[..., 1] + 60)
        assert drawn[:, 0].min() <= plot.LEFT + 12
        assert drawn[:, 0].max() >= 300 - plot.RIGHT - 12


def test_what_is_saved_is_what_is_seen(
    grapher: Person, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(save_folder, "folder", lambda: tmp_path / "files")
    grapher.drag(on_graph(grapher, 1.0), on_graph(grapher, 2.0))
    across = zoomed(grapher).across
    assert across is not None
    grapher.window.panels.scroll_pages(0.3)
    grapher.wait(0.1)

    grapher.click(grapher.page(GraphPage).button("Save CSV").rect)
    grapher.wait(0.1)
    (path,) = (tmp_path / "files").glob("*.csv")
    lines = [x for x in path.read_text(encoding="utf-8").splitlines() if not x.startswith("#")]
    times = [float(line.split(",")[0]) for line in lines[1:]]
    dt = grapher.session.world.dt
    assert times[0] == pytest.approx(across[0], abs=dt)
    assert times[-1] == pytest.approx(across[1], abs=dt)

    choice = grapher.window.workers.of(Choice)
    grapher.click(grapher.page(GraphPage).button("Save picture").rect)
    until(grapher, lambda: not choice.running)
    (png,) = (tmp_path / "files").glob("*.png")
    width, height = pygame.image.load(png).size
    assert (width, height) == (1050, 480)


@pytest.mark.parametrize(
    ("level", "quantity"),
    [
        ("lagrange/double-pendulum", "upper.speed"), ("energy/two-bodies", "light.position.x"),
        ("newton/atwood", "left.position.y"), ("momentum/cradle", "ball5.speed"),
    ],
)  # fmt: skip
def test_the_first_graph_is_of_something_that_changes(
    person: Person, level: str, quantity: str
) -> None:
    """The energy of a pendulum is a graph of rounding errors that looks like a motion."""
    person.window.open_level(level)

    assert person.window.workers.of(Choice).up(person.session) == (quantity,)
