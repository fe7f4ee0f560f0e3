"""Kicks of bodies that are held in place: the first kick of a run, and kicks at events.

If there are contacts, each is repeated until contacts and strings have converged
(`kick_convergence.py`).
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.kick_context import Kick

if TYPE_CHECKING:
    from sandbox.physics.stepping.kick_convergence import KickRepetition


class KicksWithoutDrift:
    """Kicks the n bodies of a scene while they are held in place.

    `finish` completes a kick of pymunk's, and raises errors from it. `positions` tells
    whether contacts are solved for the positions after the drift, not for velocities. `settling`
    repeats the kicks; it is None if the scene has no contacts, `has_contacts`.
    """

    def __init__(
        self,
        scene: Scene,
        finish: Callable[[], None],
        *,
        has_contacts: bool,
        positions: bool = False,
    ) -> None:
        self._space, self._batch, self._finish = scene.space, scene.batch, finish
        bodies = enumerate(scene.bodies.values())
        self._moving = {i: b for i, b in bodies if b.body_type != pymunk.Body.STATIC}
        self._held_bodies: dict[int, pymunk.Body] = {}
        self._is_holding = False
        self.settling = _settling(scene, positions=positions) if has_contacts else None

    @contextmanager
    def hold(self, *, first: bool = False) -> Iterator[None]:
        """Hold all bodies in place while pymunk steps.

        Before the `first` step, nothing pushes bodies apart yet, so those at rest stay by
        themselves. That is quicker: pymunk calls Python for each body that is held.
        """
        if self._is_holding:
            yield
            return
        self._is_holding = True
        bias, self._space.collision_bias = self._space.collision_bias, 1.0
        if not first:
            self._hold(self._moving)
        try:
            yield
        finally:
            for body in self._held_bodies.values():
                body.position_func = pymunk.Body.update_position
            self._held_bodies.clear()
            self._space.collision_bias = bias
            self._is_holding = False

    def _hold(self, rows: Iterable[int]) -> None:
        """Hold bodies in place, by their rows, unless they are held or static."""
        for row in rows:
            if row in self._moving and row not in self._held_bodies:
                self._held_bodies[row] = self._moving[row]
                self._held_bodies[row].position_func = _stay

    def kick(self, kick: Kick, acceleration: Array) -> Array:
        """Kick the held bodies from the velocities of a kick, and return those after it: (n, 3).

        `acceleration`, (n, 3), are the approximate accelerations by gravity and force
        laws [m/s², rad/s²].
        """
        start = kick.start
        assert start is not None
        if self._is_holding:
            self._hold(np.flatnonzero(start.any(axis=1)).tolist())

        def once() -> Array:
            self._batch.set_velocity(start)
            self._space.step(kick.length)
            self._finish()
            return self._batch.velocity()

        return self.settling.repeat(once, kick, acceleration) if self.settling else once()


def _settling(scene: Scene, *, positions: bool) -> "KickRepetition":
    from sandbox.physics.stepping.kick_convergence import KickRepetition

    return KickRepetition(scene, positions=positions)


def _stay(_body: pymunk.Body, _dt: float) -> None:
    """Move nothing."""
