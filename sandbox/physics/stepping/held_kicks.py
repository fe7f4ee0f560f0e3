"""Kicks of bodies that are held in place: the first kick of a run, and kicks at events.

If there are contacts, each is repeated until contacts and strings have converged (`settling.py`).
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.kick import Kick

if TYPE_CHECKING:
    from sandbox.physics.stepping.settling import Settling


class HeldKicks:
    """Kicks the n bodies of a scene while they are held in place.

    `finish` completes a kick of pymunk's, and raises errors from it. `placed` tells whether
    contacts are solved for the positions after the drift, not for velocities. `settling` repeats
    the kicks; it is None if the scene has no contacts, `touching`.
    """

    def __init__(
        self, scene: Scene, finish: Callable[[], None], *, touching: bool, placed: bool = False
    ) -> None:
        self._space, self._batch, self._finish = scene.space, scene.batch, finish
        self._moving = [b for b in scene.bodies.values() if b.body_type != pymunk.Body.STATIC]
        self._holding = False
        self.settling = _settling(scene, placed=placed) if touching else None

    @contextmanager
    def held(self) -> Iterator[None]:
        """Hold all bodies in place while pymunk steps."""
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
        """Kick the held bodies from the velocities of a kick, and return those after it: (n, 3).

        `smooth`, (n, 3), are the approximate accelerations by gravity and force
        laws [m/s², rad/s²].
        """
        start = kick.start
        assert start is not None

        def once() -> Array:
            self._batch.set_velocity(start)
            self._space.step(kick.length)
            self._finish()
            return self._batch.velocity()

        return self.settling.repeat(once, kick, smooth) if self.settling else once()


def _settling(scene: Scene, *, placed: bool) -> "Settling":
    from sandbox.physics.stepping.settling import Settling

    return Settling(scene, placed=placed)


def _stay(_body: pymunk.Body, _dt: float) -> None:
    """Move nothing."""
