"""The impacts of a run, with their strength relative to the scene, for flashes, tones and marks.

They are recorded step by step, so a repeated run has the same impacts at the same steps. The
strength of an impact is its impulse over the largest momentum of a body so far. That momentum is at
least the one at which the lighter body would cross the view in the level's duration, for scenes
nearly at rest.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from itertools import takewhile
from typing import NamedTuple

import numpy as np

from sandbox.model.shapes import XY
from sandbox.physics.measuring.impacts import Impacts, impacts
from sandbox.physics.stepping.world import World

FAINTEST = 0.04
"""The least strength of an impact that is recorded."""
MOST = 256
"""The largest number of impacts that are kept, the latest."""

MOST_MARKS = 60
"""The largest number of marks; with more, the right one would be hard to find."""
HARD = 0.1
"""The least strength of a marked impact, as `RecordedImpact.strength`."""

ALIKE = 6
"""Decimals in comparisons of strengths, so that rounding errors do not order impacts."""


class RecordedImpact(NamedTuple):
    """An impact."""

    steps: int
    """The number of steps of the run, including that of the impact."""
    t: float
    """The time of the impact [s]."""
    at: XY
    """The contact point [m]."""
    strength: float
    """The strength, from `FAINTEST` to 1."""
    body: int
    """The index of the lighter of the dynamic bodies."""
    names: tuple[str, str]
    """The names of the two bodies."""
    impulse: float
    """The normal impulse [N s]."""


class Flash(NamedTuple):
    """An impact that fades, with its remaining brightness from 1 to 0."""

    impact: RecordedImpact
    brightness: float


class ImpactLog:
    """Records the impacts of a world from its current state on; `note` is called at every step."""

    def __init__(self, world: World) -> None:
        self._world = world
        level, values = world.level, world.values
        self._usual = level.view.width(values) / level.duration(values)  # m/s
        self._names = list(world.scene.bodies)
        self._peak = 0.0  # kg m/s
        self._last: deque[RecordedImpact] = deque(maxlen=MOST)

    def note(self) -> None:
        """Record a step."""
        found = impacts(self._world)
        if found is not None:
            self._last.extend(self._with_strength(found))

    def _with_strength(self, found: Impacts) -> Iterator[RecordedImpact]:
        steps, t = self._world.steps, self._world.t
        self._peak = max(self._peak, found.momentum)
        usual = self._world.scene.mass[found.lighter] * self._usual
        shares = np.minimum(found.impulse / np.maximum(usual, self._peak), 1.0)
        for i in np.flatnonzero(shares >= FAINTEST).tolist():
            x, y = found.at[i].tolist()
            a, b = found.bodies[i].tolist()
            yield RecordedImpact(
                steps, t, (x, y), float(shares[i]), int(found.lighter[i]),
                (self._names[a], self._names[b]), float(found.impulse[i]),
            )  # fmt: skip

    def since(self, steps: int) -> Sequence[RecordedImpact]:
        """Return the impacts after some step, the latest first."""
        return list(takewhile(lambda blow: blow.steps > steps, reversed(self._last)))

    def flashes(self, lasting: float) -> Sequence[Flash]:
        """Return the recent impacts, which fade over some time [s], the latest first.

        At its own step an impact has full brightness, however quickly it fades.
        """
        now, lasting = self._world.t, max(lasting, self._world.dt / 2)
        recent = takewhile(lambda blow: now - blow.t < lasting, reversed(self._last))
        return [Flash(blow, 1 - (now - blow.t) / lasting) for blow in recent]


class ImpactMarks:
    """The impacts that the time bar marks: the hardest of each step, if at least `HARD`."""

    def __init__(self) -> None:
        self._at: dict[int, RecordedImpact] = {}

    def note(self, blows: Sequence[RecordedImpact]) -> None:
        """Add the impacts of a step, the latest first; the earliest of the hardest is kept."""
        hardest = max(reversed(blows), key=lambda blow: round(blow.strength, ALIKE), default=None)
        if hardest and hardest.strength >= HARD and len(self._at) <= MOST_MARKS:
            self._at[hardest.steps] = hardest

    def forget_after(self, steps: int) -> None:
        """Remove impacts after some step, from which the run takes another course."""
        self._at = {step: blow for step, blow in self._at.items() if step <= steps}

    @property
    def shown(self) -> Sequence[RecordedImpact]:
        """The impacts to mark; none if there are more than `MOST_MARKS`."""
        return list(self._at.values()) if len(self._at) <= MOST_MARKS else ()
