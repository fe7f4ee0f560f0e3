"""The observer of a picture: on the ground, on a body, or at the centre of mass."""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.stepping.world import World

CENTER = ""
"""The place of an observer at the centre of mass, which is no body's name."""


class FrameOfReference:
    """Someone who moves with a place in a world, but never turns.

    `place` is a body or `CENTER`; None for the ground, also if the world lacks what is asked for.
    """

    def __init__(self, world: World, place: str | None) -> None:
        self._world = world
        exists = place in world.scene.bodies or (place == CENTER and bool(world.scene.mass.any()))
        self.place = place if exists else None
        self._row = list(world.scene.bodies).index(place) if place and exists else None

    def own(self, vectors: Array) -> Array:
        """Return the observer's own vectors, (..., 2), from those of all bodies, (..., n, 2)."""
        if self.place is None:
            return np.zeros((*vectors.shape[:-2], 2))
        if self._row is not None:
            own: Array = vectors[..., self._row, :]
            return own
        scene = self._world.scene
        mass = scene.mass * scene.mass_fraction(self._world.snapshot.t)
        mean: Array = mass @ vectors / mass.sum()
        return mean

    def relative(self, vectors: Array) -> Array:
        """Return velocities or accelerations relative to the observer, (..., n, 2)."""
        return vectors if self.place is None else vectors - self.own(vectors)[..., None, :]

    def path(self, positions: Array) -> Array:
        """Return where the observer sees earlier positions now, (k, n, 2) [m].

        Each is as far from the observer's present position as it was from the earlier one.
        """
        return self.relative(positions) + self.position

    @property
    def position(self) -> Array:
        """The observer's present position: (2,) [m]; the origin on the ground."""
        return self.own(self._world.snapshot.position)

    @property
    def displacement(self) -> XY:
        """How far the observer is from its place in the level [m]."""
        if self.place is None:
            return 0.0, 0.0
        level, values = self._world.level, self._world.values
        starts = np.array([evaluate(body.position, values) for body in level.bodies.values()])
        x, y = (self.position - self.own(starts)).tolist()
        return (x, y) if np.isfinite((x, y)).all() else (0.0, 0.0)
