"""A bead on a wire: its signed distance from a smooth curve stays zero.

The gradient of the distance is the unit normal at the foot point, which Newton's method finds from
the last foot point.
"""

import numpy as np

from sandbox.model.translatable_message import Message
from sandbox.model.wire_points import Points
from sandbox.physics.geometry.quintic_curve import Quintics
from sandbox.physics.joints.exact.constraint_interface import Coordinates, Share
from sandbox.physics.state.joint_anchors import Anchor
from sandbox.physics.state.simulation_errors import JointFailure

MAX_ITERATIONS = 50
QUADRATIC = 1e-6
"""Pieces: over a smaller Newton step the curve equals its own parabola up to rounding."""

TURN = np.cos(0.5)
"""The cosine of the largest turn of a wire in a step. A larger turn would give errors of some
percent, and cannot be distinguished from a bead that has cut a corner."""

FINER = 4.0
"""The factor on the step rate that is advised after a larger turn."""

REACH = 16
"""If the foot of a bead is searched again, it is within the wire's number of pieces over this, to
either side. Parts of the wire that come closer but are further along do not count."""

SLACK = 1.0
"""Pieces, the most by which a bead may be past the end of a wire, for one that starts there and
for rounding."""


class WireEquation:
    """The equation of one bead, the anchor that slides along the wire.

    The points of the curve are at equal steps of its parameter [m].
    """

    length = 0.0
    changing: None = None
    pulls_only = False

    def __init__(self, joint: str, bead: Anchor, points: Points) -> None:
        assert bead.body is not None
        self.joint = joint
        """The name of the wire."""
        self.body, self.point = bead.body, bead.point
        """The body of the bead, and the point of that body on the wire [m]."""
        self._nodes, self._curve = points, Quintics(points)
        self._last: tuple[float, complex] | None = None  # the foot, in pieces; the tangent there

    def forget(self) -> None:
        """Forget the last foot point, so that the next one is searched on the whole wire."""
        self._last = None

    def evaluate(self, pose: Coordinates) -> tuple[float, tuple[Share]]:
        """Return the distance [m], positive on the left of the wire, and its gradient."""
        arm = self.point * np.exp(1j * pose.angle[self.body]) if self.point else 0j
        distance, normal = self.near(complex(pose.position[self.body] + arm))
        lever = float((normal.conjugate() * 1j * arm).real)
        return distance, (Share(self.body, normal, lever),)

    def near(self, bead: complex) -> tuple[float, complex]:
        """Return the distance of a point [m], positive on the left, and the unit normal there."""
        foot, tangent = self._foot(bead)
        normal = 1j * tangent
        return (normal.conjugate() * (bead - foot)).real, normal

    def _foot(self, bead: complex) -> tuple[complex, complex]:
        """Return the nearest point of the wire, and the unit tangent there."""
        if self._last is None:
            found = self._follow(bead, float(np.abs(self._nodes - bead).argmin()))
        else:
            found = self._follow(bead, self._last[0]) or self._follow(bead, self._near(bead))
        if found is None:
            reason = Message("'{joint}' bends too sharply for a step of its bead", joint=self.joint)
            raise JointFailure(self.joint, reason, FINER)
        at, foot, tangent = found
        self._check_end(at)
        self._last = at, tangent
        return foot, tangent

    def _near(self, bead: complex) -> float:
        """Return the nearest node of those within reach of the last foot point [pieces]."""
        assert self._last is not None
        reach = self._curve.count // REACH
        first = max(int(self._last[0]) - reach, 0)
        return first + float(np.abs(self._nodes[first : first + 2 * reach] - bead).argmin())

    def _follow(self, bead: complex, at: float) -> tuple[float, complex, complex] | None:
        """Return the foot point from a guess: the parameter in pieces, the point, the unit tangent.

        None if Newton's method does not converge, or the wire turns too much from the last foot.
        """
        before = self._last and self._last[1]
        for _ in range(MAX_ITERATIONS):
            point, slope, bend = self._curve.at(at)
            away = point - bead
            steepness = abs(slope) ** 2 + (bend.conjugate() * away).real
            if not steepness > 0:  # beyond the centre of curvature
                return None
            step = -(slope.conjugate() * away).real / steepness
            at += step
            if abs(step) < QUADRATIC:
                foot = point + step * (slope + step * bend / 2)
                tangent = slope + step * bend
                tangent /= abs(tangent)
                turned_back = before is not None and (before.conjugate() * tangent).real < TURN
                return None if turned_back else (at, foot, tangent)
        return None

    def _check_end(self, at: float) -> None:
        curve = self._curve
        if not curve.closed and not -SLACK <= at <= curve.count + SLACK:
            reason = Message(
                "the bead has reached the end of '{joint}'; make the wire longer", joint=self.joint
            )
            raise JointFailure(self.joint, reason)
