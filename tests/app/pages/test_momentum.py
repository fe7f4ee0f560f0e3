"""The page of the momenta, and their arrows on the stage."""

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.momentum import card
from sandbox.app.pages.momentum.card import LABEL, MOST, bodies, explained_change, momentum
from sandbox.app.runs.session import Session
from sandbox.app.stage import momentum_scale
from sandbox.app.stage.frame_of_reference import CENTER
from sandbox.app.stage.level_labels import seen_from
from sandbox.app.stage.overlays.momenta import OVERLAY
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from tests.app import scenes
from tests.app.person import Person
from tests.app.scenes import play
from tests.app.writing import noted

WIDTH = 276
BAR = 10  # px, its height


def session_of(name: str) -> Session:
    session = Session(load(find(name)))
    session.book(True)
    return session


def of(session: Session) -> dict[str, list[float]]:
    return {each.name.strip(): each.value.tolist() for each in bodies(session.world)}


def since(session: Session) -> dict[str, np.ndarray]:
    return {each.name.strip(): each.value for each in explained_change(session)}


def pixels(picture: pygame.Surface, color: theme.Color) -> np.ndarray:
    """Return how many rows of each column to the right of the names have a colour."""
    where = (pygame.surfarray.array3d(picture)[LABEL + card.AXIS :] == color).all(axis=2)
    return where.sum(axis=1)


def test_seen_from_the_centre_of_mass_all_momenta_add_up_to_zero() -> None:
    world = scenes.opened("momentum/elastic-light-on-heavy", 40).world
    every = [each.value for each in bodies(world, CENTER)]

    assert np.sum([each.value for each in bodies(world)], axis=0)[0] > 0.5
    assert np.sum(every, axis=0) == pytest.approx([0, 0], abs=1e-12)
    assert every[0][0] > 0.1
    assert bodies(world, "first")[0].value == pytest.approx([0, 0])


