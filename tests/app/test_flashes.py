"""An impact gives a short flash, which is the same however its step is reached."""

from collections.abc import Sequence

import pygame
import pytest

from sandbox.app.observing.impacts import FAINTEST, MOST, RecordedImpact
from sandbox.app.pages.settings.panel import SettingsPage
from sandbox.app.runs.run_player import FADING
from sandbox.app.runs.session import Session
from tests.app.person import Person
from tests.app.scenes import opened
from tests.app.test_time_travel import go_to

CRADLE = "momentum/cradle"


def until_it_strikes(session: Session) -> Sequence[RecordedImpact]:
    """Take steps up to that of the first impact."""
    while not session.flashes:
        assert session.world.steps < session.end
        session.step()
    return [flash.impact for flash in session.flashes]


@pytest.mark.sweep
def test_a_run_that_goes_back_shows_the_same_flashes_again() -> None:
    session = opened(CRADLE)
    until_it_strikes(session)
    step, there = session.world.steps, session.flashes
    assert len(there) == 4
    assert {flash.brightness for flash in there} == {1.0}
    for _ in range(20):
        session.step()
    later = session.flashes
    assert all(0 < flash.brightness < 1 for flash in later)

    go_to(session, step - 1)
    assert session.flashes == []
    go_to(session, step)
    assert session.flashes == there
    go_to(session, step + 20)
    assert session.flashes == later


@pytest.mark.parametrize("speed", [0.05, 1.0, 16.0])
def test_a_flash_takes_as_long_to_fade_at_every_speed(speed: float) -> None:
    session = opened("momentum/elastic-equal-masses")  # which strikes once
    session.speed = speed
    until_it_strikes(session)
    begun = session.t

    while session.flashes:
        session.step()

    assert session.t - begun == pytest.approx(FADING * speed, abs=1.01 * session.world.dt)


def test_the_harder_an_impact_is_for_its_scene_the_larger_its_flash() -> None:
    session = opened("momentum/billiard-break")
    until_it_strikes(session)
    shares = [blow.strength for blow in session.run.blows.since(0)]

    assert max(shares) > 0.4  # the cue ball is the first to strike
    assert all(FAINTEST <= share <= 1 for share in shares)
    assert len(set(shares)) > 3


def test_a_pile_that_stands_does_not_flash() -> None:
    session = opened("hard/stack-of-20")
    for _ in range(200):
        session.step()

    assert max((blow.strength for blow in session.run.blows.since(0)), default=0.0) < 2 * FAINTEST


def test_no_more_impacts_are_kept_than_can_be_of_use() -> None:
    session = opened("hard/gas-of-60")
    for _ in range(600):
        session.step()

    assert 0 < len(session.run.blows.since(0)) <= MOST


@pytest.mark.sweep
@pytest.mark.parametrize("theme", ["dark", "light", "contrast"])
def test_a_flash_is_seen_where_bodies_struck_unless_it_is_switched_off(
    person: Person, theme: str
) -> None:
    person.window.comfort.choose(theme=theme)
    person.window.open_level(CRADLE)
    person.wait()
    (blow, *_) = until_it_strikes(person.session)
    person.wait()
    x, y = person.on_screen(blow.at)
    pixel = x, y - 8
    lit = person.color_at(pixel)

    person.press(pygame.K_EXCLAIM, "!")
    dark = person.color_at(pixel)
    person.press(pygame.K_EXCLAIM, "!")
    again = person.color_at(pixel)
    person.press(pygame.K_0, "0")
    person.click(person.page(SettingsPage).button("Reduced").rect)
    reduced = person.color_at(pixel)

    assert lit == again != dark == reduced
    assert sum(abs(a - b) for a, b in zip(lit, dark, strict=True)) > 90
