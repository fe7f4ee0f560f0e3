"""Exact joints, solved together at position level.

Every joint contributes equations C(q) = 0 over the bodies' coordinates q = (x, y, θ). The impulses
λ along the rows of their Jacobian at the step are chosen so that they hold *after the next drift*,

    C(q + h (v − M⁻¹ J(q)ᵀ λ)) = 0,

which is the constrained form of leapfrog (SHAKE; Ryckaert, Ciccotti and Berendsen 1977): second
order, time reversible, and the joints hold to rounding at every step. Newton's method solves the
equations together, so that a chain is as stiff with a heavy load at its end as without.
"""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Batch, Booleans
from sandbox.physics.joints.exact.banded import FEWEST, Banded
from sandbox.physics.joints.exact.constraints import (
    MAX_ITERATIONS,
    QUADRATIC,
    Coordinates,
    Equation,
    Rows,
    inertia_of,
    kinetic_energy,
    order,
    planes,
)
from sandbox.physics.joints.exact.distances import Reaches, Row
from sandbox.physics.joints.exact.equations import Equations
from sandbox.physics.joints.exact.separate_rods import Rod, are_apart
from sandbox.physics.joints.exact.solvability import independence, solved, steps_needed
from sandbox.physics.state.errors import JointFailure

MOMENT = 1e-3
"""The share of a drift over which directions are followed, before and after a step: its square is
nothing, and what it is divided by not yet rounding."""

TAUT = 1e-12
"""m, by which a rope that does not pull may be too long: the rounding of its length."""

SINGULAR = 1e-10
"""The smallest singular value, over the largest, of joints that do not repeat each other."""

LOCKED = 0.1
"""The same, over what it was at the start, of joints that have come to work against each other."""

GROWS = 1.1
"""How many times its kinetic energy a kick may leave with joints, of what it would leave without
them: they give none but for what a step is too long for. Seen are 1.06 where errors are of second
order, and 4 and more where Newton's method has come to another solution."""

Number = TypeVar("Number", float, Array)


