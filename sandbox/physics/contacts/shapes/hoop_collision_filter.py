"""Excludes contacts between bodies inside a hoop and bodies outside of it.

A hoop has no thickness, so a ball in it touches it where the floor does, and the two would touch
each other: the ball would have friction with the floor below the hoop.
"""

from collections.abc import Iterator, Mapping
from itertools import chain, islice, product

import pymunk

from sandbox.model.shapes import Hoop
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.shapes.corner_feelers import ShapedBody, core_of
from sandbox.physics.contacts.shapes.pair_exclusion import keep_apart
from sandbox.physics.geometry.arc_contacts import Arc
from sandbox.physics.geometry.plane_curve import MiddleLine
from sandbox.physics.state.simulation_errors import SimulationError

NEAR = 1e-4
"""The share of a hoop's radius by which a body may cross it and still count as on one side."""

MOST = 50_000
"""The most pairs that hoops separate, counted once per hoop: to exclude them takes a second."""


class Enclosures:
    """Excludes contacts between bodies that hoops separate.

    `made` are the bodies with contact shapes, and `lines` the lines of the hollow ones.
    """

    def __init__(
        self,
        space: pymunk.Space,
        made: Mapping[str, ShapedBody],
        lines: Mapping[str, Arc | MiddleLine],
    ) -> None:
        self._space, self._made, self._lines = space, made, lines
        self._bodies = {name: body.body for name, body in made.items()}
        self._bars: list[pymunk.Constraint] = []
        self.update()

    def update(self) -> None:
        """Find the bodies inside hoops at the present positions, and exclude their contacts.

        Raises `SimulationError` if they are too many.
        """
        found: list[tuple[str, str]] = []
        for name, line in self._lines.items():
            if isinstance(line, Arc) and isinstance(self._made[name].spec.shape, Hoop):
                found += islice(self._between(name, line), MOST + 1 - len(found))
                if len(found) > MOST:
                    raise SimulationError(name, 0.0, _too_many())
        self._space.remove(*self._bars)
        self._bars = keep_apart(self._space, self._bodies, sorted(set(found)))

    def _between(self, name: str, hoop: Arc) -> Iterator[tuple[str, str]]:
        """Yield the pairs of bodies with one inside a hoop and the other outside."""
        middle, others = _place(self._bodies[name], hoop.center), self._made.keys() - {name}
        within = {o for o in others if self._reach(o, middle) < hoop.radius * (1 + NEAR)}
        outside = {o for o in others if self._distance(o, middle) > hoop.radius * (1 - NEAR)}
        # a hoop of the same size around the same point is on neither side
        inner, outer = within - outside, outside - within
        moving = {o for o in others if self._made[o].moves}
        for pair in chain(product(inner & moving, outer), product(inner - moving, outer & moving)):
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


def _too_many() -> Message:
    return Message(
        "hoops separate more than {most:,} pairs of bodies, one inside and one outside; have fewer"
        " bodies, or fewer hoops",
        most=MOST,
    )


def _place(body: pymunk.Body, point: complex) -> complex:
    """Return the position of a point of a body in the plane [m]."""
    return complex(*body.position) + point * complex(*body.rotation_vector)
