"""Rods, ropes, strings and pivots, solved together at position level.

Every joint contributes rows C(q) = 0 over the bodies' coordinates q = (x, y, θ). The impulses λ
along the rows' gradients at the step are chosen so that the rows hold *after the next drift*,

    C(q + h (v − M⁻¹ J(q)ᵀ λ)) = 0,

which is the constrained form of leapfrog (SHAKE; Ryckaert, Ciccotti and Berendsen 1977): second
order, time reversible, and the joints hold to rounding at every step. Newton's method solves the
rows together, so that a chain is as stiff with a heavy load at its end as without.

The plane is complex here: a point is x + iy, and dC = Re(conj(J) dz) + K dθ.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.anchor import Anchor, Plane
from sandbox.physics.batch import Batch
from sandbox.physics.errors import JointFailure

MAX_ITERATIONS = 25
QUADRATIC = 1e-8
"""m, below which one more of Newton's steps leaves nothing but rounding."""

TAUT = 1e-12
"""m, by which a rope that does not pull may be too long: the rounding of its length."""

SINGULAR = 1e-10
"""The smallest singular value, over the largest, of joints that do not repeat each other."""

TINY = 1e-300


@dataclass(frozen=True, slots=True)
class Row:
    """One equation between coordinates: a sum of lengths is a given length.

    Attributes
    ----------
    joint
        The name of the joint it belongs to.
    reaches
        The pieces whose lengths add up, each between two ends.
    length
        What they add up to [m].
    changing
        What is to be added to the length at a time [m]; None if it stays.
    pulls_only
        Whether the row may also be shorter, as a rope.
    along
        A direction of the plane: its component of the one reach counts instead of its length.
    """

    joint: str
    reaches: Sequence[tuple[Anchor, Anchor]]
    length: float
    changing: Callable[[float], float] | None = None
    pulls_only: bool = False
    along: complex | None = None