class ExactJoints:
    """All exact joints of a scene, as they are solved in a step; n bodies, m equations.

    Sums of lengths, the rows, are looked at together; the other equations one by one.

    Parameters
    ----------
    rows, others
        The equations, whose points of the plane are counted from the origin.
    batch
        Reads and writes the bodies.
    inverse_mass, inverse_moment
        (n,), 0 of what nothing moves or turns [1/kg, 1/(kg m²)].
    origin
        From where places are counted [m].

    Attributes
    ----------
    tension
        (m,), the force along each row in the last kick [N]; positive where it pulls.
    parts
        How many kicks a step has: the same one of the steps before tells what to expect of each.
    inverse
        (3 N,), one over the mass or moment of each coordinate, the plane's last.
    bodies
        Those that each equation is about; the plane is the last of all, or −1.
    origin
        From where places are counted [m].
    alike
        (m,), the first of the equations of its joint, or of those of them that keep an angle: each
        its own. What a pin keeps it keeps along two axes.
    added
        (m,), which equations have joined since the last kick.
    kick, drift
        How long the next kick lasts, and the drift that follows it [s].
    """

    def __init__(
        self,
        rows: Sequence[Row],
        others: Sequence[Equation],
        batch: Batch,
        inverse_mass: Array,
        inverse_moment: Array,
        origin: complex = 0j,
    ) -> None:
        self._batch, self.origin = batch, origin
        # one body more: the plane itself, which nothing moves
        self._inverse_moment = np.append(inverse_moment, 0.0)
        self.inverse = np.concatenate(
            (np.repeat(inverse_mass, 2), (0.0, 0.0), self._inverse_moment)
        )
        self._inertia = inertia_of(self.inverse)
        self._order = order(len(inverse_mass))
        start = 3 * len(self._inverse_moment)
        self._of_state = np.concatenate((self._order, self._order + start), axis=1).ravel()
        self._lay_out(rows, others)
        self._length = np.array([equation.length for equation in (*rows, *others)])
        self._taut = ~self._pulls_only
        self.bodies = self._equations.bodies(self.place())
        self.added = np.zeros_like(self._taut)
        self.tension = np.zeros_like(self._length)
        self.parts = 1
        self._past: list[Array] = []  # the tensions of the last kicks without impacts, newest first
        self._warm_start = self._cold  # impulses that have acted in this kick already
        self._struck = False
        self.kick = self.drift = 0.0

    def _lay_out(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Make the tables of all equations, and of how they are solved."""
        self._equations = equations = Equations(rows, others, self._inverse_moment)
        self._joints, self.alike = equations.names, equations.alike
        self._pulls_only = equations.pulls_only
        self._unilateral = bool(self._pulls_only.any())
        self._cold = np.zeros(len(self._joints))
        inverse = self.inverse[: 2 * len(self._inverse_moment) : 2]
        apart = rows if are_apart(equations.all, inverse) else ()
        self._rods = [Rod(row, self._batch, inverse, self.origin) for row in apart]
        self._band = self._banded(len(self._joints))
        self._fresh = True
        self._independence = 1.0  # the smallest singular value over the largest, at the start

    def _banded(self, count: int) -> Banded | None:
        """Return the equations as a band, where there are many and each meets but a few."""
        if count < FEWEST or self._equations.others or self._unilateral:
            return None
        band = Banded(self.reaches, count, self.inverse)
        return band if band.pays else None

    def add(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Take on more equations; what they stop at once is an impact, over with the next kick."""
        old = self._equations
        where = [len(old.rows)] * len(rows) + [len(self._length)] * len(others)
        lengths = [equation.length for equation in (*rows, *others)]
        self._length = np.insert(self._length, where, lengths)
        self._taut = np.insert(self._taut, where, values=True)
        self.tension = np.insert(self.tension, where, 0.0)
        self._past = [np.insert(tension, where, 0.0) for tension in self._past]
        self._warm_start = np.insert(self._warm_start, where, 0.0)
        self.added = np.insert(np.zeros_like(self.added), where, values=True)
        self._lay_out((*old.rows, *rows), (*old.others, *others))
        self.bodies = self._equations.bodies(self.place())
        self._struck = True

    def drop(self, name: str) -> None:
        """Let go of what a joint holds."""
        stay = np.array([joint != name for joint in self._joints], dtype=bool)
        old = self._equations
        rows = [row for row in old.rows if row.joint != name]
        others = [equation for equation in old.others if equation.joint != name]
        self._length, self._taut = self._length[stay], self._taut[stay]
        self.tension, self.added = self.tension[stay], self.added[stay]
        self._past = []  # the others hold with other forces from now on
        self._lay_out(rows, others)
        self._warm_start = self._cold
        self.bodies = self._equations.bodies(self.place())

    @property
    def plain(self) -> bool:
        """Whether all are sums of lengths that stay as they are, and are solved together."""
        return not (
            self._equations.others or self._equations.changing or self._unilateral or self._rods
        )

    @property
    def reaches(self) -> Reaches:
        """The pieces whose lengths add up."""
        return self._equations.reaches

    @property
    def past(self) -> list[Array]:
        """The forces of the last kicks without impacts, newest first: (m,) each [N]."""
        return self._past

    def expected(self) -> tuple[Array, Booleans]:
        """Return the forces that the next kick is likely to need, and what of it holds: (m,)."""
        last = self._past[0] if self._past else self._cold
        return np.where(self._taut, last, 0.0), self._taut

    def check(self) -> None:
        """Refuse equations that repeat each other, where that has not been looked at yet.

        Raises
        ------
        JointFailure
            If some do.
        """
        if self._fresh and self._joints:
            here = self._equations.glance(self.place())
            self._check_independent(here, here.jacobian * self.inverse, self._length)

    def take(self, tension: Array, taut: Booleans, *, struck: bool) -> None:
        """Take up the forces of a kick that was solved elsewhere, and what held in it: (m,).

        After an impact they tell nothing of the next kick.
        """
        self.tension, self._taut = tension, taut
        last = self._past[: 3 * self.parts - 1]
        self._past = [] if struck else [tension, *last]
        self._struck, self._fresh = False, False
        self.added = np.zeros_like(taut)

    def place(self) -> Coordinates:
        """Return where everything is."""
        return self.coordinates()[0]

    def at(self, place: Array) -> Coordinates:
        """Return a place, (n, 3), as the equations have it: counted from the origin."""
        found = _coordinates(place)
        found.plane[:-1] -= self.origin
        return found

    @property
    def names(self) -> Sequence[str]:
        """The joint that each equation is of: (m,)."""
        return self._joints

    def force(self, name: str) -> float:
        """Return the force with which a joint pulled in the last kick [N]."""
        rows = self._equations.pulling[name]
        if len(rows) == 1:
            return self.tension.item(rows[0])
        return float(np.hypot(*self.tension[rows]))

    def torque(self, name: str) -> float:
        """Return the torque of a joint on its second body in the last kick [N m].

        0 of one that keeps no angle, or is solved elsewhere.
        """
        return -float(sum(self.tension[row] for row in self._equations.turning.get(name, ())))

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        self.kick, self.drift = kick, drift

    def refit(self, t: float) -> None:
        """Take the present lengths as those that hold from a time on [s]."""
        place, _ = self.coordinates()
        self._length = np.zeros_like(self._length)
        self._length = self.look(place).total - self.lengths(t)
        self.tension = np.zeros_like(self._length)
        self._past = []
        self._taut = ~self._pulls_only
        self._fresh = True

    def go_on(self, t: float) -> None:
        """Take what is driven to have turned at a time as far as it has [s]."""
        rows = len(self._equations.rows)
        driven = [i for i, _ in self._equations.changing if i >= rows]
        if driven:
            off = self.look(self.place()).total - self.lengths(t)
            self._length[driven] += off[driven]

    def warm_start(self, wrench: Array) -> None:
        """Add to the forces of a kick what the joints pulled in the last: (n, 3) [N, N m]."""
        steady = self._past[0] if self._past else self.tension
        self._warm_start = steady * self.kick
        wrench += self.wrenches(steady, self.place())

    def wrenches(self, tension: Array, place: Coordinates) -> Array:
        """Return what forces along the rows (m,) are to the bodies somewhere: (n, 3) [N, N m]."""
        return -(tension @ self.look(place).jacobian)[self._order]

    def stiff(self, place: Array | None = None) -> Array:
        """Return the Jacobian of what can push as well as pull, as below: (m, n, 3)."""
        return self.jacobian(place)[~self._pulls_only]

    def jacobian(self, place: Array | None = None) -> Array:
        """Return how the rows change with the places and angles of the bodies: (m, n, 3).

        Where they are, or if they were at a place: (n, 3). Whoever asks leaves the run as it is.
        """
        here = self._equations.glance(self.place() if place is None else self.at(place))
        return here.jacobian[:, self._order]

    @property
    def pulls_only(self) -> Booleans:
        """Which rows can only pull: (m,)."""
        return self._pulls_only

    @property
    def changes(self) -> Booleans:
        """Which rows are of a length that changes with time: (m,)."""
        return self._equations.changes

    def motion(self, mean: Array, smooth: Array) -> tuple[Array, Array]:
        """Return velocities and accelerations where the bodies are, and take up the forces there.

        The mean of the velocities before and after a kick has a part of second order across the
        joints; without it J v = 0, as in RATTLE (Andersen 1983). A force of SHAKE is a mean over a
        kick, and of second order as well; that which acts at the step itself keeps J v = 0 on:

            J (a − M⁻¹ Jᵀ λ) + (dJ/dt) v = 0.

        Not for joints that change with time.

        Parameters
        ----------
        mean
            (n, 3), of the velocities [m/s, rad/s].
        smooth
            (n, 3), the accelerations by all else [m/s², rad/s²].
        """
        place, _ = self.coordinates()
        if self._band:
            return self._move_band(self._band, place, _coordinates(mean), _coordinates(smooth))
        jacobian = self._equations.glance(place).jacobian
        response = jacobian * self.inverse
        delassus, free = jacobian @ response.T, _coordinates(mean).values
        moves = free - solved(delassus, jacobian @ free) @ response
        way = MOMENT * abs(self.drift) * moves
        ahead, behind = (self._equations.glance(Coordinates(place.values + w)) for w in (way, -way))
        turning = (ahead.jacobian - behind.jacobian) @ moves / (2 * MOMENT * abs(self.drift))
        driven = _coordinates(smooth).values
        self.tension = solved(delassus, jacobian @ driven + turning)
        return moves[self._order], (driven - self.tension @ response)[self._order]

    def _move_band(
        self, band: Banded, place: Coordinates, mean: Coordinates, smooth: Coordinates
    ) -> tuple[Array, Array]:
        """Return the same where the equations are a band."""
        here, free, driven = band.look(place), mean.values, smooth.values
        moves = free - band.response(here, band.solved(here, here, band.along(here, free)))
        way = MOMENT * abs(self.drift) * moves
        ahead, behind = (band.look(Coordinates(place.values + w)) for w in (way, -way))
        turning = band.along(ahead, moves) - band.along(behind, moves)
        needed = band.along(here, driven) + turning / (2 * MOMENT * abs(self.drift))
        self.tension = band.solved(here, here, needed)
        return moves[self._order], (driven - band.response(here, self.tension))[self._order]

    def hold(self, place: Array, velocity: Array, acceleration: Array) -> Array:
        """Return the forces with which the joints would hold through a drift from elsewhere: (m,).

        Ropes stay slack or taut, and what changes with time pulls on as it did.

        Parameters
        ----------
        place, velocity
            (n, 3), where the drift would start [m, rad, m/s, rad/s].
        acceleration
            (n, 3), the accelerations by all else [m/s², rad/s²].

        Raises
        ------
        JointFailure
            If there are none.
        """
        if not self._joints:
            return self.tension
        half = self.drift / 2
        begin = self.at(place)
        with np.errstate(all="ignore"):  # what is not finite never converges, and is told by name
            impulse, _, _ = self._newton(
                begin,
                _coordinates(velocity + acceleration * half),
                self.look(begin).jacobian * self.inverse,
                self._length,
                self.tension * half,
                ~self._taut | self.changes,
            )
        return np.where(self._pulls_only, np.maximum(impulse, 0.0), impulse) / half

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
        apart = self._rods and not self._fresh
        self.tension = self._solve_apart(until) if apart else self._solve_together(until)
        last = self._past[: 3 * self.parts - 1]
        self._past = self._past[:1] if self._struck else [self.tension, *last]
        self._struck = False
        self._warm_start = self._cold
        self.added = np.zeros_like(self._taut)

    def _solve_apart(self, until: float) -> Array:
        """Solve one equation after the other, in floats; return the forces along them: (m,) [N]."""
        past = [tension.tolist() for tension in self._past[self.parts - 1 :: self.parts]]
        warm_start, length, found = self._warm_start.tolist(), self.lengths(until).tolist(), []
        for i, rod in enumerate(self._rods):
            expected = parabola([tension[i] for tension in past]) if past else 0.0
            guess = expected * self.kick - warm_start[i]
            try:
                impulse = rod.solve(length[i], guess, self.drift)
            except ZeroDivisionError:
                raise self.lost(i) from None
            found.append((warm_start[i] + impulse) / self.kick)
        return np.array(found)

    def _solve_together(self, until: float) -> Array:
        """Solve all equations at once; return the forces along them: (m,) [N]."""
        if self._band and not self._fresh:
            return self._solve_band(self._band, until)
        place, motion = self.coordinates()
        here = self.look(place)
        response = here.jacobian * self.inverse
        length = self.lengths(until)
        if self._fresh:
            self._check_independent(here, response, length)
        impulse, moved = self._settle(place, motion, response, length)
        free = motion.values + self._warm_start @ response
        work = -(self._warm_start + impulse) * (here.jacobian @ (free + moved))
        self.refuse_gain(free, moved, work)
        self._batch.set_velocity(moved[self._order])
        return (self._warm_start + impulse) / self.kick

    def _solve_band(self, band: Banded, until: float) -> Array:
        """Solve all equations as a band; return the forces along them: (m,) [N]."""
        place, motion = self.coordinates()
        here, length = band.look(place), self.lengths(until)
        try:
            impulse, moved, wrong = band.held(
                place, motion, here, length, self._guess(), self.drift
            )
        except np.linalg.LinAlgError:
            raise self.lost(0) from None
        if not wrong.dot(wrong) <= QUADRATIC**2:
            raise self.lost(int(np.argmax(np.abs(wrong))))
        free = motion.values + band.response(here, self._warm_start)
        work = -(self._warm_start + impulse) * band.along(here, free + moved)
        self.refuse_gain(free, moved, work)
        self._batch.set_velocity(moved[self._order])
        return (self._warm_start + impulse) / self.kick

    def _guess(self) -> Array:
        """Return the impulses that are still to be expected in this kick: (m,) [N s]."""
        past = self._past[self.parts - 1 :: self.parts]
        return (parabola(past) if past else self._cold) * self.kick - self._warm_start

    def refuse_gain(self, free: Array, moved: Array, work: Array) -> None:
        """Refuse a kick in which joints give energy, unless lengths change or a body is kinematic.

        Parameters
        ----------
        free, moved
            (3 N,), the velocities without their impulses, and with them [m/s, rad/s].
        work
            (m,), of each row, or as much as it [J].

        Raises
        ------
        JointFailure
            If they do; it names the one that gave most.
        """
        rounding = float(self._inertia.sum()) * (QUADRATIC / self.drift) ** 2 / 2
        if self._driven(free):
            return
        if self.kinetic(moved) > GROWS * self.kinetic(free) + rounding:
            raise self.lost(int(np.argmax(work)))

    def kinetic(self, motion: Array) -> float:
        """Return the kinetic energy of velocities (3 N,) [J]."""
        return float(kinetic_energy(self._inertia, motion))

    def lengths(self, t: float) -> Array:
        """Return what each equation keeps at a time [s]: (m,) [m, rad]."""
        return self._equations.lengths(self._length, t)

    def coordinates(self) -> tuple[Coordinates, Coordinates]:
        """Return where everything is and how it moves, the plane itself last."""
        values = np.zeros((2, len(self.inverse)))
        values.reshape(-1)[self._of_state] = self._batch.state().reshape(-1)
        if self.origin:
            planes(values[0])[:-1] -= self.origin
        return Coordinates(values[0]), Coordinates(values[1])

    def look(self, place: Coordinates) -> Rows:
        """Return what the rows add up to somewhere, and their Jacobian there."""
        return self._equations.look(place)

    def _check_independent(self, here: Rows, response: Array, length: Array) -> None:
        """Refuse rows that repeat each other at the start, as far as they are taut."""
        self._fresh = False
        taut = np.flatnonzero(here.total - length > -1e-9)
        if not len(taut):
            return
        delassus = (here.jacobian @ response.T)[np.ix_(taut, taut)]
        if not delassus.diagonal().all():
            raise self._overlapping(int(taut[np.argmin(delassus.diagonal())]))
        self._independence, shares = independence(delassus)
        if self._independence < SINGULAR:
            raise self._overlapping(int(taut[np.flatnonzero(shares > 1e-3)[-1]]))

    def _settle(
        self, place: Coordinates, motion: Coordinates, response: Array, length: Array
    ) -> tuple[Array, Array]:
        """Solve, and let go of ropes that would have to push, until none is left."""
        guess = self._guess()
        for _ in range(MAX_ITERATIONS):
            slack = ~self._taut if self._unilateral else None
            start = guess if slack is None else np.where(slack, -self._warm_start, guess)
            impulse, moved, violation = self._newton(place, motion, response, length, start, slack)
            if not self._unilateral:
                return impulse, moved
            pushes = self._pulls_only & self._taut & (self._warm_start + impulse < 0)
            stretched = ~self._taut & (violation > TAUT)
            if not (pushes.any() or stretched.any()):
                return impulse, moved
            self._taut = (self._taut & ~pushes) | stretched
        raise self.lost(int(np.argmax(self._pulls_only)))

    def _newton(
        self,
        place: Coordinates,
        motion: Coordinates,
        response: Array,
        length: Array,
        impulse: Array,
        slack: Booleans | None,
    ) -> tuple[Array, Array, Array]:
        """Return the impulses, the velocities after them, and by how much all rows are violated.

        They are found from a guess; those of the slack rows stay. (`dot` of few numbers takes half
        of what `@` takes.)
        """
        h = self.drift
        for _ in range(MAX_ITERATIONS):
            moved = motion.values - impulse.dot(response)
            there = self.look(Coordinates(place.values + h * moved))
            violation = there.total - length
            wrong, delassus = violation, there.jacobian.dot(response.T)
            if slack is not None and slack.any():
                wrong = np.where(slack, 0.0, violation)
                delassus[slack] = 0.0
                delassus[slack, slack] = 1.0
            try:
                impulse = impulse + solved(delassus, wrong) / h
            except np.linalg.LinAlgError:
                raise self._overlapping(int(np.argmin(np.abs(delassus).sum(axis=1)))) from None
            if wrong.dot(wrong) <= QUADRATIC**2:
                return impulse, motion.values - impulse.dot(response), violation
        raise self.lost(int(np.argmax(np.abs(wrong))))

    def lost(self, row: int) -> JointFailure:
        """Say why there is no solution: the joints work against each other, or the step is long."""
        place, motion = self.coordinates()
        here, taut = self.look(place), np.flatnonzero(self._taut)
        delassus = self._delassus(here)[np.ix_(taut, taut)]
        finer = self._finer(place)
        if delassus.any() and np.isfinite(delassus).all():
            free, shares = independence(delassus)
            if free < LOCKED * self._independence:
                name = self._joints[taut[np.argmax(shares)]]
                reason = (
                    f"'{name}' and the joints beside it are stretched: none gives way in a step"
                )
                return JointFailure(name, reason, None if self._driven(motion.values) else finer)
        name = self._joints[row]
        reason = f"nothing keeps '{name}' as it is through the next step"
        return JointFailure(name, reason, finer)

    def _driven(self, motion: Array) -> bool:
        """Whether lengths change, or a kinematic body moves."""
        return bool(self._equations.changing) or bool(motion[self.inverse == 0].any())

    def _delassus(self, here: Rows) -> Array:
        """Return how fast each row shortens by a unit impulse of each: (m, m)."""
        return np.asarray(here.jacobian * self.inverse @ here.jacobian.T)

    def _finer(self, place: Coordinates) -> float:
        """Return how many times as many steps joints under this tension need, at least 2."""
        tension = np.zeros(len(self._length))  # of what has just stuck, none is known yet
        tension[: len(self.tension)] = self.tension

        def force(by: Array) -> Array:
            there = self._equations.glance(Coordinates(place.values + by))
            return np.asarray(tension @ there.jacobian)

        return steps_needed(force, self.inverse, self.drift)

    def parting(self) -> tuple[str, float]:
        """Return the joint that is furthest from what it keeps, and by how much [m, rad]."""
        place, _ = self.coordinates()
        off = self._equations.glance(place).total - self._length
        off = np.where(self._pulls_only, np.maximum(off, 0.0), np.abs(off))
        off[self.changes] = 0.0  # what they keep now is not known any more
        if not len(off):
            return "", 0.0
        worst = int(off.argmax())
        return self._joints[worst], float(off[worst])

    def _overlapping(self, row: int) -> JointFailure:
        name = self._joints[row]
        reason = f"'{name}' holds what is held already, or cannot hold it; leave it out"
        return JointFailure(name, reason)


def _coordinates(rows: Array) -> Coordinates:
    """Return places or velocities (n, 3) as equations have them, the plane itself last."""
    values = np.zeros(3 * len(rows) + 3)
    values[order(len(rows))] = rows
    return Coordinates(values)


def parabola(past: list[Number]) -> Number:
    """Return what comes next: on the parabola through the last three, newest first, or fewer."""
    match past:
        case [last, before, first]:
            return 3 * (last - before) + first
        case [last, before]:
            return 2 * last - before
    return past[0]
