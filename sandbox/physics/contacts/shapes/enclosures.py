"""Excludes contacts between bodies inside a hoop and bodies outside of it.

A hoop has no thickness, so a ball in it touches it where the floor does, and the two would touch
each other: the ball would have friction with the floor below the hoop.
"""

from collections.abc import Iterator, Mapping
from itertools import product

import pymunk

from sandbox.model.shapes import Hoop
from sandbox.physics.contacts.shapes.collision_filter import keep_apart
from sandbox.physics.contacts.shapes.corner_feelers import Made, core_of
from sandbox.physics.geometry.arcs import Arc
from sandbox.physics.geometry.plane_curve import Course

NEAR = 1e-4
"""The share of a hoop's radius by which a body may cross it and still count as on one side."""


class Enclosures:
    """Excludes contacts between bodies that hoops separate.

    `made` are the bodies with contact shapes, and `lines` the lines of the hollow ones.
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
        """Find the bodies inside hoops at the present positions, and exclude their contacts."""
        self._space.remove(*self._bars)
        self._bars = keep_apart(self._space, self._bodies, sorted(set(self._between())))

    def _between(self) -> Iterator[tuple[str, str]]:
        """Yield the pairs of bodies with one inside a hoop and the other outside."""
        for name, hoop in self._lines.items():
            if not (isinstance(hoop, Arc) and isinstance(self._made[name].spec.shape, Hoop)):
                continue
            middle, others = _place(self._bodies[name], hoop.center), self._made.keys() - {name}
            within = {o for o in others if self._reach(o, middle) < hoop.radius * (1 + NEAR)}
            outside = {o for o in others if self._distance(o, middle) > hoop.radius * (1 - NEAR)}
            # a hoop of the same size around the same point is on neither side
            for pair in product(within - outside, outside - within):
                if any(self._made[one].moves for one in pair):
                    yield min(pair), max(pair)

    def _reach(self, name: str, middle: complex) -> float:
        """Return the largest distance of a body from a point [m]."""
        body, line = self._bodies[name], self._lines.get(name)
        if isinstance(line, Arc):
            return abs(_place(body, line.center) - middle) + line.outer
        return max(
            abs(_place(body, point) - middle) + shape.radius
            for shape in self._made[name].shapes
            for point in core_of(shape)
        )

    def _distance(self, name: str, middle: complex) -> float:
        """Return the distance of a body from a point; if it is hollow, a lower bound [m]."""
        line = self._lines.get(name)
        if isinstance(line, Arc):
            far = abs(_place(self._bodies[name], line.center) - middle)
            return max(far - line.outer, line.inner - far)
        point = middle.real, middle.imag
        return min(shape.point_query(point).distance for shape in self._made[name].shapes)


def _place(body: pymunk.Body, point: complex) -> complex:
    """Return the position of a point of a body in the plane [m]."""
    return complex(*body.position) + point * complex(*body.rotation_vector)
