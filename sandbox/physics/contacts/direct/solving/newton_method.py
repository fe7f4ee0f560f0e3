"""The impulses of a kick, by Newton's method over complementarity problems."""

from collections.abc import Callable
from math import inf
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.complementarity.mixed_complementarity import (
    Unsolvable,
    solve,
    solve_one,
)
from sandbox.physics.contacts.direct.complementarity.redundant_systems import max_abs
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Island, Layout
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.joints.exact.constraint_interface import MAX_ITERATIONS, QUADRATIC, Rows
from sandbox.physics.joints.exact.shake import TAUT
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

SOON = 5
"""The number of first iterations, far from the solution, in which redundant rows may disagree."""


def newton(
    kick: Kick,
    layout: Layout,
    rows: Callable[[Array], Rows],
    motion: Array,
    drift: float,
    wanted: Array,
    impulse: Array,
    active: Active,
) -> tuple[Array, Array, Active]:
    """Return impulses, (r,), the velocities with them, (3 N,), and the active rows.

    Each island is iterated until it has converged, independently of the others. `rows` returns the
    rows after a displacement, (3 N,) [m, rad]. Without impulses the velocities are `motion`, (3 N,)
    [m/s, rad/s]; the rows are to have the values `wanted`, (r,), at the end of the drift. `impulse`
    and `active` are the first guess.

    Raises `JointFailure` or `NoForces` if there is no solution.
    """
    rounds, left = _Rounds(), layout
    for iteration in range(MAX_ITERATIONS):
        displacement = drift * (motion + impulse.dot(kick.response))
        evaluated = rows(displacement) if np.count_nonzero(displacement) else kick.rows_at_start
        wrong, before = evaluated.total - wanted, (impulse, active)
        missed, rate, active_now = np.abs(wrong), wrong / drift, active
        far = active_now.on & (missed > QUADRATIC)
        off, lets = far if iteration < SOON else None, TAUT / drift
        found = solve_rows(
            kick, left, evaluated.jacobian, rate, active_now, impulse, lets=lets, off=off
        )
        impulse, active = found if left is layout else _with_settled(left, before, found)
        changed = far if active is active_now else _changes(layout, far, active, active_now)
        if not np.count_nonzero(changed):
            return impulse, motion + impulse.dot(kick.response), active
        left = layout.around(changed)
        if rounds.vain(active_now, max_abs(missed[active_now.on])):
            break
    raise failure(kick, int(np.where(active.on, missed, 0.0).argmax()))


def _with_settled(
    left: Layout, known: tuple[Array, Active], found: tuple[Array, Active]
) -> tuple[Array, Active]:
    """Return the new solution of the islands that are left, and the known one of the others."""
    (impulse, active), (solved, held) = known, found
    some = np.zeros(len(impulse), dtype=bool)
    for island in left.islands:
        some[island.rows] = True
    slip = np.where(some[left.slips], held.slip, active.slip)
    return np.where(some, solved, impulse), Active(np.where(some, held.on, active.on), slip)


def _changes(layout: Layout, far: Booleans, active: Active, active_now: Active) -> Booleans:
    """Return which rows are far from their targets, or whose activity has changed: (r,)."""
    changed = far | (active.on != active_now.on)
    changed[layout.slips] |= active.slip != active_now.slip
    return changed


class _Rounds:
    """Detects that Newton's method cycles: an active set returns, and its error has not halved.

    This was never seen in a run that converges.
    """

    def __init__(self) -> None:
        self._least: dict[bytes, float] = {}
        self._last = b""

    def vain(self, active: Active, missed: float) -> bool:
        """Record an active set and its largest error; return whether it repeats in vain."""
        key, least = active.key, self._least.get(active.key, inf)
        again = key != self._last and missed >= least / 2
        self._least[key], self._last = min(missed, least), key
        return again