class ExactJoints:
    """All exact joints of a scene, as they are solved in a step; n bodies, m rows.

    Attributes
    ----------
    tension
        (m,), the force along each row in the last kick [N]; positive where it pulls.
    """

    def __init__(
        self, rows: Sequence[Row], batch: Batch, inverse_mass: Array, inverse_moment: Array
    ) -> None:
        self._batch = batch
        # one body more: the plane itself, which nothing moves
        self._inverse_mass = np.append(inverse_mass, 0.0)
        self._inverse_moment = np.append(inverse_moment, 0.0)
        self._joints = [row.joint for row in rows]
        self._length = np.array([row.length for row in rows])
        self._changing = [(i, row.changing) for i, row in enumerate(rows) if row.changing]
        self._pulls_only = np.array([row.pulls_only for row in rows])
        self._unilateral = bool(self._pulls_only.any())
        self._shape = (len(rows), len(self._inverse_mass))
        self._lay_out(rows)
        self._fresh = True
        self._taut = ~self._pulls_only
        self.tension = self._guess = np.zeros(len(rows))
        self._warm = np.zeros(len(rows))  # impulses that have acted in this kick already
        self._kick = self._drift = 0.0

    def _lay_out(self, rows: Sequence[Row]) -> None:
        """Note which reach belongs to which row, and where its ends go in the gradients."""
        count = self._shape[1]
        reaches = [(i, a, b) for i, row in enumerate(rows) for a, b in row.reaches]
        self._row = np.array([i for i, _, _ in reaches])
        self._a, self._point_a = _ends([a for _, a, _ in reaches], count)
        self._b, self._point_b = _ends([b for _, _, b in reaches], count)
        self._offset = self._point_b - self._point_a
        self._into = np.concatenate((self._row * count + self._b, self._row * count + self._a))
        self._apart = len(np.unique(self._into)) == len(self._into)
        self._single = len(reaches) == len(rows)
        self._along = np.array([rows[i].along or 0j for i, _, _ in reaches])
        self._component = self._along != 0
        self._has_components = bool(self._component.any())
        levers = np.abs(self._point_a) * self._inverse_moment[self._a]
        levers += np.abs(self._point_b) * self._inverse_moment[self._b]
        bodies = np.concatenate((self._a, self._b))
        points = np.concatenate((self._point_a, self._point_b))
        # without a lever a point that is off the centre still needs the angle, once it is not 0
        self._turns = bool(levers.any() or points[bodies < count - 1].any())

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        self._kick, self._drift = kick, drift

    def refit(self, t: float) -> None:
        """Take the present lengths as those that hold from a time on [s]."""
        place, _ = self._coordinates()
        self._length = np.zeros_like(self._length)
        self._length = self._look(place).total - self._lengths(t)
        self.tension = self._guess = np.zeros_like(self._length)
        self._taut = ~self._pulls_only
        self._fresh = True

    def pull(self, wrench: Array) -> None:
        """Add to the forces of a kick what the joints pulled in the last: (n, 3) [N, N m]."""
        place, _ = self._coordinates()
        here = self._look(place)
        self._warm = self.tension * self._kick
        pulled = self.tension @ here.gradient
        wrench[:, 0] -= pulled.real[:-1]
        wrench[:, 1] -= pulled.imag[:-1]
        if here.turning is not None:
            wrench[:, 2] -= (self.tension @ here.turning)[:-1]

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
        with np.errstate(all="ignore"):  # what is not finite never converges, and is told by name
            place, motion = self._coordinates()
            here = self._look(place)
            reply = _Reply(
                here.gradient * self._inverse_mass,
                None if here.turning is None else here.turning * self._inverse_moment,
            )
            length = self._lengths(until)
            if self._fresh:
                self._check_independent(here, reply, length)
            impulse, moved = self._settle(place, motion, reply, length)
        velocity = np.empty((len(moved.plane) - 1, 3))
        velocity[:, 0], velocity[:, 1] = moved.plane.real[:-1], moved.plane.imag[:-1]
        velocity[:, 2] = moved.angle[:-1]
        self._batch.set_velocity(velocity)
        before, self.tension = self.tension, (self._warm + impulse) / self._kick
        self._guess = 2 * self.tension - before
        self._warm = np.zeros_like(impulse)

    def _lengths(self, t: float) -> Array:
        if not self._changing:
            return self._length
        length = self._length.copy()
        for i, changing in self._changing:
            length[i] += changing(t)
        return length

    def _coordinates(self) -> tuple["_Coordinates", "_Coordinates"]:
        """Return where everything is and how it moves, the plane itself last."""
        state = self._batch.state()
        plane = np.zeros((len(state) + 1, 2), dtype=complex)
        plane[:-1].view(float)[:] = state[:, (0, 1, 3, 4)]
        angle = np.zeros((len(state) + 1, 2))
        angle[:-1] = state[:, (2, 5)]
        return _Coordinates(plane[:, 0], angle[:, 0]), _Coordinates(plane[:, 1], angle[:, 1])

    def _look(self, place: "_Coordinates") -> "_Rows":
        """Return what the rows add up to somewhere, and their gradients there."""
        reach = place.plane[self._b] - place.plane[self._a]
        if self._turns:
            turn = np.exp(1j * place.angle)
            arm_a, arm_b = self._point_a * turn[self._a], self._point_b * turn[self._b]
            reach += arm_b - arm_a
        else:
            reach += self._offset
        length = np.abs(reach)
        unit = reach / np.maximum(length, TINY)
        if self._has_components:
            unit = np.where(self._component, self._along, unit)
            length = np.where(self._component, (reach * self._along.conj()).real, length)
        gradient = self._scatter(unit, -unit)
        total: Array = length
        if not self._single:
            total = np.bincount(self._row, length, self._shape[0]).astype(float)
        if not self._turns:
            return _Rows(total, gradient, None)
        lever = unit.conj() * 1j
        turning = self._scatter((lever * arm_b).real, -(lever * arm_a).real)
        return _Rows(total, gradient, turning)

    def _scatter(self, of_b: NDArray[Any], of_a: NDArray[Any]) -> NDArray[Any]:
        """Put what belongs to the ends of the reaches in the rows' columns of their bodies."""
        into = np.zeros(self._shape, dtype=of_b.dtype)
        both = np.concatenate((of_b, of_a))
        if self._apart:
            into.reshape(-1)[self._into] = both
        else:
            np.add.at(into.reshape(-1), self._into, both)
        return into

    def _check_independent(self, here: "_Rows", reply: "_Reply", length: Array) -> None:
        """Refuse rows that repeat each other at the start, as far as they are taut."""
        self._fresh = False
        taut = np.flatnonzero(here.total - length > -1e-9)
        slope = reply.answers(here)[np.ix_(taut, taut)]
        scale = np.sqrt(slope.diagonal())
        if (scale == 0).any():
            raise self._overlapping(int(taut[np.argmin(scale)]))
        _, sizes, directions = np.linalg.svd(slope / np.outer(scale, scale))
        if len(taut) and sizes[-1] < SINGULAR * sizes[0]:
            shares = np.flatnonzero(np.abs(directions[-1]) > 1e-3)
            raise self._overlapping(int(taut[shares[-1]]))

    def _settle(
        self, place: "_Coordinates", motion: "_Coordinates", reply: "_Reply", length: Array
    ) -> tuple[Array, "_Coordinates"]:
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
        self, place: "_Coordinates", motion: "_Coordinates", reply: "_Reply", length: Array
    ) -> tuple[Array, "_Coordinates", Array]:
        """Return the impulses of the taut rows, the motion after them, and all rows' excess."""
        taut, h = self._taut, self._drift
        impulse = np.where(taut, self._guess * self._kick, 0.0) - self._warm
        for _ in range(MAX_ITERATIONS):
            moved = reply.to(impulse, motion)
            there = self._look(
                _Coordinates(
                    place.plane + h * moved.plane,
                    place.angle + h * moved.angle if self._turns else place.angle,
                )
            )
            excess = there.total - length
            wrong = np.where(taut, excess, 0.0) if self._unilateral else excess
            slope = reply.answers(there)
            if self._unilateral:
                slope[~taut] = 0.0
                slope[~taut, ~taut] = 1.0
            try:
                impulse = impulse + _solved(slope, wrong) / h
            except np.linalg.LinAlgError:
                raise self._overlapping(int(np.argmin(np.abs(slope).sum(axis=1)))) from None
            if np.abs(wrong).max() <= QUADRATIC:
                return impulse, reply.to(impulse, motion), excess
        raise self._lost(int(np.argmax(np.abs(wrong))))

    def _lost(self, row: int) -> JointFailure:
        name = self._joints[row]
        reason = f"nothing keeps '{name}' as it is through the next step; take a higher 'rate'"
        return JointFailure(name, reason)

    def _overlapping(self, row: int) -> JointFailure:
        name = self._joints[row]
        reason = f"'{name}' holds what is held already, or cannot hold it; leave it out"
        return JointFailure(name, reason)


