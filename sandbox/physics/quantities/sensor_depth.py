"""The depth of a body's centre in a sensor: its distance from the outline, negative outside."""

from collections.abc import Callable

import numpy as np

from sandbox.model.body import Body
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import Disc
from sandbox.physics.engine.pymunk_bodies import local_points
from sandbox.physics.geometry.depth_in_polygon import depth
from sandbox.physics.state.joint_anchors import Complexes
from sandbox.physics.state.snapshot import Snapshot


def sensing(row: int, sensor: int, spec: Body, values: Values) -> Callable[[Snapshot], Array]:
    """Return a function from snapshots to the depth of a body in a sensor [m].

    `row` and `sensor` are the indices of the two, and `spec` is the sensor's description.
    """
    shape = spec.shape
    if isinstance(shape, Disc):
        radius = shape.radius(values)
        return lambda s: radius - np.abs(_inside(s, row, sensor))
    corners = np.array([complex(*point) for point in local_points(spec, values)])
    return lambda s: depth(_inside(s, row, sensor), corners)


def _inside(s: Snapshot, row: int, sensor: int) -> Complexes:
    """Return the position of a body relative to the sensor, in its axes: (...) [m]."""
    apart = s.position[..., row, :] - s.position[..., sensor, :]
    return (apart[..., 0] + 1j * apart[..., 1]) * np.exp(-1j * s.angle[..., sensor])
