"""Landscapes: a potential drawn as a curve on which the body's point rides."""

import numpy as np

from sandbox.model.base import Model
from sandbox.model.expressions import Array, Values
from sandbox.model.formulas import Profile
from sandbox.model.reference_fields import BodyName
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
