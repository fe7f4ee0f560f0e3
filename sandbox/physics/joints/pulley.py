"""Pulleys: a light, inextensible string over fixed pegs, which pymunk does not have.

The unknown is one impulse along the string. It is chosen so that the string has its length *after
the next drift*, at position level, which is the constrained form of leapfrog (SHAKE; Ryckaert,
Ciccotti and Berendsen 1977):

    |x_a + h v_a − peg_a| + |x_b + h v_b − peg_b| − L = 0

by Newton's method, with the pull along the string's direction at the step. What a drift adds to an
arm r is written without a difference of lengths,

    |r + d| − |r| = (2 r + d) · d / (|r + d| + |r|),

so that it is known to the rounding of d, not of r: a length of 6 m, known to 1e-15, gives
4e-12 m/s² when it is differenced twice at 60 Hz. The present error of the length is the rounding of
places, and would be as noisy if it were taken back at once. Each step takes back a share of it.

The impulse only ever pulls: where the equation asks for a push, the string is slack. The solver of
contacts takes turns with the string. Where there are contacts, last step's pull therefore acts from
the start of the kick, so that the solver knows of it.
"""

from itertools import pairwise
from math import hypot

import pymunk

from sandbox.model.message import Message
from sandbox.model.shapes import XY
from sandbox.physics.engine.private_handles import Pair
from sandbox.physics.state.errors import JointFailure
from sandbox.physics.state.kick import Kick

MAX_ITERATIONS = 20

QUADRATIC = 1e-9
"""How far the length may be off, relative to it, for one more of Newton's steps to leave nothing
but rounding."""

ROUNDING = 2e-15
"""How far it may be off at a step by the rounding of places, relative to how far out they are."""

SHARE = 1 / 64
"""How much of that is taken back in a step."""


End = tuple[float, float, float, float, float, float, float]
"""Of an end: its arm from its peg and how long that is [m], its velocity [m/s], and what a unit of
impulse takes off that [1/kg]."""


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
        self._ends, self._pair = ends, Pair(*ends)
        self._pegs = pegs[0], pegs[-1]
        between = pairwise(pegs)
        self._free_length = length - sum(hypot(q[0] - p[0], q[1] - p[1]) for p, q in between)
        self._rounding = ROUNDING * (self._free_length + sum(hypot(*peg) for peg in self._pegs))
        self._inverse = _inverse_mass(ends[0]), _inverse_mass(ends[1])
        self.tension = 0.0
        self._warm_start = 0.0  # the tension that has acted in this kick already

    def refit(self) -> None:
        """Take the present path as the string's length, as after a body was put elsewhere."""
        self._free_length = sum(hypot(*arm) for arm in self._arms())
        self.tension = 0.0

    def jacobian(self) -> tuple[XY, XY]:
        """Return how its length changes with the places of its ends."""
        (ax, ay), (bx, by) = self._arms()
        far_a, far_b = hypot(ax, ay) or 1.0, hypot(bx, by) or 1.0
        return (ax / far_a, ay / far_a), (bx / far_b, by / far_b)

    def _arms(self) -> tuple[XY, XY]:
        """Return where the ends are, as seen from their pegs [m]."""
        ax, ay, _, _, bx, by, _, _ = self._pair.read()
        (peg_ax, peg_ay), (peg_bx, peg_by) = self._pegs
        return (ax - peg_ax, ay - peg_ay), (bx - peg_bx, by - peg_by)

    def warm_start(self, _kick: Kick) -> None:
        """Pull in this kick as in the one before, in the direction of now."""
        if not self.tension:
            return
        self._warm_start = self.tension
        for body, (x, y) in zip(self._ends, self.jacobian(), strict=True):
            body.apply_force_at_world_point(
                (-x * self._warm_start, -y * self._warm_start), body.position
            )

    def solve(self, kick: Kick) -> None:
        """Find the impulse that keeps the length through the next drift, and apply the rest."""
        ax, ay, ux, uy, bx, by, vx, vy = self._pair.read()
        (peg_ax, peg_ay), (peg_bx, peg_by) = self._pegs
        ax, ay, bx, by = ax - peg_ax, ay - peg_ay, bx - peg_bx, by - peg_by
        far_a, far_b = hypot(ax, ay), hypot(bx, by)
        try:
            # an end that nothing moves needs no direction: it may lie on its peg
            reply_a = self._inverse[0] and self._inverse[0] / far_a
            reply_b = self._inverse[1] and self._inverse[1] / far_b
            px, py, qx, qy = reply_a * ax, reply_a * ay, reply_b * bx, reply_b * by
            impulse = self._newton(
                kick, (ax, ay, far_a, ux, uy, px, py), (bx, by, far_b, vx, vy, qx, qy)
            )
        except ZeroDivisionError:
            raise JointFailure(
                self._name, Message("an end of '{name}' has run into a peg", name=self._name)
            ) from None
        if impulse:
            self._pair.set_velocity(
                ux - impulse * px, uy - impulse * py, vx - impulse * qx, vy - impulse * qy
            )
        self.tension = self._warm_start + impulse / kick.length
        self._warm_start = 0.0

    def _newton(self, kick: Kick, one: End, other: End) -> float:
        """Return the impulse beyond the warm start's, found by Newton's method [N s]."""
        (ax, ay, far_a, ux, uy, px, py), (bx, by, far_b, vx, vy, qx, qy) = one, other
        h, lasts, close = kick.drift, kick.length, QUADRATIC * self._free_length
        least = -self._warm_start * lasts
        off = far_a + far_b - self._free_length
        if -self._rounding <= off <= self._rounding:
            off *= SHARE
        impulse = self.tension * lasts + least
        for _ in range(MAX_ITERATIONS):
            # how far both drift, where to, and how long their arms are then
            dax, day = h * (ux - impulse * px), h * (uy - impulse * py)
            dbx, dby = h * (vx - impulse * qx), h * (vy - impulse * qy)
            tax, tay, tbx, tby = ax + dax, ay + day, bx + dbx, by + dby
            reach_a, reach_b = hypot(tax, tay) or 1.0, hypot(tbx, tby) or 1.0
            excess = off + ((ax + tax) * dax + (ay + tay) * day) / (far_a + reach_a)
            excess += ((bx + tbx) * dbx + (by + tby) * dby) / (far_b + reach_b)
            if excess <= 0 and impulse <= least:
                return impulse
            slope = h * ((tax * px + tay * py) / reach_a + (tbx * qx + tby * qy) / reach_b)
            if slope <= 0:  # a pull would only lengthen the path: an end is past its peg
                raise ZeroDivisionError
            before, impulse = impulse, impulse + excess / slope
            if impulse < least:
                impulse = least
            if -close <= excess <= close or impulse == before:
                return impulse
        raise JointFailure(
            self._name, Message("no tension keeps '{name}' at its length", name=self._name)
        )


def _inverse_mass(body: pymunk.Body) -> float:
    return 1 / body.mass if body.body_type == pymunk.Body.DYNAMIC else 0.0
