"""The visible part of a level, with its labels and its landscape."""

from typing import Annotated

import numpy as np
from pydantic import Field

from sandbox.model.annotated_field_search import Prose
from sandbox.model.base import Model
from sandbox.model.body import MAX_BODIES
from sandbox.model.expressions import Array, Values
from sandbox.model.functions_of_one_variable import Profile
from sandbox.model.joints import End
from sandbox.model.number_bounds import Coordinate, Extent
from sandbox.model.reference_fields import BodyName, BodyNames
from sandbox.model.shapes import Point

POINTS = 241
"""The number of points of the drawn curve."""


class Landscape(Model):
    """A curve U(x) with the body's point on it, and a line at the body's energy.

    Only the curve comes from the formula. The point and the line are measured, so they leave the
    curve if a run goes wrong.
    """

    body: BodyName
    """the body with this potential energy"""
    potential: Profile
    """J, a function of the parameters and the position x"""
    x: Point
    """[from, to] in m, the range of x in which the curve is drawn"""
    y: Point
    """[from, to] in m, the range of heights in the plane in which it is drawn"""

    def curve(self, values: Values) -> tuple[Array, Array]:
        """Return places [m] and the potential there [J]; where there is none, it is not finite.

        Raises `ExpressionError` if a bound has no value, or the potential divides by zero whatever
        the place.
        """
        x = np.linspace(self.x[0](values), self.x[1](values), POINTS)
        return x, self.potential.over(values, x)


MAX_LABELS = 100
"""The most labels in a level."""


class Label(Model):
    """A text in the scene."""

    text: Annotated[Prose, Field(min_length=1, max_length=80)]
    """one short line"""
    at: End
    """the body, point of a body, or fixed point [x, y] over which it is written"""


class View(Model):
    """The visible part of the plane, and the labels in it."""

    center: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the centre of the picture"""
    width: Extent = Extent(10)
    """m, the width of the picture"""
    middle: Annotated[float, Field(gt=0, le=1)] = 1.0
    """the share of the width, about the centre, in which everything happens; a picture narrower
    than 16 : 9 then need not show more, and everything is drawn larger"""
    components: bool = False
    """whether velocities are drawn with their components"""
    labels: Annotated[tuple[Label, ...], Field(max_length=MAX_LABELS)] = ()
    """texts over bodies or points, always shown"""
    together: Annotated[
        tuple[Annotated[BodyNames, Field(min_length=2)], ...], Field(max_length=MAX_BODIES)
    ] = ()
    """groups of bodies that the editor selects with one click; no body may be in two groups"""
    landscape: Landscape | None = None
    """a potential, drawn as a curve over the position, with a body's point on it"""
