"""The positions of joints' ends at the start."""

from cmath import rect
from collections.abc import Mapping
from itertools import pairwise
from math import fsum
from typing import cast

from sandbox.model.body import Body
from sandbox.model.expressions import Values
from sandbox.model.joints import End, Held, Joint, body_of, points
from sandbox.model.shapes import Point, evaluate


def end_position(end: End, bodies: Mapping[str, Body], values: Values) -> complex:
    """Return the position of a joint's end at the start, as x + iy [m]."""
    body = body_of(end)
    if body is None:
        return complex(*evaluate(cast("Point", end), values))
    center = complex(*evaluate(bodies[body].position, values))
    if not isinstance(end, Held):
        return center
    return center + complex(*evaluate(end.at, values)) * rect(1, bodies[body].angle(values))


def span(joint: Joint, bodies: Mapping[str, Body], values: Values) -> float:
    """Return the distance between a joint's ends at the start [m]."""
    path = [end_position(end, bodies, values) for end in points(joint)]
    return fsum(abs(b - a) for a, b in pairwise(path))
