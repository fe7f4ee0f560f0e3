"""A light, inextensible string over fixed pegs, which pymunk has not.

The unknown is one impulse along the string. It is chosen so that the string has its length *after
the next drift*, at position level, which is the constrained form of leapfrog (SHAKE; Ryckaert,
Ciccotti and Berendsen 1977):

    |x_a + h v_a − peg_a| + |x_b + h v_b − peg_b| − L = 0

by Newton's method, with the pull along the string's direction at the step. The impulse only ever
pulls: where the equation asks for a push the string is slack. Where there are contacts, last step's
pull acts from the start of the kick, so that their solver, which takes turns with the string, knows
of it.
"""

from itertools import pairwise
from math import hypot

import pymunk

from sandbox.model.shapes import XY
from sandbox.physics.errors import JointFailure

MAX_ITERATIONS = 20
TOLERANCE = 2e-15
"""How far the length may be off, relative to it: the rounding of its sum."""


class PulleyString:
    """The string between two bodies, as it is solved in a step.

    Attributes
    ----------
    tension
        The force with which the string pulled in the last kick [N].
    """

    def __init__(
        self, name: str, ends: tuple[pymunk.Body, pymunk.Body], pegs: tuple[XY, ...], length: float
    ) -> None:
        self._name = name
        self._a, self._b = ends
        self._peg_a, self._peg_b = pegs[0], pegs[-1]
        between = pairwise(pegs)
        self._free_length = length - sum(hypot(q[0] - p[0], q[1] - p[1]) for p, q in between)
        self._inverse_a, self._inverse_b = _inverse_mass(ends[0]), _inverse_mass(ends[1])
        self.tension = 0.0
        self._warm = 0.0  # the tension that has acted in this kick already
        self._kick = self._drift = 0.0

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        self._kick, self._drift = kick, drift

    def refit(self) -> None:
        """Take the present path as the string's length, as after a body was put elsewhere."""
        self._look()
        self._free_length = hypot(*self._arm_a) + hypot(*self._arm_b)
        self.tension = 0.0

    def gradient(self) -> tuple[XY, XY]:
        """Return how its length changes with the places of its ends."""
        self._look()
        return _direction(*self._arm_a), _direction(*self._arm_b)

    def _look(self) -> None:
        """See where the ends are, as seen from their pegs."""
        (x, y), (px, py) = self._a.position, self._peg_a
        self._arm_a = x - px, y - py
        (x, y), (px, py) = self._b.position, self._peg_b
        self._arm_b = x - px, y - py

    def warm_start(self) -> None:
        """Pull in this kick as in the one before, in the direction of now."""
        if not self.tension:
            return
        self._look()
        self._warm = self.tension
        for body, (x, y) in ((self._a, self._arm_a), (self._b, self._arm_b)):
            pull = self._warm / (hypot(x, y) or 1.0)
            body.apply_force_at_world_point((-x * pull, -y * pull), body.position)

    def solve(self) -> None:
        """Find the impulse that keeps the length through the next drift, and apply the rest."""
        self._look()
        a, b, h = self._a, self._b, self._drift
        (vax, vay), (vbx, vby) = a.velocity, b.velocity
        (ax, ay), (bx, by) = self._arm_a, self._arm_b
        try:
            # an end that nothing moves needs no direction: it may lie on its peg
            nax, nay = _unit(ax, ay) if self._inverse_a else (0.0, 0.0)
            nbx, nby = _unit(bx, by) if self._inverse_b else (0.0, 0.0)
            # where the ends will be is linear in the impulse
            ax, ay, bx, by = ax + h * vax, ay + h * vay, bx + h * vbx, by + h * vby
            impulse = self._newton((ax, ay, nax, nay), (bx, by, nbx, nby))
        except ZeroDivisionError:
            raise JointFailure(self._name, f"an end of '{self._name}' has run into a peg") from None
        if impulse:
            if self._inverse_a:
                per = impulse * self._inverse_a
                a.velocity = vax - per * nax, vay - per * nay
            if self._inverse_b:
                per = impulse * self._inverse_b
                b.velocity = vbx - per * nbx, vby - per * nby
        self.tension = self._warm + impulse / self._kick
        self._warm = 0.0

    def _newton(
        self,
        a: tuple[float, float, float, float],
        b: tuple[float, float, float, float],
    ) -> float:
        """Return the impulse beyond the warm start's, by Newton's method [N s]."""
        (ax, ay, nax, nay), (bx, by, nbx, nby) = a, b
        moves_a, moves_b = self._drift * self._inverse_a, self._drift * self._inverse_b
        impulse, least = 0.0, -self._warm * self._kick
        close = TOLERANCE * self._free_length
        for _ in range(MAX_ITERATIONS):
            x, y = ax - impulse * moves_a * nax, ay - impulse * moves_a * nay
            u, w = bx - impulse * moves_b * nbx, by - impulse * moves_b * nby
            reach_a, reach_b = hypot(x, y), hypot(u, w)
            excess = reach_a + reach_b - self._free_length
            if excess <= 0 and impulse <= least:
                return impulse
            slope = moves_a and moves_a * (x * nax + y * nay) / reach_a
            slope += moves_b and moves_b * (u * nbx + w * nby) / reach_b
            if slope <= 0:  # a pull would only lengthen the path: an end is past its peg
                raise ZeroDivisionError
            before, impulse = impulse, max(impulse + excess / slope, least)
            if abs(excess) <= close or impulse == before:
                return impulse
        raise JointFailure(self._name, f"no tension keeps '{self._name}' at its length")


def _inverse_mass(body: pymunk.Body) -> float:
    return 1 / body.mass if body.body_type == pymunk.Body.DYNAMIC else 0.0


def _direction(x: float, y: float) -> XY:
    """Return the unit vector; none where the end lies on its peg."""
    return _unit(x, y) if x or y else (0.0, 0.0)


def _unit(x: float, y: float) -> tuple[float, float]:
    size = hypot(x, y)
    return x / size, y / size
