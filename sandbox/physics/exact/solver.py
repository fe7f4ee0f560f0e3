"""Exact joints, solved together at position level.

Every joint contributes equations C(q) = 0 over the bodies' coordinates q = (x, y, θ). The impulses
λ along their gradients at the step are chosen so that they hold *after the next drift*,

    C(q + h (v − M⁻¹ J(q)ᵀ λ)) = 0,

which is the constrained form of leapfrog (SHAKE; Ryckaert, Ciccotti and Berendsen 1977): second
order, time reversible, and the joints hold to rounding at every step. Newton's method solves the
equations together, so that a chain is as stiff with a heavy load at its end as without.
"""

from collections.abc import Sequence
from copy import copy

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.batch import Batch, Booleans
from sandbox.physics.errors import JointFailure
from sandbox.physics.exact.equations import Condition, Coordinates, Equation, Reply, Rows
from sandbox.physics.exact.reaches import Reaches, Row
from sandbox.physics.exact.turning import Turn

MAX_ITERATIONS = 25
QUADRATIC = 1e-8
"""m, below which one more of Newton's steps leaves nothing but rounding."""

PLANE, ANGLE = np.array([0, 1, 3, 4]), np.array([2, 5])
"""The columns of a state that are places and velocities in the plane, and in the angle."""

TAUT = 1e-12
"""m, by which a rope that does not pull may be too long: the rounding of its length."""

SINGULAR = 1e-10
"""The smallest singular value, over the largest, of joints that do not repeat each other."""


LOCKED = 0.1
"""The same, over what it was at the start, of joints that have come to work against each other."""


