"""A bead on a wire: its signed distance from a smooth curve stays zero.

The curve is a quintic through six points at a time. The distance's gradient is the unit normal at
the foot point, which Newton's method follows from where it was last.
"""

from collections.abc import Callable

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from sandbox.model.wires import Points, is_closed
from sandbox.physics.anchor import Anchor
from sandbox.physics.errors import JointFailure
from sandbox.physics.exact.equations import Coordinates, Share

MAX_ITERATIONS = 50
QUADRATIC = 1e-6
"""Pieces, below which the curve is as good as its own parabola."""

TURN = np.cos(0.5)
"""The cosine of the largest angle by which a wire may turn in a step: what turns by more cannot be
told from a bead that has cut a corner, and would be wrong by some percent."""

FINER = 4.0
"""How many times as many steps are advised to who turned by more."""

SLACK = 1.0
"""Pieces, by which a bead may be over the end of a wire: one that starts there, and rounding."""

_FIT = np.linalg.inv(np.vander(np.arange(-2.0, 4.0), increasing=True))
_BEFORE = np.array([6.0, -15.0, 20.0, -15.0, 6.0, -1.0])
"""What the quintic through six points is, one point earlier."""


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
    """

    length = 0.0
    changing: Callable[[float], float] | None = None
    pulls_only = False

    def __init__(self, joint: str, bead: Anchor, points: Points) -> None:
        assert bead.body is not None
        self.joint = joint
        self._body, self._point = bead.body, bead.point
        self._nodes = points
        self._closed = is_closed(points)
        self._pieces: list[list[complex]] = _quintics(points, self._closed).tolist()
        self._last: tuple[float, complex] | None = None  # the foot, in pieces; the tangent there

    def forget(self) -> None:
        """Look for the bead anew, wherever it is now."""
        self._last = None

    def look(self, place: Coordinates) -> tuple[float, tuple[Share]]:
        """Return the distance [m], positive on the left of the wire, and its gradient."""
        arm = self._point * np.exp(1j * place.angle[self._body]) if self._point else 0j
        bead = complex(place.plane[self._body] + arm)
        foot, tangent = self._foot(bead)
        normal = 1j * tangent
        distance = (normal.conjugate() * (bead - foot)).real
        lever = float((tangent.conjugate() * arm).real)  # Re(conj(i τ) i arm)
        return distance, (Share(self._body, normal, lever),)

    def _foot(self, bead: complex) -> tuple[complex, complex]:
        """Return the nearest point of the wire, and the unit tangent there."""
        at, before = self._last or (float(np.abs(self._nodes - bead).argmin()), None)
        for _ in range(MAX_ITERATIONS):
            point, slope, bend = self._curve(at)
            away = point - bead
            steepness = abs(slope) ** 2 + (bend.conjugate() * away).real
            if not steepness > 0:  # beyond the centre of curvature
                break
            step = -(slope.conjugate() * away).real / steepness
            at += step
            if abs(step) < QUADRATIC:
                foot = point + step * (slope + step * bend / 2)
                tangent = slope + step * bend
                tangent /= abs(tangent)
                if before is not None and (before.conjugate() * tangent).real < TURN:
                    break
                self._check_end(at)
                self._last = at, tangent
                return foot, tangent
        reason = f"'{self.joint}' bends too sharply for a step of its bead"
        raise JointFailure(self.joint, reason, FINER)

    def _curve(self, at: float) -> tuple[complex, complex, complex]:
        """Return the point [m], and its first and second derivative by the number of pieces."""
        count = len(self._pieces)
        piece = int(at // 1) % count if self._closed else min(max(int(at), 0), count - 1)
        u = at % count - piece if self._closed else at - piece
        a, b, c, d, e, f = self._pieces[piece]
        return (
            a + u * (b + u * (c + u * (d + u * (e + u * f)))),
            b + u * (2 * c + u * (3 * d + u * (4 * e + u * 5 * f))),
            2 * c + u * (6 * d + u * (12 * e + u * 20 * f)),
        )

    def _check_end(self, at: float) -> None:
        if not self._closed and not -SLACK <= at <= len(self._pieces) + SLACK:
            reason = f"the bead has come to the end of '{self.joint}'; make the wire longer"
            raise JointFailure(self.joint, reason)


def _quintics(points: Points, closed: bool) -> Points:
    """Return for each piece the coefficients of the quintic through its six nearest points."""
    if closed:
        around = np.concatenate((points[-3:-1], points, points[1:3]))
    else:
        around = points
        for _ in range(2):
            earlier, later = _BEFORE @ around[:6], _BEFORE @ around[:-7:-1]
            around = np.concatenate(([earlier], around, [later]))
    return np.asarray(sliding_window_view(around, 6) @ _FIT.T)
