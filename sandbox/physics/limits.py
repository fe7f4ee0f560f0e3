"""What a scene asks of the step, known before the first is taken."""

from math import inf

import numpy as np
import pymunk


def width(shape: pymunk.Shape) -> float:
    """Return how wide a shape is where it is narrowest [m]."""
    match shape:
        case pymunk.Circle():
            return 2 * shape.radius
        case pymunk.Segment():
            return 2 * shape.radius
        case pymunk.Poly():
            corners = np.array(shape.get_vertices())
            edges = np.roll(corners, -1, axis=0) - corners
            across = np.stack((-edges[:, 1], edges[:, 0]), axis=1) / np.hypot(*edges.T)[:, None]
            heights = across @ corners.T
            return float(np.ptp(heights, axis=1).min()) + 2 * shape.radius
    return inf


def smallest(space: pymunk.Space) -> float:
    """Return how wide the narrowest shape of a dynamic body is [m], 0 if there is none."""
    dynamic = [s for s in space.shapes if s.body and s.body.body_type == pymunk.Body.DYNAMIC]
    return min(map(width, dynamic), default=0.0)