class _Coordinates(NamedTuple):
    """Places or velocities of all bodies: (n + 1,) each, in the complex plane and turned."""

    plane: Plane
    angle: Array


class _Rows(NamedTuple):
    """What rows add up to (m,), and their gradients (m, n + 1) in the plane and in the angles."""

    total: Array
    gradient: Plane
    turning: Array | None


class _Reply(NamedTuple):
    """How the bodies answer a unit impulse of each row: (m, n + 1)."""

    plane: Plane
    angle: Array | None

    def to(self, impulse: Array, motion: _Coordinates) -> _Coordinates:
        """Return the motion after impulses along the rows; a positive one pulls."""
        return _Coordinates(
            motion.plane - impulse @ self.plane,
            motion.angle if self.angle is None else motion.angle - impulse @ self.angle,
        )

    def answers(self, rows: _Rows) -> Array:
        """Return how fast each row shortens by a unit impulse of each: (m, m)."""
        slope: Array = (rows.gradient.conj() @ self.plane.T).real
        if rows.turning is not None and self.angle is not None:
            slope += rows.turning @ self.angle.T
        return slope


def _solved(slope: Array, excess: Array) -> Array:
    """Solve a linear system; one equation in a tenth of the time."""
    if len(excess) == 1:
        return excess / slope[0]
    return np.linalg.solve(slope, excess).astype(float, copy=False)


def _ends(anchors: Sequence[Anchor], count: int) -> tuple[NDArray[np.intp], Plane]:
    bodies = [count - 1 if anchor.body is None else anchor.body for anchor in anchors]
    return np.array(bodies), np.array([anchor.point for anchor in anchors])
