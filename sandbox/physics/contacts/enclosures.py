"""What is within a hoop does not meet what is outside of it: the hoop lies between the two.

A hoop has no thickness, so what it rolls on touches it where a ball in it does, and the two would
touch each other: the ball would rub on the floor below the hoop.
"""

from collections.abc import Iterator, Mapping
from itertools import product

import pymunk

from sandbox.model.shapes import Hoop
from sandbox.physics.contacts.collision_filter import keep_apart
from sandbox.physics.contacts.corner_feelers import Made, core_of
from sandbox.physics.geometry.arcs import Arc
from sandbox.physics.geometry.plane_curve import Course

NEAR = 1e-4
"""The share of a hoop's radius by which something may reach across it, and yet lie on one side."""


class Enclosures:
    """Keeps apart what hoops lie between.

    Parameters
    ----------
    space
        In which everything is.
    made
        The bodies that may be touched.
    lines
        Those of them that are hollow: their lines.
    """

    def __init__(
        self,
        space: pymunk.Space,
        made: Mapping[str, Made],
        lines: Mapping[str, Arc | Course],
    ) -> None:
        self._space, self._made, self._lines = space, made, lines
        self._bodies = {name: body.body for name, body in made.items()}
        self._bars: list[pymunk.Constraint] = []
        self.look()

    def look(self) -> None:
        """Look at what is within hoops where bodies are now."""
        self._space.remove(*self._bars)
        self._bars = keep_apart(self._space, self._bodies, sorted(set(self._between())))

    def _between(self) -> Iterator[tuple[str, str]]:
        """Yield the pairs of bodies of which one is within a hoop and the other outside."""
        for name, hoop in self._lines.items():
            if not (isinstance(hoop, Arc) and isinstance(self._made[name].spec.shape, Hoop)):
                continue
            middle, others = _place(self._bodies[name], hoop.center), self._made.keys() - {name}
            within = [o for o in others if self._reach(o, middle) < hoop.radius * (1 + NEAR)]
            outside = [o for o in others if self._distance(o, middle) > hoop.radius * (1 - NEAR)]
            for pair in product(within, outside):
                if any(self._made[one].moves for one in pair):
                    yield min(pair), max(pair)

    def _reach(self, name: str, middle: complex) -> float:
        """Return how far from a point a body reaches at the most [m]."""
        body, line = self._bodies[name], self._lines.get(name)
        if isinstance(line, Arc):
            return abs(_place(body, line.center) - middle) + line.outer
        return max(
            abs(_place(body, point) - middle) + shape.radius
            for shape in self._made[name].shapes
            for point in core_of(shape)
        )

    def _distance(self, name: str, middle: complex) -> float:
        """Return how far from a point a body is at the least, or less where it is hollow [m]."""
        line = self._lines.get(name)
        if isinstance(line, Arc):
            far = abs(_place(self._bodies[name], line.center) - middle)
            return max(far - line.outer, line.inner - far)
        point = middle.real, middle.imag
        return min(shape.point_query(point).distance for shape in self._made[name].shapes)


def _place(body: pymunk.Body, point: complex) -> complex:
    """Return where a point of a body is in the plane [m]."""
    return complex(*body.position) + point * complex(*body.rotation_vector)
