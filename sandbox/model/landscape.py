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

    Only the curve is the formula's. Point and line are what is measured of the body, so that a run
    that goes wrong leaves the curve.
    """

    body: BodyName
    """whose potential energy it is"""
    potential: Profile
    """J, over the parameters and the place x"""
    x: Point
    """[from, to] in m, the places between which the curve is drawn"""
    y: Point
    """[from, to] in m, between which heights of the plane it is drawn"""

    def curve(self, values: Values) -> tuple[Array, Array]:
        """Return places [m] and the potential there [J]; where there is none, it is not finite.

        Raises
        ------
        ExpressionError
            If a bound has no value, or the potential divides by zero whatever the place.
        """
        x = np.linspace(self.x[0](values), self.x[1](values), POINTS)
        return x, self.potential.over(values, x)
