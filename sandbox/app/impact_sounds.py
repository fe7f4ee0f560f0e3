"""Tones at impacts: heavier bodies sound lower, and harder impacts louder.

Bodies of one shape and material ring at frequencies in inverse proportion to their lengths, and so
to the cube root of their masses. A body of the scene's median mass rings at `PITCH`; other pitches
are rounded to a semitone. The overtones are those of a free bar (Rayleigh, The Theory of Sound,
§ 171).
"""

from collections.abc import Sequence
from math import log2

import numpy as np
import pygame

from sandbox.app.observing.impacts import RecordedImpact
from sandbox.app.words.language import say
from sandbox.model.expressions import Array
from sandbox.physics.stepping.world import World

RATE = 22_050  # Hz
LASTING = 0.35  # s
FADING = 0.06  # s, in which the loudness falls to 1/e
PITCH = 523.25  # Hz, C5
SEMITONES = -26, 24
"""The lowest and the highest tone, relative to `PITCH`: 117 Hz to 2.1 kHz."""
OVERTONES = (1.0, 1.0), (2.756, 0.45), (5.404, 0.2)
"""The frequency relative to the lowest, and the initial amplitude, of each partial; higher ones
fade faster."""
LOUDEST = 16_000
"""The largest sample, of 32,767 possible: two tones at once are not clipped."""
AT_ONCE = 3
"""The largest number of tones that start in a frame: those of the hardest impacts."""
APART = 0.05  # s, between two frames in which tones start
BUFFER = 512
"""The buffer size of the device in samples: at this rate the latency is 23 ms."""


def open_device() -> str:
    """Open the sound device, if it is not open; return why that fails, else an empty string."""
    if pygame.mixer.get_init():
        return ""
    try:
        pygame.mixer.init(RATE, -16, 1, BUFFER, allowedchanges=0)
    except (pygame.error, NotImplementedError) as error:  # the latter without a mixer
        return str(error) or say("no reason is known")
    return ""


class Sounds:
    """Plays the impacts of runs."""

    def __init__(self) -> None:
        self._silent = False  # whether no device could be opened
        self._rest = 0.0  # s, until tones may start again
        self._known: dict[int, pygame.mixer.Sound] = {}

    def play(self, blows: Sequence[RecordedImpact], world: World, seconds: float) -> int:
        """Play the hardest of the impacts of a frame of some duration [s], and return how many."""
        self._rest -= seconds
        if not blows or self._rest > 0 or not self._ready():
            return 0
        self._rest = APART
        hardest = sorted(blows, key=lambda blow: -blow.strength)[:AT_ONCE]
        for blow in hardest:
            sound = self._sound(semitones(world.scene.mass, blow.body))
            channel = pygame.mixer.find_channel()
            if channel is not None:
                channel.set_volume(blow.strength)
                channel.play(sound)
        return len(hardest)

    def _sound(self, above: int) -> pygame.mixer.Sound:
        if above not in self._known:
            samples = (tone(above) * LOUDEST).astype(np.int16)
            self._known[above] = pygame.mixer.Sound(buffer=samples.tobytes())
        return self._known[above]

    def _ready(self) -> bool:
        """Whether a device is open; opening one is tried only once if it fails."""
        if not (self._silent or pygame.mixer.get_init()):
            self._silent = bool(open_device())
        return pygame.mixer.get_init() is not None


def semitones(mass: Array, body: int) -> int:
    """Return the pitch of a body relative to `PITCH` [semitones], given all masses: (n,) [kg]."""
    middle = float(np.median(mass[mass > 0]))
    above = -12 / 3 * log2(float(mass[body]) / middle)
    return min(max(round(above), SEMITONES[0]), SEMITONES[1])


def tone(above: int) -> Array:
    """Return the samples of a tone some semitones above `PITCH`: (k,), from −1 to 1."""
    t = np.arange(round(RATE * LASTING)) / RATE
    lowest = PITCH * 2 ** (above / 12)
    parts = [
        strength * np.sin(2 * np.pi * ratio * lowest * t) * np.exp(-t * ratio / FADING)
        for ratio, strength in OVERTONES
        if ratio * lowest < RATE / 2
    ]
    wave: Array = np.sum(parts, axis=0)
    return wave / np.abs(wave).max()