def test_the_page_tells_who_observes_and_who_sees_the_impulses(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = session_of("momentum/elastic-light-on-heavy")
    session.looking.seen_from = CENTER
    written = noted(pen, monkeypatch)
    momentum(pen, WIDTH, session)

    assert written.index(seen_from(CENTER)) < written.index("Change")
    assert written.index("Change") < written.index(seen_from(None))


def test_of_equal_masses_one_hands_its_momentum_to_the_other() -> None:
    session = session_of("momentum/elastic-equal-masses")
    before = of(session)

    after = of(play(session))

    assert before == {"first": [3, 0], "second": [0, 0]}
    assert after["first"] == pytest.approx([0, 0], abs=1e-12)
    assert after["second"] == pytest.approx([3, 0], abs=1e-12)
    assert np.abs(since(session)["change of the total"]).max() < 1e-12


def test_a_momentum_that_is_rounding_is_told_as_nothing(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = session_of("momentum/recoil")
    for _ in range(60):
        session.step()
    written = noted(pen, monkeypatch)

    momentum(pen, 278, session)

    total = written.index("total")
    assert written[total + 2] == f"0 {momentum_scale.UNIT}"


def test_an_impulse_that_is_rounding_is_told_as_nothing(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A yo-yo falls straight down: along x there was 3e-17, of which 6e-33 was unexplained."""
    session = session_of("rotation/yo-yo")
    for _ in range(60):
        session.step()
    written = noted(pen, monkeypatch)

    momentum(pen, WIDTH, session)

    assert written[written.index("unexplained") + 1 :][:2] == ["0", "0"]
    assert not any("e−" in text for text in written)


def test_what_changes_the_total_is_the_impulse_from_outside() -> None:
    """Gravity pulls with (m1 + m2) g throughout the run."""
    session = play(session_of("newton/atwood"))

    found = since(session)

    assert found["gravity"][1] == pytest.approx(-2.5 * 9.81 * session.t, rel=1e-12)
    assert found["impulse from outside"] == pytest.approx(found["gravity"] + found["supports"])
    assert found["change of the total"] == pytest.approx(found["impulse from outside"], abs=1e-12)
    assert abs(found["change of the total"][1]) > 1


def test_what_gives_momentum_alone_is_not_told_twice() -> None:
    assert list(since(Session(scenes.level()))) == [
        "change of the total", "impulse from outside", "unexplained",
    ]  # fmt: skip


@pytest.mark.sweep
def test_of_a_crowd_the_largest_have_bars_and_the_rest_is_one() -> None:
    session = play(session_of("momentum/billiard-break"))
    every = momentum_scale.momenta(session.world, session.world.snapshot)

    found = bodies(session.world)

    assert len(found) == MOST + 1
    assert found[-1].name == "6 others"
    assert sum(each.value for each in found) == pytest.approx(every.sum(axis=0), abs=1e-15)
    smallest = min(np.hypot(*each.value) for each in found[:-1])
    assert (np.hypot(every[:, 0], every[:, 1]) > smallest).sum() == MOST - 1


def test_a_bar_is_as_long_as_its_momentum_and_goes_to_its_side(pen: Pen) -> None:
    session = Session(scenes.level())
    for _ in range(30):
        session.step()
    full = momentum_scale.scale(session, session.world, session.history.snapshots)

    columns = pixels(momentum(pen, WIDTH, session), theme.UPWARDS)

    length = (WIDTH - LABEL - card.AXIS - card.NUMBER) // 2
    seen = np.flatnonzero(columns[: 2 * length] == BAR)
    assert len(seen) == round(5 / full * length)  # 1 kg has fallen for 0.5 s at 10 m/s²
    assert seen[-1] == length - 1


def test_where_a_ghost_tells_the_course_the_scale_stays_over_the_run() -> None:
    for name in ("newton/atwood", "momentum/elastic-equal-masses"):
        session, scales = session_of(name), set()
        session.playing = True
        while session.playing:
            session.update(1 / 60, budget=10.0)
            scales.add(momentum_scale.scale(session, session.world, session.history.snapshots))
        assert len(scales) == 1, name


def test_on_a_way_back_the_scale_stays() -> None:
    session = Session(scenes.level(ghosts={}))
    assert momentum_scale.scale(session, session.world, session.history.snapshots) == 0
    play(session)
    grown = momentum_scale.scale(session, session.world, session.history.snapshots)

    session.go_to(1)

    assert grown == 10
    assert momentum_scale.scale(session, session.world, session.history.snapshots) == grown


def test_a_page_that_is_opened_late_has_seen_the_run() -> None:
    session = session_of("lagrange/double-pendulum")
    for _ in range(200):
        session.step()
    largest = np.abs(momentum_scale.momenta(session.world, session.history.snapshots)).max()

    assert momentum_scale.scale(session, session.world, session.history.snapshots) >= largest


def test_what_does_not_move_has_empty_bars(pen: Pen) -> None:
    session = Session(scenes.level(), {"g": 0.0, "mass": 1.0})

    picture = momentum(pen, WIDTH, session)

    assert of(session) == {"ball": [0, 0]}
    for color in (theme.ACROSS, theme.UPWARDS, theme.TOTAL):
        assert pixels(picture, color).max() < BAR


def test_a_level_without_heavy_bodies_says_so(pen: Pen) -> None:
    wall = {"type": "static", "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}
    session = Session(
        scenes.level(bodies={"wall": wall}, effects={}, parameters={}, checks=[], ghosts={})
    )

    assert bodies(session.world) == []
    assert momentum(pen, WIDTH, session).height > 40


def test_arrows_of_momenta_are_off_until_their_key_is_pressed(person: Person) -> None:
    person.window.open_level("momentum/elastic-heavy-on-light")
    person.wait()
    stage = person.window.stage
    assert not stage.shown[OVERLAY.name]

    def seen() -> int:
        """Return how many pixels of the stage have the colour of the arrows."""
        shown = person.window.surface.subsurface(person.window.panels.layout.stage)
        return int((pygame.surfarray.array3d(shown) == theme.RESULTANT).all(axis=2).sum())

    assert not seen()

    person.press(pygame.K_i, "i")

    assert stage.shown[OVERLAY.name]
    assert seen() > 200


def test_a_crowd_has_no_arrows_of_momenta(person: Person) -> None:
    person.window.open_level("momentum/billiard-break")
    stage = person.window.stage
    picture = pygame.Surface(stage.camera.size)
    stage.shown[OVERLAY.name] = True

    stage.draw(picture)

    assert not (pygame.surfarray.array3d(picture) == theme.RESULTANT).all(axis=2).any()
