"""Kicks of bodies that are held in place: the first kick, and those that have to be found first.

pymunk solves contacts, and strings after them, in turn: one kick leaves them a little at odds. So
bodies are held where they are and kicked again and again from the same velocities, each time from
the impulses found before, until nothing changes any more.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.kick import Kick

MAX_KICKS = 500
"""How often a kick is repeated while contacts and strings come to terms."""

PATIENCE = 50
"""After how many kicks that settle nothing each is given twice as many sweeps of the solver."""

UNSETTLED = 1000
"""How many times the rounding velocities must still change for that."""

LULL = 10
"""For how many kicks what changes must not halve, to be taken for rounding that goes in circles."""

MAX_SWEEPS = 5000
"""How many sweeps a kick may then have, times the pairs in contact: it bounds the time it takes."""


class HeldKicks:
    """Kicks the bodies of a scene that are held where they are; n of them.

    Parameters
    ----------
    scene
        What moves.
    finish
        Does what belongs after a kick of pymunk's, and raises what has gone wrong in it.
    touching
        Whether there are contacts at all: without any, nothing has to settle.
    placed
        Whether contacts are solved for the places after the drift, not for velocities.
    """

    def __init__(
        self, scene: Scene, finish: Callable[[], None], *, touching: bool, placed: bool = False
    ) -> None:
        self._space, self._batch, self._finish = scene.space, scene.batch, finish
        self._moving = [b for b in scene.bodies.values() if b.body_type != pymunk.Body.STATIC]
        self._holding, self._placed = False, placed
        self._most = MAX_KICKS if touching else 1

    @contextmanager
    def held(self) -> Iterator[None]:
        """Hold all bodies where they are, whatever is stepped."""
        if self._holding:
            yield
            return
        self._holding = True
        bias, self._space.collision_bias = self._space.collision_bias, 1.0
        for body in self._moving:
            body.position_func = _stay
        try:
            yield
        finally:
            for body in self._moving:
                body.position_func = pymunk.Body.update_position
            self._space.collision_bias = bias
            self._holding = False

    def kick(self, kick: Kick, smooth: Array) -> Array:
        """Kick bodies that are held, and return their velocities after it: (n, 3).

        Parameters
        ----------
        kick
            Which, with the velocities at its start.
        smooth
            (n, 3), about how strong gravity and force laws are [m/s², rad/s²].
        """
        start, length = kick.start, kick.length
        assert start is not None
        swept = self._space.iterations
        pulled = length * np.abs(smooth).max(initial=0.0)
        close = 1e-15 * (pulled or np.abs(start).max(initial=0.0))  # the rounding of what changes
        near = UNSETTLED * close
        if self._placed:
            from sandbox.physics.contacts.direct.rounding import left_of_places, spread

            left = left_of_places(self._batch.state()[:, :3], self._moving, kick.drift)
            near = max(near * spread(self._moving), left)
        after = np.full_like(start, np.inf)  # at least two kicks are compared
        if self._most > 1:
            from sandbox.physics.state.cancellation import cancellation_point
        changes: list[float] = []
        for count in range(self._most):
            if count:
                cancellation_point()
            previous = after
            self._batch.set_velocity(start)
            self._space.step(length)
            self._finish()
            after = self._batch.velocity()
            change = float(np.abs(after - previous).max(initial=0.0))
            changes.append(change)
            if change <= close or _circles(changes[-2 * LULL :], near):
                break
            if count % PATIENCE == PATIENCE - 1 and change > near:
                most = MAX_SWEEPS // max(len(self._batch.contacts().bodies), 1)
                self._space.iterations = max(min(2 * self._space.iterations, most), swept)
        self._space.iterations = swept
        return after


def _circles(changes: Sequence[float], near: float) -> bool:
    """Whether what still changes is near rounding, and has ceased to grow less."""
    before, now = changes[:LULL], changes[LULL:]
    return len(now) == LULL and max(now) <= near and min(now) >= min(before) / 2


def _stay(_body: pymunk.Body, _dt: float) -> None:
    """Move nothing."""
