"""A bead on a wire: its signed distance from a smooth curve stays zero.

The distance's gradient is the unit normal at the foot point, which Newton's method follows from
where it was last.
"""

from collections.abc import Callable

import numpy as np

from sandbox.model.message import Message
from sandbox.model.wires import Points
from sandbox.physics.geometry.quintics import Quintics
from sandbox.physics.joints.exact.constraints import Coordinates, Share
from sandbox.physics.state.anchor import Anchor
from sandbox.physics.state.errors import JointFailure

MAX_ITERATIONS = 50
QUADRATIC = 1e-6
"""Pieces, below which the curve is as good as its own parabola."""

TURN = np.cos(0.5)
"""The cosine of the largest angle by which a wire may turn in a step: what turns by more cannot be
told from a bead that has cut a corner, and would be wrong by some percent."""

FINER = 4.0
"""How many times as many steps are advised to who turned by more."""

REACH = 16
"""The share of its pieces, one over it, by which a bead may go on in a step where its foot is
looked for anew: nearer ends of a wire that comes back are none of its way."""

SLACK = 1.0
"""Pieces, by which a bead may be over the end of a wire: one that starts there, and rounding."""


class WireEquation:
    """The equation of one bead.

    Parameters
    ----------
    joint
        The name of the wire.
    bead
        What slides along it.
    points
        Of the curve [m], at equal steps of its parameter.

    Attributes
    ----------
    joint
        The name of the wire.
    body, point
        Which body the bead is, and where on it the wire passes [m].
    """

    length = 0.0
    changing: Callable[[float], float] | None = None
    pulls_only = False

    def __init__(self, joint: str, bead: Anchor, points: Points) -> None:
        assert bead.body is not None
        self.joint, self.body, self.point = joint, bead.body, bead.point
        self._nodes, self._curve = points, Quintics(points)
        self._last: tuple[float, complex] | None = None  # the foot, in pieces; the tangent there

    def forget(self) -> None:
        """Look for the bead anew, wherever it is now."""
        self._last = None

    def look(self, place: Coordinates) -> tuple[float, tuple[Share]]:
        """Return the distance [m], positive on the left of the wire, and its jacobian."""
        arm = self.point * np.exp(1j * place.angle[self.body]) if self.point else 0j
        distance, normal = self.near(complex(place.plane[self.body] + arm))
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
        """Return the node that is nearest, of those within reach of where it was [pieces]."""
        assert self._last is not None
        reach = self._curve.count // REACH
        first = max(int(self._last[0]) - reach, 0)
        return first + float(np.abs(self._nodes[first : first + 2 * reach] - bead).argmin())

    def _follow(self, bead: complex, at: float) -> tuple[float, complex, complex] | None:
        """Return the foot from a guess on: in pieces, the point, and the unit tangent there.

        None if it is not found, or the wire has turned by too much since the last.
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
                turned = before is not None and (before.conjugate() * tangent).real < TURN
                return None if turned else (at, foot, tangent)
        return None

    def _check_end(self, at: float) -> None:
        curve = self._curve
        if not curve.closed and not -SLACK <= at <= curve.count + SLACK:
            reason = Message(
                "the bead has come to the end of '{joint}'; make the wire longer", joint=self.joint
            )
            raise JointFailure(self.joint, reason)