def solve_rows(
    kick: Kick,
    layout: Layout,
    jacobian: Array,
    rate: Array,
    active: Active,
    impulse: Array | None = None,
    *,
    lets: float = inf,
    off: Booleans | None = None,
) -> tuple[Array, Active]:
    """Solve each island by itself; return the impulses, (r,), and the active rows.

    `jacobian`, (r, 3 N), is that of the rows, and `rate`, (r,), are their rates with `impulse`
    applied, or without impulses if it is None [m/s, rad/s]; `active` is the first guess. `lets` is
    how far redundant rows may disagree [m/s, rad/s]. There is no such limit in islands with a row
    that `off`, (r,), marks as far from its target; None marks no row. Raises `JointFailure` or
    `NoForces` if there is no solution.
    """
    if layout.hangs_together:
        allow = inf if off is not None and np.count_nonzero(off) else lets
        terms = _Terms(kick.response, jacobian, rate, impulse)
        return _solve_island(kick, layout.islands[0], terms, active, allow)
    found = np.zeros(len(rate))
    on, slip = np.zeros(len(rate), dtype=bool), np.zeros(len(active.slip), dtype=np.intp)
    if len(alone := layout.alone):
        each = np.full(len(alone), lets) if off is None else np.where(off[alone], inf, lets)
        found[alone], on[alone] = _solve_alone(kick, alone, jacobian, rate, impulse, each), True
    for island in layout.together:
        rows, slips, _ = island
        guess = Active(active.on.take(rows), active.slip.take(slips))
        allow = inf if off is not None and np.count_nonzero(off.take(rows)) else lets
        terms = _Terms(kick.response, jacobian, rate, impulse).of(rows)
        found[rows], island_active = _solve_island(kick, island, terms, guess, allow)
        on[rows], slip[slips] = island_active
    return found, Active(on, slip)


class _Terms(NamedTuple):
    """What the system of some rows follows from; see `solve_rows`."""

    response: Array
    jacobian: Array
    rate: Array
    impulse: Array | None

    def of(self, rows: Integers) -> "_Terms":
        """Return the terms of some of the rows."""
        impulse = None if self.impulse is None else self.impulse.take(rows)
        response, jacobian = self.response.take(rows, axis=0), self.jacobian.take(rows, axis=0)
        return _Terms(response, jacobian, self.rate.take(rows), impulse)


def _solve_island(
    kick: Kick, island: Island, terms: _Terms, guess: Active, lets: float
) -> tuple[Array, Active]:
    """Solve one island; see `solve_rows`."""
    rows, _, problem = island
    response, jacobian, free, impulse = terms
    delassus = jacobian.dot(response.T)
    if impulse is not None:
        free = free - delassus.dot(impulse)
    try:
        return solve(problem, delassus, free, guess, kick.velocity_rounding, lets)
    except Unsolvable as error:
        raise failure(kick, int(rows[error.row])) from None
    except np.linalg.LinAlgError:
        raise failure(kick, int(rows[0])) from None


def _solve_alone(
    kick: Kick,
    rows: Integers,
    jacobian: Array,
    rate: Array,
    impulse: Array | None,
    lets: Array,
) -> list[float]:
    """Solve joints that affect no other rows, each by itself; see `solve_rows`."""
    own = np.vecdot(jacobian.take(rows, axis=0), kick.response.take(rows, axis=0))
    free = rate.take(rows)
    if impulse is not None:
        free -= own * impulse.take(rows)
    found, blur = [], kick.velocity_rounding
    for row, *terms in zip(rows, own.tolist(), free.tolist(), lets.tolist(), strict=True):
        delassus, wrong, allowed = terms
        try:
            found.append(solve_one(delassus, wrong, blur, allowed))
        except Unsolvable:
            raise failure(kick, int(row)) from None
    return found


def failure(kick: Kick, row: int) -> JointFailure | NoForces:
    """Return the error for a row without a solution."""
    touching, gaps = kick.layout.touching, kick.layout.gaps
    if row < gaps.start:
        return kick.joints.failure(row)
    gap = row - gaps.start if row < gaps.stop else int(touching.friction_points[row - gaps.stop])
    return NoForces(*touching.bodies[:, gap].tolist())