class ExactJoints:
    """All exact joints of a scene, as they are solved in a step; n bodies, m equations.

    Sums of lengths, the rows, are looked at together; the other equations one by one.

    Attributes
    ----------
    tension
        (m,), the force along each row in the last kick [N]; positive where it pulls.
    """

    def __init__(
        self,
        rows: Sequence[Row],
        others: Sequence[Equation],
        batch: Batch,
        inverse_mass: Array,
        inverse_moment: Array,
    ) -> None:
        self._batch = batch
        # one body more: the plane itself, which nothing moves
        self._inverse_mass = np.append(inverse_mass, 0.0)
        self._inverse_moment = np.append(inverse_moment, 0.0)
        self._lay_out(rows, others)
        self._length = np.array([equation.length for equation in (*rows, *others)])
        self._taut = ~self._pulls_only
        self.tension = self._steady = self._guess = np.zeros_like(self._length)
        self._warm = np.zeros_like(self._length)  # impulses that have acted in this kick already
        self._struck = False
        self._kick = self._drift = 0.0

    def _lay_out(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Make the tables of all equations, the rows first."""
        equations: tuple[Condition, ...] = (*rows, *others)
        self._equations = rows, others
        self._joints = [equation.joint for equation in equations]
        self._turn = np.array([isinstance(equation, Turn) for equation in equations], dtype=bool)
        self._changing = [(i, e.changing) for i, e in enumerate(equations) if e.changing]
        self._pulls_only = np.array([e.pulls_only for e in equations], dtype=bool)
        self._unilateral = bool(self._pulls_only.any())
        shape = (len(equations), len(self._inverse_mass))
        self._reaches = Reaches(rows, shape, self._inverse_moment, turns=bool(others))
        self._turns = self._reaches.turns
        self._others = list(enumerate(others, len(rows)))
        self._fresh = True
        self._independence = 1.0  # the smallest singular value over the largest, at the start

    def add(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Take on more equations; what they stop at once is an impact, over with the next kick."""
        old_rows, old_others = self._equations
        where = [len(old_rows)] * len(rows) + [len(self._length)] * len(others)
        lengths = [equation.length for equation in (*rows, *others)]
        self._length = np.insert(self._length, where, lengths)
        self._taut = np.insert(self._taut, where, values=True)
        self._steady = self._guess = np.insert(self._steady, where, 0.0)
        self._warm = np.insert(self._warm, where, 0.0)
        self._lay_out((*old_rows, *rows), (*old_others, *others))
        self._struck = True

    def place(self) -> Coordinates:
        """Return where everything is."""
        return self._coordinates()[0]

    def force(self, name: str) -> float:
        """Return the force with which a joint pulled in the last kick [N]."""
        parts = self.tension[self._of(name) & ~self._turn]
        return float(parts[0] if len(parts) == 1 else np.hypot(*parts))

    def torque(self, name: str) -> float:
        """Return the torque of a joint on its second body in the last kick [N m]."""
        return -float(self.tension[self._of(name) & self._turn].sum())

    def _of(self, name: str) -> NDArray[np.bool_]:
        return np.array([joint == name for joint in self._joints])

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        self._kick, self._drift = kick, drift

    def refit(self, t: float) -> None:
        """Take the present lengths as those that hold from a time on [s]."""
        place, _ = self._coordinates()
        self._length = np.zeros_like(self._length)
        self._length = self._look(place).total - self._lengths(t)
        self.tension = self._steady = self._guess = np.zeros_like(self._length)
        self._taut = ~self._pulls_only
        self._fresh = True

    def pull(self, wrench: Array) -> None:
        """Add to the forces of a kick what the joints pulled in the last: (n, 3) [N, N m]."""
        place, _ = self._coordinates()
        here = self._look(place)
        self._warm = self._steady * self._kick
        pulled = self._steady @ here.gradient
        wrench[:, 0] -= pulled.real[:-1]
        wrench[:, 1] -= pulled.imag[:-1]
        if here.turning is not None:
            wrench[:, 2] -= (self._steady @ here.turning)[:-1]

    def stiff(self) -> Array:
        """Return the gradients of what can push as well as pull: (m, n, 3)."""
        return self.gradients()[~self._pulls_only]

    def gradients(self) -> Array:
        """Return how the rows change with the places and angles of the bodies: (m, n, 3)."""
        place, _ = self._coordinates()
        here = self._look(place)
        plane = here.gradient[:, :-1]
        turning = np.zeros(plane.shape) if here.turning is None else here.turning[:, :-1]
        return np.stack((plane.real, plane.imag, turning), axis=2)

    @property
    def pulls_only(self) -> Booleans:
        """Which rows can only pull: (m,)."""
        return self._pulls_only

    @property
    def changes(self) -> Booleans:
        """Which rows are of a length that changes with time: (m,)."""
        changes = np.zeros(len(self._length), dtype=bool)
        changes[[row for row, _ in self._changing]] = True
        return changes

    def solve(self, until: float) -> None:
        """Find the impulses that keep the joints through the next drift, and apply them.

        Parameters
        ----------
        until
            The time at the end of that drift [s].

        Raises
        ------
        JointFailure
            If there are none: the joints contradict or repeat each other, or the step is too long
            for what they carry.
        """
        if not self._joints:
            return
        with np.errstate(all="ignore"):  # what is not finite never converges, and is told by name
            place, motion = self._coordinates()
            here = self._look(place)
            reply = self._reply(here)
            length = self._lengths(until)
            if self._fresh:
                self._check_independent(here, reply, length)
            impulse, moved = self._settle(place, motion, reply, length)
        velocity = np.empty((len(moved.plane) - 1, 3))
        velocity[:, 0], velocity[:, 1] = moved.plane.real[:-1], moved.plane.imag[:-1]
        velocity[:, 2] = moved.angle[:-1]
        self._batch.set_velocity(velocity)
        self.tension = (self._warm + impulse) / self._kick
        self._guess = self._steady
        if not self._struck:
            self._guess, self._steady = 2 * self.tension - self._steady, self.tension
        self._struck = False
        self._warm = np.zeros_like(impulse)

    def _lengths(self, t: float) -> Array:
        if not self._changing:
            return self._length
        length = self._length.copy()
        for i, changing in self._changing:
            length[i] += changing(t)
        return length

    def _coordinates(self) -> tuple[Coordinates, Coordinates]:
        """Return where everything is and how it moves, the plane itself last."""
        state = self._batch.state()
        plane = np.zeros((len(state) + 1, 2), dtype=complex)
        plane[:-1].view(float)[:] = state.take(PLANE, axis=1)
        angle = np.zeros((len(state) + 1, 2))
        angle[:-1] = state.take(ANGLE, axis=1)
        return Coordinates(plane[:, 0], angle[:, 0]), Coordinates(plane[:, 1], angle[:, 1])

    def _look(self, place: Coordinates) -> Rows:
        """Return what the rows add up to somewhere, and their gradients there."""
        rows = self._reaches.look(place)
        for row, equation in self._others:
            rows.total[row], shares = equation.look(place)
            for body, plane, angle in shares:
                rows.gradient[row, body] += plane
                if rows.turning is not None:
                    rows.turning[row, body] += angle
        return rows

    def _reply(self, here: Rows) -> Reply:
        return Reply(
            here.gradient * self._inverse_mass,
            None if here.turning is None else here.turning * self._inverse_moment,
        )

    def _check_independent(self, here: Rows, reply: Reply, length: Array) -> None:
        """Refuse rows that repeat each other at the start, as far as they are taut."""
        self._fresh = False
        taut = np.flatnonzero(here.total - length > -1e-9)
        if not len(taut):
            return
        slope = reply.answers(here)[np.ix_(taut, taut)]
        if not slope.diagonal().all():
            raise self._overlapping(int(taut[np.argmin(slope.diagonal())]))
        self._independence, shares = _weakest(slope)
        if self._independence < SINGULAR:
            raise self._overlapping(int(taut[np.flatnonzero(shares > 1e-3)[-1]]))

    def _settle(
        self, place: Coordinates, motion: Coordinates, reply: Reply, length: Array
    ) -> tuple[Array, Coordinates]:
        """Solve, and let go of ropes that would have to push, until none is left."""
        for _ in range(MAX_ITERATIONS):
            impulse, moved, excess = self._newton(place, motion, reply, length)
            if not self._unilateral:
                return impulse, moved
            pushes = self._pulls_only & self._taut & (self._warm + impulse < 0)
            stretched = ~self._taut & (excess > TAUT)
            if not (pushes.any() or stretched.any()):
                return impulse, moved
            self._taut = (self._taut & ~pushes) | stretched
        raise self._lost(int(np.argmax(self._pulls_only)))

    def _newton(
        self, place: Coordinates, motion: Coordinates, reply: Reply, length: Array
    ) -> tuple[Array, Coordinates, Array]:
        """Return the impulses of the taut rows, the motion after them, and all rows' excess."""
        h = self._drift
        slack = None if self._taut.all() else ~self._taut
        impulse = self._guess * self._kick - self._warm
        if slack is not None:
            impulse[slack] = -self._warm[slack]
        for _ in range(MAX_ITERATIONS):
            moved = reply.to(impulse, motion)
            there = self._look(
                Coordinates(
                    place.plane + h * moved.plane,
                    place.angle + h * moved.angle if self._turns else place.angle,
                )
            )
            excess = there.total - length
            wrong, slope = excess, reply.answers(there)
            if slack is not None:
                wrong = np.where(slack, 0.0, excess)
                slope[slack] = 0.0
                slope[slack, slack] = 1.0
            try:
                impulse = impulse + _solved(slope, wrong) / h
            except np.linalg.LinAlgError:
                raise self._overlapping(int(np.argmin(np.abs(slope).sum(axis=1)))) from None
            if np.abs(wrong).max() <= QUADRATIC:
                return impulse, reply.to(impulse, motion), excess
        raise self._lost(int(np.argmax(np.abs(wrong))))

    def _lost(self, row: int) -> JointFailure:
        """Say why there is no solution: the joints work against each other, or the step is long."""
        place, _ = self._coordinates()
        here, taut = self._look(place), np.flatnonzero(self._taut)
        slope = self._reply(here).answers(here)[np.ix_(taut, taut)]
        if slope.any() and np.isfinite(slope).all():
            independence, shares = _weakest(slope)
            if independence < LOCKED * self._independence:
                name = self._joints[taut[np.argmax(shares)]]
                reason = f"'{name}' and the joints beside it are stretched: none can give way"
                return JointFailure(name, reason)
        name = self._joints[row]
        needed, now = self._needed(), 1 / self._drift
        reason = (
            f"nothing keeps '{name}' as it is through the next step;"
            f" take a higher 'rate': {needed:,.0f}, not {now:g}"
        )
        return JointFailure(name, reason, needed)

    def _needed(self) -> float:
        """Return the rate at which joints under this tension should hold [Hz].

        A taut chain swings across with up to ω² = 2 T (1/m_a + 1/m_b) / l; ω dt should be 1/2.
        """
        place, _ = self._coordinates()
        here = self._look(place)
        replies = self._reply(here).answers(here).diagonal()
        with np.errstate(all="ignore"):
            square = 2 * np.abs(self.tension) * replies / np.abs(here.total)
        square = square[np.isfinite(square)]
        omega = float(np.sqrt(square.max(initial=0.0)))
        return float(np.ceil(max(2 * omega, 2 / self._drift)))

    def parting(self) -> tuple[str, float]:
        """Return the joint that is furthest from what it keeps, and by how much [m, rad]."""
        place, _ = self._coordinates()
        total = self._reaches.look(place).total
        for row, equation in self._others:
            total[row], _ = copy(equation).look(place)  # who only looks leaves no trace
        off = total - self._length
        off = np.where(self._pulls_only, np.maximum(off, 0.0), np.abs(off))
        off[[row for row, _ in self._changing]] = 0.0  # what they keep now is not known any more
        if not len(off):
            return "", 0.0
        worst = int(off.argmax())
        return self._joints[worst], float(off[worst])

    def _overlapping(self, row: int) -> JointFailure:
        name = self._joints[row]
        reason = f"'{name}' holds what is held already, or cannot hold it; leave it out"
        return JointFailure(name, reason)


def _weakest(slope: Array) -> tuple[float, Array]:
    """Return the smallest singular value over the largest, and each row's share in it.

    Every row counts as if it alone moved its bodies by one.
    """
    scale = np.sqrt(slope.diagonal())
    _, sizes, directions = np.linalg.svd(slope / np.outer(scale, scale))
    return float(sizes[-1] / sizes[0]), np.abs(directions[-1])


def _solved(slope: Array, excess: Array) -> Array:
    """Solve a linear system; one equation in a tenth of the time."""
    if len(excess) == 1:
        return excess / slope[0]
    return np.linalg.solve(slope, excess).astype(float, copy=False)
