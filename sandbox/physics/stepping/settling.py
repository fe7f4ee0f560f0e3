"""Kicks that are repeated until contacts and strings have come to terms.

pymunk solves contacts, and strings after them, in turn: one kick leaves them a little at odds. So
each begins with the same velocities, and from the impulses found before.
"""

from collections.abc import Callable, Sequence
from math import inf

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.cancellation import cancellation_point
from sandbox.physics.state.kick import Kick

MAX_KICKS = 500
"""How often a kick is repeated at the most."""

PATIENCE = 50
"""After how many kicks that settle nothing each is given twice as many sweeps of the solver."""

UNSETTLED = 1000
"""How many times the rounding velocities must still change for that."""

LULL = 10
"""For how many kicks what changes must not halve, to be taken for rounding that goes in circles."""

MAX_SWEEPS = 5000
"""How many sweeps a kick may then have, times the pairs in contact: it bounds the time it takes."""


class Settling:
    """Repeats kicks of the bodies of a scene, which are held where they are; n of them.

    Parameters
    ----------
    scene
        What moves.
    placed
        Whether contacts are solved for the places after the drift, not for velocities.

    Attributes
    ----------
    unsettled
        Whether contacts and strings had not come to terms when they were repeated last.
    """

    def __init__(self, scene: Scene, *, placed: bool) -> None:
        self._space, self._batch, self._placed = scene.space, scene.batch, placed
        self._bodies = [b for b in scene.bodies.values() if b.body_type != pymunk.Body.STATIC]
        self.unsettled = False

    def repeat(self, once: Callable[[], Array], kick: Kick, smooth: Array) -> Array:
        """Take a kick again and again, and return the velocities after the last: (n, 3).

        Parameters
        ----------
        once
            Takes it, from the same velocities each time, and returns those after it.
        kick, smooth
            As for `HeldKicks.kick`.
        """
        close, near = self._tolerances(kick, smooth)
        swept, after = self._space.iterations, once()
        changes = [inf]
        for count in range(1, MAX_KICKS):
            cancellation_point()
            previous, after = after, once()
            changes.append(float(np.abs(after - previous).max(initial=0.0)))
            if changes[-1] <= close or _circles(changes[-2 * LULL :], near):
                break
            if count % PATIENCE == PATIENCE - 1 and changes[-1] > near:
                most = MAX_SWEEPS // max(len(self._batch.contacts().bodies), 1)
                self._space.iterations = max(min(2 * self._space.iterations, most), swept)
        self._space.iterations = swept
        self.unsettled = changes[-1] > near
        return after

    def _tolerances(self, kick: Kick, smooth: Array) -> tuple[float, float]:
        """Return how much velocities change by rounding, and how much where they may circle."""
        assert kick.start is not None
        pulled = kick.length * np.abs(smooth).max(initial=0.0)
        close = 1e-15 * float(pulled or np.abs(kick.start).max(initial=0.0))
        near = UNSETTLED * close
        if self._placed:
            from sandbox.physics.contacts.direct.rounding import left_of_places, spread

            left = left_of_places(self._batch.state()[:, :3], self._bodies, kick.drift)
            near = max(near * spread(self._bodies), left)
        return close, near


def _circles(changes: Sequence[float], near: float) -> bool:
    """Whether what still changes is near rounding, and has ceased to grow less."""
    before, now = changes[:LULL], changes[LULL:]
    return len(now) == LULL and max(now) <= near and min(now) >= min(before) / 2
