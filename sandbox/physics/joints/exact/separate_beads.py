"""Beads alone on their wires, solved one by one in floats: in a quarter of the time of arrays.

The equation is that of `ExactJoints`, for a bead at z with the normal n of its wire at the step,

    d(z + h (v − λ n / m)) = 0,

where d is the signed distance from the wire.
"""

from sandbox.physics.engine.batch import Batch
from sandbox.physics.joints.exact.bead_on_wire import WireEquation
from sandbox.physics.joints.exact.constraint_interface import GROWS, MAX_ITERATIONS, QUADRATIC


class Bead:
    """Keeps a bead on its wire.

    Its equation is one of those in `separate_joints.are_apart`. `inverse` is the inverse mass of
    the bead [1/kg]. Points of the wire are relative to the origin [m].
    """

    def __init__(
        self, equation: WireEquation, batch: Batch, inverse: float, origin: complex
    ) -> None:
        self._wire, self._inverse, self._origin = equation, inverse, origin
        self._pair = batch.pair(equation.body, None)

    def solve(self, length: float, guess: float, drift: float) -> float:
        """Find the impulse that keeps the bead on its wire through a drift [s], and apply it [N s].

        The length is the distance from the wire to keep [m]. Raises `ZeroDivisionError` if there is
        no impulse: Newton's method does not converge, or its solution would add energy;
        `JointFailure` if the wire ends, or bends too sharply for a step.
        """
        x, y, u, v, *plane = self._pair.read()
        place, motion = complex(x, y) - self._origin, complex(u, v)
        reply = self._wire.near(place)[1] * self._inverse
        back = reply.conjugate()
        impulse = guess
        for _ in range(MAX_ITERATIONS):
            distance, normal = self._wire.near(place + drift * (motion - impulse * reply))
            impulse += (distance - length) / (drift * (back * normal).real)
            if abs(distance - length) <= QUADRATIC:
                break
        else:
            raise ZeroDivisionError
        moved = motion - impulse * reply
        if abs(moved) ** 2 > GROWS * abs(motion) ** 2 + (QUADRATIC / drift) ** 2:
            raise ZeroDivisionError
        self._pair.set_velocity(moved.real, moved.imag, plane[2], plane[3])
        return impulse
