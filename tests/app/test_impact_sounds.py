"""Impacts sound, if the user wants it and the machine can."""

from collections.abc import Iterator

import numpy as np
import pygame
import pytest

from sandbox.app import impact_sounds
from sandbox.app.impact_sounds import (
    APART,
    AT_ONCE,
    PITCH,
    RATE,
    SEMITONES,
    Sounds,
    semitones,
    tone,
)
from sandbox.app.observing.impacts import RecordedImpact
from sandbox.app.pages.settings import panel
from sandbox.app.pages.settings.panel import SettingsPage
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.physics.run import build
from tests.app.person import FRAME, Person

BALL = "momentum/bouncing-ball"
CRADLE = "momentum/cradle"


@pytest.fixture(autouse=True)
def _silence() -> Iterator[None]:
    pygame.mixer.quit()
    yield
    pygame.mixer.quit()


def blows(*shares: float) -> list[RecordedImpact]:
    return [
        RecordedImpact(1, 0.1, (0.0, 0.0), share, 1, ("ball", "floor"), share) for share in shares
    ]


def settings(person: Person) -> SettingsPage:
    person.press(pygame.K_0, "0")
    return person.page(SettingsPage)


def plays(person: Person) -> bool:
    """Play the open level from its start, and return whether its impact was heard."""
    person.press(pygame.K_r, "r")
    person.press(pygame.K_SPACE, " ")
    while not person.session.flashes:
        assert person.session.playing
        person.wait()
    heard = bool(pygame.mixer.get_init() and pygame.mixer.get_busy())
    person.press(pygame.K_SPACE, " ")
    return heard


@pytest.mark.parametrize("above", [SEMITONES[0], 0, SEMITONES[1]])
def test_a_tone_has_the_pitch_that_it_is_asked_for_and_dies_away(above: int) -> None:
    wave = tone(above)
    strength = np.abs(np.fft.rfft(wave, 8 * RATE))
    third = len(wave) // 3

    assert np.argmax(strength) / 8 == pytest.approx(PITCH * 2 ** (above / 12), rel=0.01)
    assert np.abs(wave).max() == 1
    assert np.abs(wave[-third:]).max() < 0.05 * np.abs(wave[:third]).max()


def test_a_body_of_eight_times_the_mass_rings_an_octave_deeper() -> None:
    mass = np.array([0.0, 8.0, 1.0, 1.0, 1 / 8, 1e9, 1e-9])  # the first is the floor

    found = [semitones(mass, body) for body in range(1, len(mass))]

    assert found == [-12, 0, 0, 12, *SEMITONES]


def test_nothing_is_heard_and_no_device_is_opened_before_it_is_wanted(person: Person) -> None:
    person.window.open_level(BALL)

    assert not plays(person)
    assert pygame.mixer.get_init() is None


def test_impacts_are_heard_while_time_passes_but_not_on_a_way_back(person: Person) -> None:
    person.window.open_level(BALL)
    person.click(settings(person).button("On").rect)
    assert settings(person).button("On").is_selected

    assert plays(person)
    pygame.mixer.stop()
    person.session.go_to(person.session.end - 2)
    person.wait(0.3)
    assert not pygame.mixer.get_busy()

    person.click(settings(person).button("Off").rect)
    assert not plays(person)


def test_the_hardest_impacts_of_a_frame_are_played_as_loud_as_they_are_hard() -> None:
    world, player = build(load(level_catalog.find(CRADLE))), Sounds()
    assert impact_sounds.open_device() == ""

    assert player.play(blows(0.1, 0.5, 0.9, 0.3, 0.2), world, FRAME) == AT_ONCE

    channels = [pygame.mixer.Channel(i) for i in range(pygame.mixer.get_num_channels())]
    loud = sorted((c.get_volume() for c in channels if c.get_busy()), reverse=True)
    assert loud == pytest.approx([0.9, 0.5, 0.3], abs=0.01)  # SDL has 128 steps


def test_tones_do_not_begin_in_every_frame() -> None:
    world, player = build(load(level_catalog.find(CRADLE))), Sounds()

    begun = [player.play(blows(0.5), world, FRAME) for _ in range(60)]

    assert 0 < sum(begun) <= 1 / APART


def test_without_a_device_the_page_of_settings_says_so_and_all_else_goes_on(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SDL_AUDIODRIVER", "nothing-of-this-name")
    person.window.open_level(BALL)

    person.click(settings(person).button("On").rect)

    told = {setting.title: setting.help for setting in panel.settings(person.window.comfort)}
    assert "nothing-of-this-name" in told["Sound"]
    assert not plays(person)

    monkeypatch.setenv("SDL_AUDIODRIVER", "dummy")
    person.click(settings(person).button("On").rect)
    assert plays(person)
