"""Experiments in the window: the curve shows its runs, and a click plays one of them."""

import csv
import json
from collections.abc import Iterator
from math import radians, sin
from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.files import save_folder
from sandbox.app.pages.experiment import card
from sandbox.app.pages.experiment.background_parameter_sweep import (
    COUNT,
    Point,
    SamplingRefusal,
    coarse_first,
    count_values,
    sample,
)
from sandbox.app.pages.experiment.card import curve, nearest, span_of
from sandbox.app.pages.experiment.panel import ExperimentPage
from sandbox.app.pages.experiment.parameter_curve import CurveWorker
from sandbox.app.pages.graph.chosen_quantities import offered
from sandbox.app.words.language import say
from sandbox.experiments import suggested_measures
from sandbox.experiments.measures import parse
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.physics.run import simulate
from tests.app.person import Person, until

APEX = "ball.position.y@apex(ball)"


def exploring(person: Person) -> CurveWorker:
    return person.window.workers.of(CurveWorker)


@pytest.fixture
def thrower(person: Person) -> Iterator[Person]:
    """A person who looks at the effect of throwing a ball faster."""
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_y, "y")
    yield person
    person.window.close()


def test_gaps_halve_until_every_number_was_there_once() -> None:
    order = coarse_first(9)

    assert order == [0, 8, 4, 2, 6, 1, 3, 5, 7]
    assert sorted(coarse_first(COUNT)) == list(range(COUNT))


def test_a_point_is_what_a_run_of_its_own_measures() -> None:
    level = load(level_catalog.find("kinematics/projectile"))
    points = sample(level, level.defaults, "angle", "ball.position.x@end")

    point = next(points)

    assert isinstance(point, Point)
    assert point.at == level.parameters["angle"].min
    trace = simulate(level, {**level.defaults, "angle": point.at}, record=["ball.position.x"])
    assert point.measured == trace.columns["ball.position.x"][-1]


def test_a_measure_that_cannot_be_is_told() -> None:
    level = load(level_catalog.find("kinematics/projectile"))

    (refused,) = sample(level, level.defaults, "angle", "ball.positon.x@end")

    assert isinstance(refused, SamplingRefusal)
    assert "position" in refused.reason


@pytest.mark.sweep
@pytest.mark.parametrize("name", level_catalog.names())
def test_what_a_level_suggests_can_be_measured(name: str) -> None:
    level = load(level_catalog.find(name))

    for text in suggested_measures.measures(level, offered(level)[:3]):
        assert parse(text, level, until=False).quantities


@pytest.mark.sweep
def test_the_curve_grows_and_is_that_of_the_closed_form(thrower: Person) -> None:
    work = exploring(thrower)
    until(thrower, lambda: len(work.points) == COUNT)

    values = thrower.session.values
    for point in work.points:
        height = (point.at * sin(radians(values["angle"]))) ** 2 / (2 * values["g"])
        assert point.measured == pytest.approx(height, rel=1e-9)
        assert point.expected == pytest.approx(height, rel=1e-9)
    field = thrower.window.surface.subsurface(thrower.page(ExperimentPage).field)
    assert (pygame.surfarray.array3d(field) == theme.BODIES[0]).all(axis=2).sum() > 200


def test_a_click_runs_with_the_value_under_it_and_the_curve_stays(thrower: Person) -> None:
    work = exploring(thrower)
    until(thrower, lambda: len(work.points) == COUNT)
    points, field = list(work.points), thrower.page(ExperimentPage).field
    chosen = work.chosen(thrower.session)
    assert chosen is not None
    span = span_of(thrower.window.pen, field.width, thrower.session.level, chosen)
    pixel = field.x + float(span.pixels(np.array(12.0)))

    thrower.click((pixel, field.centery))

    point = nearest(points, 12.0)
    assert point is not None
    assert thrower.session.values["speed"] == point.at
    thrower.wait(1.0)
    assert work.points == points


