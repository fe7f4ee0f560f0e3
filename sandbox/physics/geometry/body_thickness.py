"""The thickness of bodies, which scales overlaps and small displacements."""

from math import inf

import numpy as np

from sandbox.model.body import Body
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import Arc, Box, Curve, Disc, Hoop, Polygon, Polyline, Segment
from sandbox.physics.engine.pymunk_bodies import local_points
from sandbox.physics.geometry.convex_decomposition import twice_area


def thickness(body: Body, values: Values) -> float:
    """Return the thickness of a body [m]; infinite for a line."""
    match body.shape:
        case Disc(radius=radius) | Hoop(radius=radius):
            return 2 * radius(values)
        case Box(width=width, height=height):
            return min(width(values), height(values))
        case Polygon():
            corners = np.array(local_points(body, values))
            return float(abs(twice_area(corners)) / _around(corners)) * 2
        case Segment() | Polyline() | Arc() | Curve():
            return inf


def _around(corners: Array) -> float:
    return float(np.hypot(*(np.roll(corners, -1, axis=0) - corners).T).sum())
