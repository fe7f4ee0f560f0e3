"""The shapes in a level's file: masses, moments and outlines, derived independently.

Nothing here is taken from the engine, so that its judge does not share its mistakes. All numbers of
a scene are plain numbers, since it has no parameters.
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from validation.stability.scene_parts import Document


@dataclass(frozen=True, slots=True)
class Part:
    """A convex part of an outline: the hull of some corners, with a radius around it."""

    corners: Array
    """(k, 2), relative to the body's centre, counter-clockwise; one for a disc [m]."""
    radius: float
    """The radius around them [m]."""


def corners(shape: Document) -> Array:
    """Return the corners of a shape as they are written: (k, 2) [m]; none for round shapes."""
    match shape["type"]:
        case "box":
            x, y = shape["width"] / 2, shape["height"] / 2
            return np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
        case "polygon":
            return np.array(shape["vertices"], dtype=float)
        case "segment":
            return np.array([shape["start"], shape["end"]], dtype=float)
        case "polyline":
            return np.array(shape["points"], dtype=float)
    return np.zeros((0, 2))


def outline(body: Document) -> list[Part]:
    """Return the convex parts of a body; its polygons must be convex."""
    shape = body["shape"]
    if "radius" in shape:
        return [Part(np.zeros((1, 2)), float(shape["radius"]))]
    points = corners(shape)
    if is_dynamic(body):
        points = points - centroid(shape)
    if shape["type"] in ("box", "polygon"):
        return [Part(points if twice_area(points) > 0 else points[::-1], 0.0)]
    radius = float(shape.get("thickness", 0.0)) / 2
    return [Part(points[i : i + 2], radius) for i in range(len(points) - 1)]


def is_dynamic(body: Document) -> bool:
    """Return whether a body is dynamic."""
    return bool(body.get("type", "dynamic") == "dynamic")


def twice_area(points: Array) -> float:
    """Return twice the area of a polygon, positive if it is counter-clockwise [m²]."""
    return float(_crosses(points).sum())


def _crosses(points: Array) -> Array:
    after = np.roll(points, -1, axis=0)
    return np.asarray(points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0])


def centroid(shape: Document) -> Array:
    """Return the centre of mass of a uniform shape, in the coordinates of its file: (2,) [m]."""
    points = corners(shape)
    if not len(points):
        return np.zeros(2)
    if shape["type"] in ("box", "polygon"):
        crosses = _crosses(points)[:, None]
        total: Array = ((points + np.roll(points, -1, axis=0)) * crosses).sum(axis=0)
        return total / (3 * crosses.sum())
    lengths = np.hypot(*np.diff(points, axis=0).T)
    return np.asarray(np.average((points[1:] + points[:-1]) / 2, axis=0, weights=lengths))


def moment(body: Document) -> float:
    """Return the moment of inertia of a dynamic body about its centre of mass [kg m²]."""
    shape, mass = body["shape"], float(body["mass"])
    if "moment" in body:
        return float(body["moment"])
    if shape["type"] == "disc":
        return float(mass * shape["radius"] ** 2 / 2)
    if shape["type"] == "hoop":
        return float(mass * shape["radius"] ** 2)
    a = corners(shape) - centroid(shape)
    if shape["type"] in ("box", "polygon"):
        b, crosses = np.roll(a, -1, axis=0), _crosses(a)
        squares = np.sum(a * a + a * b + b * b, axis=1)
        return float(mass * np.sum(crosses * squares) / (6 * np.sum(crosses)))
    squares = np.sum(a[:-1] ** 2 + a[:-1] * a[1:] + a[1:] ** 2, axis=1) / 3
    lengths = np.hypot(*np.diff(a, axis=0).T)
    return float(mass * np.sum(lengths * squares) / np.sum(lengths))


def extent(body: Document) -> float:
    """Return the reach of a body's outline from its centre [m]."""
    reach = [np.hypot(*part.corners.T).max() + part.radius for part in outline(body)]
    return float(max(reach))


def thinnest(document: Document) -> float:
    """Return the least width of a dynamic body [m]."""
    return min(map(_width, filter(is_dynamic, document["bodies"].values())), default=inf)


def _width(body: Document) -> float:
    shape = body["shape"]
    if "radius" in shape:
        return 2 * float(shape["radius"])
    points = corners(shape)
    if shape["type"] not in ("box", "polygon"):
        return float(shape.get("thickness", 0.0)) or inf
    edges = np.roll(points, -1, axis=0) - points
    across = np.stack([edges[:, 1], -edges[:, 0]], axis=1) / np.hypot(*edges.T)[:, None]
    return float(np.ptp(points @ across.T, axis=0).min())