def test_the_points_of_the_curve_are_saved_with_all_digits(
    thrower: Person, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(save_folder, "folder", lambda: tmp_path)
    page, work = thrower.page(ExperimentPage), exploring(thrower)
    assert page.save is not None
    thrower.click(page.save.rect)
    assert not list(tmp_path.iterdir())
    until(thrower, lambda: len(work.points) == COUNT)

    thrower.click(page.save.rect)

    (path,) = tmp_path.glob("*.csv")
    level, rest, *lines = path.read_text("utf-8").splitlines()
    assert level.startswith("# level: ")
    assert f"angle={thrower.session.values['angle']!r}" in rest
    rows = list(csv.DictReader(lines))
    assert [float(row["speed [m/s]"]) for row in rows] == [point.at for point in work.points]
    assert [float(row[APEX]) for row in rows] == [point.measured for point in work.points]


def test_another_value_of_what_is_not_varied_draws_the_curve_anew(thrower: Person) -> None:
    work = exploring(thrower)
    until(thrower, lambda: bool(work.points))
    first = work.points[0]

    thrower.session.restart({"g": 5.0})
    until(thrower, lambda: bool(work.points) and work.points[0] != first)

    assert work.points[0].measured == pytest.approx((first.measured or 0) * 9.81 / 5.0, rel=1e-2)


def test_another_parameter_is_chosen_from_its_list(thrower: Person) -> None:
    button = thrower.page(ExperimentPage).lists[0].item_list[1]["button_element"]
    assert button is not None

    thrower.click(button.rect)

    until(thrower, lambda: exploring(thrower).chosen(thrower.session) == ("angle", APEX))


def test_a_level_without_parameters_says_that_nothing_can_be_varied(person: Person) -> None:
    files = [level_catalog.root() / f"{name}.json" for name in level_catalog.names()]
    bare = next(path for path in files if not json.loads(path.read_bytes()).get("parameters"))
    person.window.open_level(str(bare))

    person.press(pygame.K_y, "y")
    person.wait(1.0)

    assert not exploring(person).running
    assert person.page(ExperimentPage).lists == []
    assert (
        person.page(ExperimentPage).process(pygame.Event(pygame.MOUSEMOTION, pos=(1100, 200)))
        is None
    )


def test_nothing_is_run_where_nobody_looks(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.wait(1.0)

    assert not exploring(person).running


def test_parameters_and_measures_are_offered_by_their_labels(person: Person) -> None:
    """They were names and formulas: m, and t@crossing(ball.position.y, 0, up)."""
    person.window.open_level("newton/magnetic-field")
    person.press(pygame.K_y, "y")
    vary, measure = person.page(ExperimentPage).lists

    assert [each["text"] for each in vary.item_list[:2]] == ["m, mass", "q, charge"]
    assert measure.item_list[0]["text"] == "period"
    assert measure.get_single_selection() == "period"
    assert exploring(person).chosen(person.session) == (
        "m",
        "t@crossing(ball.position.y, 0, up)",
    )


def test_a_number_of_balls_is_varied_in_whole_numbers() -> None:
    """It was sampled at 65 values from 1 to 4, of which 62 repeat the one below."""
    level = load(level_catalog.find("momentum/cradle"))

    points = [*sample(level, level.defaults, "n", "ball1.speed@0")]

    assert [point.at for point in points if isinstance(point, Point)] == [1, 2, 3, 4]
    assert count_values(level, "n") == 4
    assert count_values(level, "angle") == COUNT


def test_the_curve_stays_in_place_while_the_mouse_moves_over_it(thrower: Person) -> None:
    """With large text the hint takes one line, and such a result takes two."""
    thrower.resize((900, 600))
    thrower.window.comfort.choose(size=150)
    thrower.wait()
    page, work = thrower.page(ExperimentPage), exploring(thrower)
    work.points = [Point(float(at), None, None, None) for at in range(5, 26)]
    page._show()
    before = page.field
    pen, room = page._sheet.pen, page._sheet.width
    result = card._result("speed", "m/s", work.points[10])
    assert len(pen.wrap(say(card.HINT), room, 12)) < len(pen.wrap(result, room, 12))

    thrower.move(before.center)

    assert page._mouse is not None
    assert page.field == before


def test_a_result_that_is_constant_to_rounding_is_drawn_level(thrower: Person) -> None:
    """It was scaled to its rounding: the energy of a cradle's ball, 1.31 J to 4e-9 J."""
    page, work = thrower.page(ExperimentPage), exploring(thrower)
    work.points = [Point(float(at), 1.3 + 4e-9 * (at % 2), None, None) for at in range(5, 26)]

    drawn, field = curve(page._sheet.pen, page._sheet.width, thrower.session, work, None)

    inside = drawn.subsurface(field.inflate(-120, 0))
    lit = (pygame.surfarray.array3d(inside) == theme.BODIES[0]).all(axis=2).any(axis=0)
    rows = np.flatnonzero(lit)
    assert rows[-1] - rows[0] < 10
