"""The energies over time, as lines checked pixel by pixel."""

import numpy as np
import pygame
import pytest
from numpy.typing import NDArray

from sandbox.app.drawing import energy_graph, theme
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.energy_history_and_balance import INSTANTS
from sandbox.app.panels.verdicts_and_energies import HIGH, check_summary
from sandbox.app.runs.session import Session
from sandbox.app.words import language
from sandbox.model import level_catalog
from sandbox.model.expressions import Array
from sandbox.model.loading import load
from tests.app import scenes
from tests.app.person import Person
from tests.app.scenes import play

SIZE = (200, 80)


def oscillator(scheme: str) -> Session:
    """Return a ball on a spring, 1 kg and 1 N/m, for two periods at 20 steps a second."""
    ball = {"shape": {"type": "disc", "radius": 0.3}, "mass": 1, "position": [2, 0]}
    coil = {"type": "spring", "ends": [[-5, 0], "ball"], "stiffness": 1, "length": 5}
    return Session(
        scenes.level(
            parameters={}, effects={}, bodies={"ball": ball}, joints={"coil": coil},
            stepping={"rate": 20, "scheme": scheme}, duration="4*pi", checks=[], ghosts={},
        )
    )  # fmt: skip


def drawn(session: Session) -> Array:
    surface = energy_graph.energies(SIZE, session.books.history, session.duration)
    return pygame.surfarray.array3d(surface).astype(float)


def rows(pixels: Array, color: Color, columns: slice) -> NDArray[np.intp]:
    """Return the rows in which some columns have a colour."""
    return np.nonzero((np.abs(pixels[columns] - color).max(axis=2) < 40).any(axis=0))[0]


def test_the_history_is_that_of_the_run() -> None:
    session = play(Session(load(level_catalog.find("kinematics/projectile"))))
    t, kinetic, potential, total = session.books.history.T

    height = 25 * np.sin(np.pi / 4) * t - 9.81 * t**2 / 2
    assert t[0] == 0
    assert t[-1] == session.t
    assert potential == pytest.approx(9.81 * height, abs=1e-9)
    assert kinetic + potential == pytest.approx(total, rel=1e-12)


def test_the_growth_of_energy_under_eulers_explicit_scheme_is_seen() -> None:
    """It grows by 1 + (ω dt)² a step, 1.87 over these 252; the symplectic one keeps it."""
    grown, kept = (drawn(play(oscillator(s))) for s in ("explicit-euler", "leapfrog"))
    first, last = slice(2, 8), slice(-12, -6)

    assert rows(kept, theme.TOTAL, first).max() - rows(kept, theme.TOTAL, last).min() <= 3
    assert rows(grown, theme.TOTAL, first).min() - rows(grown, theme.TOTAL, last).max() > 20


def test_kinetic_and_potential_energy_change_places() -> None:
    pixels = drawn(play(oscillator("leapfrog")))
    start, quarter = slice(0, 4), slice(24, 27)  # of a period, which is 100 pixels

    assert rows(pixels, theme.KINETIC, start).min() > 60
    assert not (rows(pixels, theme.POTENTIAL, start) > 20).any()
    assert rows(pixels, theme.POTENTIAL, quarter).min() > 60
    assert not (rows(pixels, theme.KINETIC, quarter) > 20).any()


def test_a_run_just_begun_leaves_the_rest_of_the_graph_free() -> None:
    session = oscillator("leapfrog")
    session.step()
    pixels = drawn(session)

    assert len(rows(pixels, theme.TOTAL, slice(0, 6)))
    assert not len(rows(pixels, theme.TOTAL, slice(12, 200)))


def test_a_long_run_keeps_a_bounded_number_of_energies() -> None:
    session = Session(scenes.level(stepping={"rate": 6000}, checks=[]))
    play(session)

    assert len(session.books.history) <= INSTANTS + 2


def test_nothing_but_zeros_is_no_trouble() -> None:
    surface = energy_graph.energies(SIZE, np.zeros((1, 4)), 1.0)

    assert surface.size == SIZE


def test_the_energies_of_a_body_that_was_put_elsewhere_begin_there() -> None:
    session = oscillator("leapfrog")
    session.grab("ball", (2, 0))
    session.drag((3, 0))

    assert session.books.history[:, 3] == pytest.approx(4.5)


@pytest.mark.sweep
def test_graph_bars_and_sum_change_by_key_and_by_button(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_SPACE, " ")
    person.wait(3)

    def seen() -> int:
        """Count the pixels of the graph's ground."""
        side = person.window.surface.subsurface(person.window.panels.layout.side)
        return int((pygame.surfarray.array3d(side) == theme.STAGE).all(axis=2).sum())

    with_graph = seen()
    assert person.side.foot is not None
    person.click(person.side.foot.switch.rect)
    with_bars = seen()
    person.press(pygame.K_e, "e")
    folded = person.side.foot
    assert folded is not None
    top = folded.top
    person.press(pygame.K_e, "e")

    assert person.side.foot is not None
    assert top > person.side.foot.top + HIGH[0]
    assert with_graph > with_bars + 200 * 50
    assert seen() == pytest.approx(with_graph, rel=0.05)


@pytest.mark.parametrize("size", [(1024, 640), (1280, 800), (2560, 1440)])
def test_the_graph_is_in_sight_without_scrolling(person: Person, size: tuple[int, int]) -> None:
    person.window.open_level("kinematics/projectile")
    person.resize(size)
    person.wait(0.1)

    side = person.window.panels.layout.side
    column = [person.color_at((side.x + 40, y)) for y in range(side.bottom)]
    assert column.count(theme.STAGE) >= 50


@pytest.mark.parametrize("spoken", language.NAMES)
def test_the_foot_has_room_for_what_it_says_of_a_run_that_a_hand_has_touched(
    person: Person, spoken: language.Name
) -> None:
    person.window.comfort.choose(language=spoken)
    person.window.open_level("momentum/cradle")
    person.session.grab("ball2", (0.2, 0.0))
    person.session.drag((-0.2, 0.2))
    person.session.release()
    person.wait(0.2)

    foot = person.side.foot
    assert foot is not None
    assert foot.verdicts is not None
    assert foot.verdicts.text == check_summary(person.session)
    assert person.window.pen.write(foot.verdicts.text, 13).width < foot.verdicts.rect.width - 8
