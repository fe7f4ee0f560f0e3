"""Rods that share no bodies, solved one by one in floats: in a tenth of the time of arrays.

The equation is that of `ExactJoints`, for the vector r from one end to the other,

    |r + h (v − λ (1/m_a + 1/m_b) r / |r|)| = L.
"""

from math import hypot

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Batch
from sandbox.physics.joints.exact.constraint_interface import MAX_ITERATIONS, QUADRATIC
from sandbox.physics.joints.exact.distances import Row


class Rod:
    """Keeps the distance of two bodies, or of a body from a point of the plane.

    Its equation is one of those in `separate_joints.are_apart`. `inverse` are the inverse masses,
    (n + 1,), 0 of bodies that do not move, the plane last [1/kg]. Points of the plane are relative
    to the origin [m].
    """

    def __init__(self, row: Row, batch: Batch, inverse: Array, origin: complex) -> None:
        a, b = sorted(row.reaches[0], key=lambda end: end.body is not None)  # the plane first
        self._pair = batch.pair(a.body, b.body)
        self._inverse = [float(inverse[-1 if e.body is None else e.body]) for e in (a, b)]
        free = a.body is not None
        self._origin = (0.0, 0.0) if free else (origin.real, origin.imag)
        self._fixed = a.point.real, a.point.imag

    def solve(self, length: float, guess: float, drift: float) -> float:
        """Find the impulse that keeps a length [m] through a drift [s], and apply it [N s].

        Raises `ZeroDivisionError` if there is none: the ends meet, or Newton's method does not
        converge.
        """
        ax, ay, au, av, bx, by, bu, bv = self._pair.read()
        # differences first: far from the origin, sums of positions round more
        x = bx - ax - self._origin[0] - self._fixed[0]
        y = by - ay - self._origin[1] - self._fixed[1]
        far = hypot(x, y)
        inverse_a, inverse_b = self._inverse
        a_x, a_y = inverse_a * x / far, inverse_a * y / far
        b_x, b_y = inverse_b * x / far, inverse_b * y / far
        u, v, reply_x, reply_y = bu - au, bv - av, a_x + b_x, a_y + b_y
        impulse = guess
        for _ in range(MAX_ITERATIONS):
            to_x = x + drift * (u - impulse * reply_x)
            to_y = y + drift * (v - impulse * reply_y)
            reach = hypot(to_x, to_y)
            impulse += (reach - length) * reach / (drift * (to_x * reply_x + to_y * reply_y))
            if abs(reach - length) <= QUADRATIC:
                self._pair.set_velocity(
                    au + impulse * a_x, av + impulse * a_y, bu - impulse * b_x, bv - impulse * b_y
                )
                return impulse
        raise ZeroDivisionError
