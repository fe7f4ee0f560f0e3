"""Which contacts push, stick or slip: a mixed complementarity problem.

Impulses x change the rates r of the rows, r = A x + w, where A = J M⁻¹ Jᵀ is the effective inverse
mass (the Delassus operator). Three kinds of rows ask for

    joints      r = 0
    contacts    x >= 0,  r >= 0,  x r = 0                        (and ropes, which only pull)
    friction    |x| <= b, with r = 0 where it is less than b, and against the slip where it is b

with b = mu (x of its contact). For a given set of active rows this is a linear system, solved
exactly. The set is taken from the step before and updated until every condition holds (a
primal-dual active set method: Hintermüller, Ito and Kunisch 2003; for contact problems Alart and
Curnier 1991). Where the updates cycle, Lemke's method takes over.

Rows may be redundant, as at the feet of a welded table: their forces are then not unique, only
their resultants. The smallest forces that contacts can give are taken.
"""

from math import inf, sqrt

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.active_set_update import ActiveSetResult
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active, Problem
from sandbox.physics.contacts.direct.complementarity.friction_bounds import FrictionBounds
from sandbox.physics.contacts.direct.complementarity.linear_complementarity import FAINT, by_lemke
from sandbox.physics.contacts.direct.complementarity.redundant_systems import (
    REPEATS,
    least_distance,
    max_abs,
    null,
    solved,
)
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.state.cancellation_points import cancellation_point

TOLERANCE = 1e-11
"""The tolerance of each condition, as a share of the largest impulse or rate."""

GUESSES = 5
"""The most updates of the active set before another method is tried. Where the first guess is
wrong in a pile, later ones rarely come right, and each takes as long as several pivots."""

FEW, HALF = 40, 0.5
"""These updates may change at most so many rows, or this share of all rows, whichever is more. In a
crash, where the updates take a third of the time, a guess that was further off never came right."""

MISSED = 1e-7
"""The tolerance of a solution by Lemke's method, as a share of the largest rate. Its many pivots
accumulate rounding, which the next step of Newton's method removes."""


CONTRADICTS = 1e-3
"""Redundant rows may contradict each other by this share of the largest rate: before Newton's
method has converged, they do."""

SOFT = (1e-11, 1e-9, 1e-7)
"""Compliances, as shares of each row's own inverse mass, that Lemke's method tries in turn: without
any, directions that only rounding leaves open would mislead it."""


class Unsolvable(Exception):  # noqa: N818 (the caller, who knows the bodies, tells it)
    """No impulses satisfy the rows; `row` is the one with the largest error."""

    def __init__(self, row: int) -> None:
        self.row = row
        super().__init__(f"row {row}")


def solve(
    problem: Problem,
    delassus: Array,
    rate: Array,
    guess: Active,
    blur: float = 0.0,
    lets: float = inf,
) -> tuple[Array, Active]:
    """Return the impulses, (m,) [N s or N m s], and the active rows.

    `delassus`, (m, m), is A above [1/kg or 1/(kg m²)], and `rate`, (m,), is w: the rates without
    impulses [m/s or rad/s]. `guess` has the active rows to begin with, `blur` is the rounding error
    of the rates, and `lets` is how far redundant rows may contradict each other, besides
    `CONTRADICTS` [m/s, rad/s]. Raises `Unsolvable` if no impulses satisfy the rows.
    """
    size = _sizes(delassus, problem.alike)
    own = delassus / (size[:, None] * size)
    scaled = _Scaled(problem, own, rate / size, size, blur / size, lets)
    impulse, active = scaled.solve(guess)
    return impulse / size, active


def solve_one(delassus: float, rate: float, blur: float, lets: float) -> float:
    """Return the impulse of a single row of a joint [N s or N m s]; for the parameters see `solve`.

    Raises `Unsolvable` if no impulse satisfies the row.
    """
    size = sqrt(delassus) if delassus > 0 else 1.0
    own, rate = delassus / (size * size), rate / size
    impulse = -rate / (own or 1.0)
    if abs(rate + own * impulse) <= min(CONTRADICTS * abs(rate), lets / size) + blur / size:
        return impulse / size
    raise Unsolvable(0)


