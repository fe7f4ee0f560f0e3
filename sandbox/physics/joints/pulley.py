"""Pulleys: a light, inextensible string over fixed pegs, which pymunk does not have.

The unknown is one impulse along the string. It is solved for so that the string has its length
*after the next drift*, at position level, which is the constrained form of leapfrog (SHAKE;
Ryckaert, Ciccotti and Berendsen 1977):

    |x_a + h v_a − peg_a| + |x_b + h v_b − peg_b| − L = 0

by Newton's method, with the pull along the string's direction at the step. The change of an arm r
by a drift d is written without a difference of lengths,

    |r + d| − |r| = (2 r + d) · d / (|r + d| + |r|),

so its error is the rounding of d, not of r: a length of 6 m, with an error of 1e-15, gives
4e-12 m/s² when it is differenced twice at 60 Hz. The present error of the length is the rounding of
positions. Its correction in one step would be as noisy, so each step corrects a fraction of it.

The impulse only pulls: where the equation needs a push, the string is slack. The solvers of
contacts and of the string alternate. Where there are contacts, the pull of the last step therefore
acts from the start of the kick, as a warm start that the solver of contacts takes into account.
"""

from itertools import pairwise
from math import fsum, hypot

import pymunk

from sandbox.model.shapes import XY
from sandbox.model.translatable_message import Message
from sandbox.physics.engine.pairs_of_bodies import pair_of
from sandbox.physics.state.kick_context import Kick
from sandbox.physics.state.simulation_errors import JointFailure

MAX_ITERATIONS = 20

QUADRATIC = 1e-9
"""The relative error of the length below which one more Newton step leaves only rounding."""

ROUNDING = 2e-15
"""The largest rounding error of the length, over the distances from the origin."""

SHARE = 1 / 64
"""The fraction of that error that is corrected in a step."""


class PulleyString:
    """The solver of a string between two bodies."""

    def __init__(
        self, name: str, ends: tuple[pymunk.Body, pymunk.Body], pegs: tuple[XY, ...], length: float
    ) -> None:
        self._name = name
        self._ends, self._pair = ends, pair_of(*ends)
        self._pegs = pegs[0], pegs[-1]
        between = pairwise(pegs)
        self._free_length = length - fsum(hypot(q[0] - p[0], q[1] - p[1]) for p, q in between)
        self._rounding = ROUNDING * (self._free_length + fsum(hypot(*peg) for peg in self._pegs))
        self._close = QUADRATIC * self._free_length
        self._inverse = _inverse_mass(ends[0]), _inverse_mass(ends[1])
        self.tension = 0.0
        """The force by which the string pulled in the last kick [N]."""
        self._warm_start = 0.0  # the tension that has acted in this kick already

    def refit(self) -> None:
        """Keep the present length of the path, as after a body was moved."""
        self._free_length = fsum(hypot(*arm) for arm in self._arms())
        self._close = QUADRATIC * self._free_length
        self.tension = 0.0

    def jacobian(self) -> tuple[XY, XY]:
        """Return the gradients of the length by the positions of the ends."""
        (ax, ay), (bx, by) = self._arms()
        far_a, far_b = hypot(ax, ay) or 1.0, hypot(bx, by) or 1.0
        return (ax / far_a, ay / far_a), (bx / far_b, by / far_b)

    def _arms(self) -> tuple[XY, XY]:
        """Return the positions of the ends relative to their pegs [m]."""
        ax, ay, _, _, bx, by, _, _ = self._pair.read()
        (peg_ax, peg_ay), (peg_bx, peg_by) = self._pegs
        return (ax - peg_ax, ay - peg_ay), (bx - peg_bx, by - peg_by)

    def warm_start(self, _kick: Kick) -> None:
        """Apply the tension of the last kick to this one, in the present direction."""
        if not self.tension:
            return
        self._warm_start = self.tension
        for body, (x, y) in zip(self._ends, self.jacobian(), strict=True):
            body.apply_force_at_world_point(
                (-x * self._warm_start, -y * self._warm_start), body.position
            )

    def solve(self, kick: Kick) -> None:
        """Find the impulse that keeps the length through the next drift, and apply the rest."""
        try:
            self._pull(kick)
        except ZeroDivisionError:
            raise JointFailure(
                self._name, Message("an end of '{name}' has run into a peg", name=self._name)
            ) from None

    def _pull(self, kick: Kick) -> None:
        """Apply the impulse beyond that of the warm start, found by Newton's method.

        The arms of the ends are (ax, ay) and (bx, by), their velocities (ux, uy) and (vx, vy); a
        unit of impulse decreases these by (px, py) and (qx, qy).
        """
        ax, ay, ux, uy, bx, by, vx, vy = self._pair.read()
        (peg_ax, peg_ay), (peg_bx, peg_by) = self._pegs
        ax, ay, bx, by = ax - peg_ax, ay - peg_ay, bx - peg_bx, by - peg_by
        far_a, far_b = hypot(ax, ay), hypot(bx, by)
        unit_a, unit_b = self._inverse  # a fixed end needs no direction: it may lie on its peg
        reply_a, reply_b = unit_a and unit_a / far_a, unit_b and unit_b / far_b
        px, py, qx, qy = reply_a * ax, reply_a * ay, reply_b * bx, reply_b * by
        h, duration, warm, close = kick.drift, kick.length, self._warm_start, self._close
        residual, least = far_a + far_b - self._free_length, -warm * duration
        if -self._rounding <= residual <= self._rounding:
            residual *= SHARE
        impulse = self.tension * duration + least
        for _ in range(MAX_ITERATIONS):
            # the displacements of both ends, and their arms after the drift
            dax, day = h * (ux - impulse * px), h * (uy - impulse * py)
            dbx, dby = h * (vx - impulse * qx), h * (vy - impulse * qy)
            tax, tay, tbx, tby = ax + dax, ay + day, bx + dbx, by + dby
            reach_a, reach_b = hypot(tax, tay) or 1.0, hypot(tbx, tby) or 1.0
            excess = residual + ((ax + tax) * dax + (ay + tay) * day) / (far_a + reach_a)
            excess += ((bx + tbx) * dbx + (by + tby) * dby) / (far_b + reach_b)
            if excess <= 0 and impulse <= least:
                break
            slope = h * ((tax * px + tay * py) / reach_a + (tbx * qx + tby * qy) / reach_b)
            if slope <= 0:  # a pull would only lengthen the path: an end is past its peg
                raise ZeroDivisionError
            before, impulse = impulse, impulse + excess / slope
            if impulse < least:
                impulse = least
            if -close <= excess <= close or impulse == before:
                break
        else:
            message = Message("no tension keeps '{name}' at its length", name=self._name)
            raise JointFailure(self._name, message)
        if impulse:
            change = self._pair.set_velocity
            change(ux - impulse * px, uy - impulse * py, vx - impulse * qx, vy - impulse * qy)
        self.tension, self._warm_start = warm + impulse / duration, 0.0


def _inverse_mass(body: pymunk.Body) -> float:
    return 1 / body.mass if body.body_type == pymunk.Body.DYNAMIC else 0.0
