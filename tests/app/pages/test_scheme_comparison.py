"""The race of the schemes."""

from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.level_picture import render
from sandbox.app.pages.scheme_race import scheme_comparison
from sandbox.app.pages.scheme_race.panel import RacePage
from sandbox.app.runs.session import Session
from sandbox.model.level import Stepping
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from sandbox.physics.run import build
from tests.app import scenes
from tests.app.person import Person
from tests.app.scenes import play

DRAG = {"gravity": {"acceleration": [0, "-g"]}, "drag": {"linear": 0.1}}


def test_each_scheme_runs_in_its_own_world_to_the_last_bit() -> None:
    session = Session(scenes.level(effects=DRAG))
    scheme_comparison.toggle(session)

    play(session)

    assert len(session.companions) >= 2
    for other in session.companions:
        stepping = Stepping(scheme=other.world.stepping.scheme)
        alone = build(session.original, stepping=stepping)
        alone.advance(60)
        assert np.array_equal(other.world.snapshot.position, alone.snapshot.position)


def test_every_lane_tells_its_error_and_its_clock() -> None:
    session = Session(scenes.level())
    scheme_comparison.toggle(session)

    play(session)
    ours, naive = (
        next(lane for lane in scheme_comparison.lanes(session) if lane.scheme == scheme)
        for scheme in ("leapfrog", "symplectic-euler")
    )

    assert ours.error is not None
    assert naive.error is not None
    assert ours.error < 1e-12
    assert naive.error > 1e-3
    assert all(lane.cost and lane.cost > 0 for lane in scheme_comparison.lanes(session))


def test_schemes_are_judged_past_an_event_of_which_they_record_no_place() -> None:
    """The needle's axle is at rest: its checks use only its angle, not its place."""
    session = Session(load(find("lagrange/leapfrog-pendulum")))
    scheme_comparison.toggle(session)
    session.playing = True

    session.update(1.0, budget=60)  # a quarter of its period is 0.51 s

    lanes = scheme_comparison.lanes(session)
    assert len(lanes) == 4
    assert all(lane.error is not None for lane in lanes)
    assert len(session.milestones()) == 1


def test_a_scheme_that_would_be_the_same_is_left_out() -> None:
    without, with_law = scenes.level(), scenes.level(effects=DRAG)
    raced = []
    for level in (without, with_law):
        session = Session(level)
        scheme_comparison.toggle(session)
        raced.append({lane.scheme for lane in scheme_comparison.lanes(session)})

    assert "explicit-euler" not in raced[0]
    assert {"symplectic-euler", "explicit-euler"} <= raced[1]


def test_at_most_four_race() -> None:
    session = Session(load(find("energy/kepler-ellipse")))
    scheme_comparison.toggle(session)

    assert 3 <= len(scheme_comparison.lanes(session)) <= scheme_comparison.MOST


def test_the_race_ends_as_it_began() -> None:
    session = Session(scenes.level())
    scheme_comparison.toggle(session)
    session.step()

    scheme_comparison.toggle(session)

    assert session.companions == ()
    assert session.level == session.original


@pytest.mark.sweep
def test_the_race_is_started_by_its_button_and_seen(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, scenes.falling())
    person.press(pygame.K_s, "s")
    page = person.page(RacePage)

    person.click(page.button.rect)  # no further key: it plays
    person.wait(1.2)

    stage = person.window.panels.layout.stage
    pixels = pygame.surfarray.array3d(person.window.surface.subsurface(stage))
    assert scheme_comparison.racing(person.session)
    assert page.button.text == "End the race"
    assert person.session.t > 0.5
    assert (pixels == theme.LANES[0]).all(axis=2).sum() > 20


def test_the_window_opens_with_the_race_under_way(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, scenes.falling())

    person.window.do("race")
    person.wait()

    assert scheme_comparison.racing(person.session)


@pytest.mark.sweep
@pytest.mark.parametrize(
    "name", ["energy/kepler-ellipse", "newton/atwood", "momentum/cradle-on-a-line"]
)
def test_the_race_is_drawn_without_a_window(name: str) -> None:
    level = load(find(name))

    picture = render(level, level.defaults, racing=True)

    assert (pygame.surfarray.array3d(picture) == theme.LANES[0]).all(axis=2).any()
