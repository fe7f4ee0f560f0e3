"""Tones at impacts: the deeper the heavier what is struck, the louder the harder it is struck.

Bodies of one shape and material ring at frequencies in inverse proportion to their lengths, and so
to the cube root of their masses. A body of the scene's middle mass rings at `PITCH`, rounded to a
semitone. The overtones are those of a free bar (Rayleigh, The Theory of Sound, § 171).
"""

from collections.abc import Sequence
from math import log2

import numpy as np
import pygame

from sandbox.app.observing.impacts import Blow
from sandbox.app.words.language import say
from sandbox.model.expressions import Array
from sandbox.physics.stepping.world import World

RATE = 22_050  # Hz
LASTING = 0.35  # s
FADING = 0.06  # s, in which the loudness falls to 1/e
PITCH = 523.25  # Hz, C5
SEMITONES = -26, 24
"""The deepest and the highest tone, from `PITCH`: 117 Hz to 2.1 kHz."""
OVERTONES = (1.0, 1.0), (2.756, 0.45), (5.404, 0.2)
"""For each overtone, its frequency relative to the lowest, and its initial strength; the higher,
the faster it fades."""
LOUDEST = 16_000
"""The largest sample, of 32,767 possible: two tones at once are not clipped."""
AT_ONCE = 3
"""How many tones may begin in a frame: those of the hardest impacts."""
APART = 0.05  # s, between two frames in which tones begin
BUFFER = 512
"""The samples that the device takes at a time: at this rate a tone is 23 ms late."""


def opened() -> str:
    """Open the sound device, if it is not open; return why that cannot be, if so."""
    if pygame.mixer.get_init():
        return ""
    try:
        pygame.mixer.init(RATE, -16, 1, BUFFER, allowedchanges=0)
    except (pygame.error, NotImplementedError) as error:  # the latter where there is no mixer
        return str(error) or say("no reason is known")
    return ""


class Sounds:
    """Plays the impacts of runs."""

    def __init__(self) -> None:
        self._silent = False  # no device has opened
        self._rest = 0.0  # s, before tones may begin again
        self._known: dict[int, pygame.mixer.Sound] = {}

    def play(self, blows: Sequence[Blow], world: World, seconds: float) -> int:
        """Play the hardest of the impacts of a frame, and return how many.

        Parameters
        ----------
        blows
            What came in the frame.
        world
            In which.
        seconds
            How long the frame was [s].
        """
        self._rest -= seconds
        if not blows or self._rest > 0 or not self._ready():
            return 0
        self._rest = APART
        hardest = sorted(blows, key=lambda blow: -blow.share)[:AT_ONCE]
        for blow in hardest:
            sound = self._sound(semitones(world.scene.mass, blow.body))
            channel = pygame.mixer.find_channel()
            if channel is not None:
                channel.set_volume(blow.share)
                channel.play(sound)
        return len(hardest)

    def _sound(self, above: int) -> pygame.mixer.Sound:
        if above not in self._known:
            samples = (tone(above) * LOUDEST).astype(np.int16)
            self._known[above] = pygame.mixer.Sound(buffer=samples.tobytes())
        return self._known[above]

    def _ready(self) -> bool:
        """Whether tones can be heard; where no device opens, that is tried once."""
        if not (self._silent or pygame.mixer.get_init()):
            self._silent = bool(opened())
        return pygame.mixer.get_init() is not None


def semitones(mass: Array, body: int) -> int:
    """Return how far above `PITCH` a body rings, among all of a scene: (n,) [kg]."""
    middle = float(np.median(mass[mass > 0]))
    above = -12 / 3 * log2(float(mass[body]) / middle)
    return min(max(round(above), SEMITONES[0]), SEMITONES[1])


def tone(above: int) -> Array:
    """Return a tone so many semitones above `PITCH`, from -1 to 1: (k,)."""
    t = np.arange(round(RATE * LASTING)) / RATE
    lowest = PITCH * 2 ** (above / 12)
    parts = [
        strength * np.sin(2 * np.pi * ratio * lowest * t) * np.exp(-t * ratio / FADING)
        for ratio, strength in OVERTONES
        if ratio * lowest < RATE / 2
    ]
    wave: Array = np.sum(parts, axis=0)
    return wave / np.abs(wave).max()
