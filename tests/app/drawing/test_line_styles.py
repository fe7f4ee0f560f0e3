"""Whatever a colour tells apart, a shape tells apart, too."""

from itertools import combinations

import pygame
import pytest

from sandbox.app.drawing import energy_graph, line_styles, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.graph.chosen_quantities import Choice
from sandbox.app.pages.scheme_race import scheme_comparison
from sandbox.app.stage import run_legend
from tests.app.person import Person
from tests.app.scenes import falling

SIZE = (40, 16)


def drawn(which: int) -> bytes:
    """Return the shape of a marker."""
    surface = pygame.Surface((16, 16))
    line_styles.marker(surface, which, (255, 255, 255), (8, 8))
    return pygame.image.tobytes(surface, "RGB")


def test_no_two_signs_look_alike() -> None:
    forms = [drawn(which) for which in range(line_styles.SIGNS)]

    assert all(a != b for a, b in combinations(forms, 2))
    assert drawn(line_styles.SIGNS) == forms[0]


def test_the_lanes_are_dashed_each_in_a_way_of_its_own(pen: Pen) -> None:
    assert len(set(line_styles.DASHES)) == len(theme.LANES) == len(line_styles.DASHES)
    rows = []
    for lane in range(len(theme.LANES)):
        surface = pygame.Surface((300, 300))
        told = [(None, "this")] + [(theme.STAGE, "that")] * lane + [(theme.TEXT, "that")]
        run_legend.draw(surface, pen, told)
        y = run_legend.CORNER[1] + run_legend.PADDING
        height = pen.write("this", 14).height + 2
        line = y + (lane + 1) * height + height // 2
        rows.append(tuple(surface.get_at((x, line))[:3] == theme.TEXT for x in range(50, 80)))

    assert len(set(rows)) == len(rows)


def test_the_energies_are_told_apart_without_their_colours() -> None:
    samples = []
    for series in range(3):
        image = energy_graph.sample(series, SIZE)
        samples.append(bytes(image.get_at((x, y))[3] for x in range(SIZE[0]) for y in range(16)))

    assert len(set(samples)) == 3


@pytest.mark.parametrize("several", [False, True])
def test_several_curves_have_signs_and_one_alone_has_none(
    person: Person, tmp_path: object, several: bool
) -> None:
    person.open(tmp_path, falling())  # type: ignore[arg-type]
    names = ("ball.position.y", "ball.velocity.y")[: 1 + several]
    person.window.workers.of(Choice).choose(person.session, names)
    for _ in range(40):
        person.session.step()
    person.window.do("graph page")
    person.wait(0.2)
    side = person.side
    place = side.page._graphs.rect  # type: ignore[attr-defined]
    beside = pygame.Rect(place.x, place.y, person.window.pen.px(13), 14)
    row = [person.color_at((x, beside.y + 10)) for x in range(beside.x + 3, beside.x + 9)]

    assert (row.count(theme.BODIES[0]) >= 4) is several


def test_racing_runs_are_dashed_otherwise_on_the_stage(person: Person, tmp_path: object) -> None:
    person.open(tmp_path, falling())  # type: ignore[arg-type]
    scheme_comparison.toggle(person.session)
    lanes = [companion.variant.lane for companion in person.session.companions]

    assert len({line_styles.dash(lane) for lane in lanes}) == len(lanes) >= 2