def _sizes(delassus: Array, alike: Integers | None) -> Array:
    """Return the root of each row's inverse mass, averaged over the rows that are scaled alike."""
    own = delassus.diagonal()
    if alike is not None:
        own = np.maximum(own, 0.0)
        own = (np.bincount(alike, own) / np.maximum(np.bincount(alike), 1))[alike]
    return np.sqrt(np.where(own > 0, own, 1.0))


class _Scaled:
    """The problem, scaled to inverse masses of the rows near one."""

    def __init__(
        self,
        problem: Problem,
        delassus: Array,
        rate: Array,
        size: Array,
        blur: Array,
        lets: float,
    ) -> None:
        self._problem, self._rate, self._size, self._blur = problem, rate, size, blur
        self._lets = lets
        self._delassus = delassus
        self._friction = FrictionBounds(problem.friction, size)
        self._row = problem.friction.row
        self._pushing: list[int] = problem.pushes.nonzero()[0].tolist()
        self._settled = not (len(self._row) or self._pushing)  # joints alone
        self._largest = 0.0 if self._settled else max_abs(rate)
        self._circles: set[bytes] = set()  # active sets that are known to cycle

    @property
    def _asked(self) -> float:
        """The largest rate that impulses have to change; slack rows have none."""
        if self._settled:
            return max_abs(self._rate)
        return max_abs(np.where(self._problem.pushes, np.minimum(self._rate, 0.0), self._rate))

    def solve(self, active: Active) -> tuple[Array, Active]:
        """Return the impulses and the active rows."""
        impulse, found = self.mend(active)
        if found is None:
            impulse, found = self.mend(self._resting())
        return (impulse, found) if found is not None else self._by_lemke()

    def _resting(self) -> Active:
        """Return the active set of a pile at rest: all rows that take part.

        Without a guess, only the lowest layer approaches what is below it, and each update would
        add only one layer. Slack ropes, and contacts yet to strike, take no part in an impact.
        """
        on = self._problem.free | self._problem.pushes
        on[self._row] = True
        return Active(on, np.zeros(len(self._row), dtype=np.intp))

    def _by_lemke(self) -> tuple[Array, Active]:
        """Return the solution by Lemke's method."""
        tolerance = MISSED * self._asked + max_abs(self._blur)
        missed = self._missed(np.zeros_like(self._rate))
        bounds = self._friction.slipping_by_each()
        for soft in SOFT:
            rough = by_lemke(self._problem, self._delassus, self._rate, bounds, soft)
            if rough is None:
                continue
            guess = self._guess(rough)
            impulse, found = self.mend(guess)
            if found is not None:
                return impulse, found
            for tried in (self._with(guess)[0], rough):
                missed = self._missed(tried)
                largest = max_abs(tried)
                bounded = largest <= REPEATS * self._asked
                if bounded and missed.max() <= tolerance + FAINT * largest:
                    return tried, guess
        raise Unsolvable(int(np.argmax(missed)))

    def mend(self, active: Active) -> tuple[Array, Active | None]:
        """Return the impulses and the active rows, updated until all conditions hold.

        The rows are None if the updates cycle, or if the guess is far off. To share the impulses of
        redundant rows in another way changes no rate, so this is tried only if no further row has
        to become active.
        """
        seen: set[bytes] = set()
        left = max(FEW, HALF * len(self._rate))
        for _ in range(GUESSES):
            cancellation_point()
            impulse, repeats = self._with(active)
            rate = self._rate + self._delassus.dot(impulse)
            better = self._judge(impulse, rate, active)
            if better is not None and repeats and not np.count_nonzero(better.on > active.on):
                impulse = self._shared(impulse, active)
                rate = self._rate + self._delassus.dot(impulse)
                better = self._judge(impulse, rate, active)
            if better is None:
                return impulse, active if self._holds(rate, active) else None
            left -= active.changes(better)
            if left < 0 or better.key in seen or better.key in self._circles:
                self._circles |= seen
                break
            seen.add(better.key)
            active = better
        return impulse, None

    def _with(self, active: Active) -> tuple[Array, bool]:
        """Return the impulses, (m,), that keep the active rows, and whether any are redundant."""
        rows = active.on.nonzero()[0]
        if len(rows) == len(self._rate):
            return solved(self._delassus, -self._rate)
        impulse = np.zeros(len(self._rate))
        if not len(rows):
            return impulse, False
        if not np.count_nonzero(active.slip):
            matrix = self._delassus.take(rows, axis=0).take(rows, axis=1)
            impulse[rows], repeats = solved(matrix, -self._rate[rows])
            return impulse, repeats
        gives = self._friction.substitute_slip(active.slip)[:, rows]
        matrix = self._delassus.take(rows, axis=0).dot(gives)
        found, repeats = solved(matrix, -self._rate.take(rows))
        return gives.dot(found), repeats

    def _shared(self, impulse: Array, active: Active) -> Array:
        """Return the smallest equivalent impulses that contacts can give, (m,), of redundant rows.

        A least distance problem (Lawson and Hanson 1974, chapter 23); if it has no solution, the
        impulses stay as they are.
        """
        rows = np.flatnonzero(active.on)
        gives = self._friction.substitute_slip(active.slip)[:, rows]
        free = null(self._delassus[rows] @ gives)
        ways = gives @ free
        pushes = np.flatnonzero(self._problem.pushes & active.on)
        held = np.flatnonzero(active.on[self._row])
        unit, bounds = np.eye(len(impulse)), self._friction.sticking_by_each()[held]
        along = unit[self._row[held]]
        limits = np.concatenate((unit[pushes], bounds - along, bounds + along))
        way = least_distance(limits @ ways, -(limits @ impulse))
        return impulse if way is None else impulse + ways @ way

    def _holds(self, rate: Array, active: Active) -> bool:
        """Return whether the active rows are kept, and do not contradict each other."""
        off, blur = np.abs(rate), max_abs(self._blur)
        if off.item(off.argmax()) <= blur or not np.count_nonzero(active.on & ~(off <= blur)):
            return True  # nearly always
        allowed: Array | float = CONTRADICTS * self._asked
        if self._lets < inf:
            allowed = np.minimum(allowed, self._lets / self._size)
        return not np.count_nonzero(active.on & ~(off <= allowed + blur))

    def _judge(self, impulse: Array, rate: Array, active: Active) -> Active | None:
        """Return a better active set for these impulses and rates; None if this one is right."""
        if self._settled:
            return None
        close = TOLERANCE * max_abs(impulse)
        still = TOLERANCE * max(self._largest, max_abs(rate)) + self._blur
        found = ActiveSetResult.of(active, impulse, rate, close, still)
        return found.better(active, self._pushing, self._problem.friction, self._friction.sizes)

    def _guess(self, impulse: Array) -> Active:
        """Return the active set that approximate impulses suggest."""
        close = TOLERANCE * max_abs(impulse)
        on = self._problem.free | (self._problem.pushes & (impulse > close))
        slip = np.zeros(len(self._row), dtype=np.intp)
        if len(self._row):
            bound, own = self._friction.slipping(impulse), impulse[self._row]
            at_bound = (np.abs(own) >= bound * (1 - 1e-9)) & (bound > close)
            slip[at_bound] = np.sign(own[at_bound])
            on[self._row] = (bound > close) & ~at_bound
        return Active(on, slip)

    def _missed(self, impulse: Array) -> Array:
        """Return the residual of each row's condition: (m,).

        For a contact it is min(x, r). For friction it is the change of x by a projected step,
        clip(x - r, ±bound) - x. Both vanish exactly where the conditions hold.
        """
        rate = self._rate + self._delassus @ impulse
        missed = np.abs(np.where(self._problem.free, rate, np.minimum(impulse, rate)))
        missed[~(self._problem.free | self._problem.pushes)] = 0.0
        own, slip = impulse[self._row], rate[self._row]
        bounds = self._friction.sticking(impulse), self._friction.slipping(impulse)
        off = [np.abs(own - np.clip(own - slip, -bound, bound)) for bound in bounds]
        missed[self._row] = np.minimum(*off)
        return np.where(np.isfinite(missed), missed, np.inf)
