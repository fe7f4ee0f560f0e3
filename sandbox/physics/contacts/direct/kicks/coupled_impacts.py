"""The impacts of a step, solved together with the joints that take part."""

from collections.abc import Callable

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.prediction.convex_parts import Pair
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solving.newton_method import solve_rows
from sandbox.physics.contacts.direct.solving.redundant_contacts import without_held
from sandbox.physics.contacts.impacts.impact_outcome import ImpactOutcome
from sandbox.physics.contacts.impacts.pile_impacts import Pile
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.joints.exact.constraint_interface import (
    angles,
    coordinate_indices,
    translations,
)
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

ROUNDING = 1e-9
"""An approach below this share of the speeds of two bodies, and of the velocity change in a step,
is rounding."""

PRESSED = 1e-12
"""The same as a share of the velocity changes by all impulses on a body in a step, added up without
their signs."""

EXACT = 1e-12
"""This share of the work of impacts counts as rounding."""

HALVINGS = 50
"""The bisections in the search for the largest rebound that adds no energy."""


def striking(
    kick: Kick, approach: Array, acts: Array, change: Array, pushed: Callable[[], Array]
) -> Booleans:
    """Return which gaps close faster than forces within a step could cause: (k,).

    `approach`, (3 N,), are the velocities at the step; `acts` and `change`, (3 N,), are the
    velocity changes by forces in a step, and in the last step [m/s, rad/s]. `pushed` returns the
    impulses of a step, (r,): on a light body between heavy ones they cancel, but their rounding
    does not.
    """
    jacobian = kick.rows_at_start.jacobian[kick.layout.gaps]
    rates = np.array((approach, acts, change)).dot(jacobian.T)
    closing, (acting, changing) = rates[0], np.abs(rates[1:])
    if kick.closing_count:
        closing = np.where(kick.ahead, 0.0, closing)
    gives = np.maximum(acting, changing)
    far: Booleans = closing < -gives
    if not np.count_nonzero(far):  # bodies at rest need no closer look
        return far
    swift = np.abs(approach) + np.abs(acts)
    far = closing < -(gives + _rounding(kick, swift))
    if not np.count_nonzero(far):
        return far
    presses = PRESSED / ROUNDING * (np.abs(pushed()) @ np.abs(kick.response))
    allowed = gives + _rounding(kick, swift + presses)
    return np.asarray(closing < -allowed)


def _rounding(kick: Kick, swift: Array) -> Array:
    """Return the rounding errors of the gaps' rates, (k,), from the sizes of velocities, (3 N,)."""
    around = np.repeat(np.abs(translations(swift)), 2)  # rounding has no direction
    speeds = np.abs(kick.rows_at_start.jacobian[kick.layout.gaps]) @ np.append(
        around, angles(swift)
    )
    return np.asarray(ROUNDING * speeds + kick.velocity_rounding)


def approach_velocity(
    kick: Kick,
    motion: Array,
    strikes: Booleans,
    active: Active | None = None,
    catching: Booleans | None = None,
) -> tuple[Array, Array]:
    """Return the velocities at the step before its impacts, and the impulses up to then.

    `motion`, (3 N,), are the velocities without impulses [m/s, rad/s]. `strikes`, (k,), tells which
    gaps close, and `catching`, (m,), which joints catch; None for those just added. `active` are
    the rows that held in the kick until there, if they are known; else see `impulses`.
    """
    excluded = _left_out(kick, strikes | kick.ahead)
    excluded[kick.layout.joints] = kick.joints.added if catching is None else catching
    impulse = impulses(kick, motion, np.zeros(len(kick.response)), excluded, active)
    return motion + impulse @ kick.response, impulse


def solve_impacts(
    kick: Kick,
    approach: Array,
    strikes: Booleans,
    active: Active | None = None,
    rebounds: Array | None = None,
) -> tuple[Array, Array, list[Pair]]:
    """Return the velocities after the impacts of a step, their impulses, and the pairs.

    Newton's law of restitution ignores friction, and can add energy with it (Kane and Levinson
    1985). For wedged bodies there may be no impulses that separate them. In these cases the
    rebound is reduced to the largest share for which there are impulses that add no energy.

    `approach`, (3 N,), are the velocities before them [m/s, rad/s]; for `strikes` and `active` see
    `approach_velocity`. `rebounds`, (m,), are the coefficients of restitution of the joints that
    catch, 0 of all others; None if none rebounds. Raises `JointFailure` or `NoForces` if there are
    no impulses even without a rebound.
    """
    if kick.layout.in_sequence and np.count_nonzero(strikes):
        impulse, groups = _in_sequence(kick, approach)
    else:
        impulse = _together(_Rebound(kick, approach, strikes, active, rebounds))
        groups = [np.flatnonzero(strikes)]
    pairs = [pair for gaps in groups for pair in kick.layout.touching.pairs(gaps)]
    return approach + impulse @ kick.response, impulse, pairs


def _together(rebound: "_Rebound") -> Array:
    """Return the impulses of impacts that are solved all at once, (r,); see `solve_impacts`."""
    impulse = rebound.admissible_impulses(1.0, EXACT)
    if impulse is None:
        impulse = rebound.impulses(_largest(rebound) if rebound.rebound_rate.any() else 0.0)
    return impulse


def _in_sequence(kick: Kick, approach: Array) -> tuple[Array, list[Integers]]:
    """Return the impulses of impacts that come one after the other, (r,), and the gaps of each.

    Bilateral joints pass them on; ropes react to the velocities after them. See `Pile`.
    """
    layout, jacobian = kick.layout, kick.rows_at_start.jacobian
    impulse, takes = np.zeros(len(jacobian)), np.zeros(len(jacobian), dtype=bool)
    for rows, _, _ in layout.islands:
        takes[rows] = True
    near = np.flatnonzero(takes[layout.gaps] & ~kick.ahead)
    across = jacobian[near + layout.gaps.start]
    response = _through_joints(kick, kick.response[near + layout.gaps.start])
    partner = layout.touching.partner[near]
    pile = Pile(
        response @ across.T,
        across @ approach,
        _rounding(kick, np.abs(approach))[near],
        layout.restitution[near],
        np.where(partner < 0, -1, np.searchsorted(near, partner)),
    )
    impulse[near + layout.gaps.start] = pile.settle(layout.touching.bodies.T[near])
    takes[layout.joints], takes[layout.gaps] = False, True
    approach = approach + impulse @ kick.response
    impulse += impulses(kick, approach, np.zeros_like(impulse), takes)
    return impulse, [near[gaps] for gaps in pile.impact_groups]


def _through_joints(kick: Kick, response: Array) -> Array:
    """Return velocity changes, (k, 3 N), after bilateral joints have passed the impulses on."""
    free = kick.layout.problem.free
    jacobian, joint_response = kick.rows_at_start.jacobian[free], kick.response[free]
    impulses = np.linalg.solve(jacobian @ joint_response.T, jacobian @ response.T)
    return response - impulses.T @ joint_response


def _largest(rebound: "_Rebound") -> float:
    """Return the largest share, below 1, of a rebound that can be taken."""
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        fraction = (low + high) / 2
        low, high = (
            (low, fraction)
            if rebound.admissible_impulses(fraction, 0.0) is None
            else (fraction, high)
        )
    return low


class _Rebound:
    """Shares of the rebound after an impact; for the parameters see `solve_impacts`.

    `rebound_rate`, (r,), is minus the rate of each row after the whole rebound [m/s, rad/s].
    """

    def __init__(
        self,
        kick: Kick,
        approach: Array,
        strikes: Booleans,
        active: Active | None,
        rebounds: Array | None,
    ) -> None:
        self._kick, self._approach, self._guess = kick, approach, active
        layout, self._rates = kick.layout, kick.rows_at_start.jacobian @ approach
        self._slip_rates = self._rates.copy()
        self._slip_rates[layout.slips] += kick.belt_slip
        self.rebound_rate = np.zeros(len(kick.response))
        closing = np.minimum(self._rates[layout.gaps], 0.0)
        self.rebound_rate[layout.gaps] = layout.restitution * closing * strikes
        if rebounds is not None:
            closing = np.minimum(self._rates[layout.joints], 0.0)
            self.rebound_rate[layout.joints] = rebounds * closing
        self._excluded = _left_out(kick, kick.ahead)
        if active is not None:
            on = active.on.copy()
            on[layout.gaps] |= strikes
            self._guess = active._replace(on=on)

    def impulses(self, fraction: float) -> Array:
        """Return the impulses of a share of it: (r,)."""
        rebound_rate = fraction * self.rebound_rate
        return impulses(self._kick, self._approach, rebound_rate, self._excluded, self._guess)

    def admissible_impulses(self, fraction: float, rounding: float) -> Array | None:
        """Return the impulses of a share of it; None if there are none, or if they add energy.

        `rounding` is the share of their work that may be rounding.
        """
        try:
            impulse = self.impulses(fraction)
        except (JointFailure, NoForces):
            return None
        kick, touch = self._kick, self._kick.layout.touch
        after = self._slip_rates + kick.rows_at_start.jacobian @ (impulse @ kick.response)
        work = float(impulse[touch] @ (self._slip_rates + after)[touch]) / 2
        return impulse if work <= rounding * float(np.abs(impulse) @ np.abs(self._rates)) else None


def _left_out(kick: Kick, gaps: Booleans) -> Booleans:
    """Return the rows that take no part in an impact, (r,): those of some gaps, (k,), and more.

    A contact at a pin is among them: it would contradict the pin by rounding.
    """
    found, excluded = without_held(kick), np.zeros(len(kick.response), dtype=bool)
    excluded[kick.layout.gaps] = gaps | found[1] if found else gaps
    return excluded


def outcome(kick: Kick, velocity_after: Array, pushes: Array) -> ImpactOutcome:
    """Return the record of impacts, from the velocities after them, (3 N,), and impulses, (r,)."""
    indices = coordinate_indices(kick.response.shape[1] // 3 - 1)
    jump = (pushes @ kick.response)[indices]
    reached = np.zeros(len(jump), dtype=bool)
    for rows, _, _ in kick.layout.islands:
        if pushes[rows].any():
            reached |= kick.acts[rows].any(axis=0)
    jump = np.where(reached[:, None], jump, 0.0)
    return ImpactOutcome(reached, jump, velocity_after[indices], np.zeros(len(jump)))


def impulses(
    kick: Kick, motion: Array, rebound_rate: Array, excluded: Booleans, active: Active | None = None
) -> Array:
    """Return the impulses with which velocities satisfy all rows that take part: (r,).

    `motion`, (3 N,), are the velocities without them; `rebound_rate`, (r,), is minus the rate of
    each row with them [m/s, rad/s]. `excluded`, (r,), tells which rows take no part. `active` is a
    guess of which rows hold; if None, those that meet do, and no friction.
    """
    layout, joints = kick.layout, kick.layout.joints
    rate = kick.rows_at_start.jacobian @ motion + rebound_rate
    rate[joints] += kick.rates_now()
    rate[layout.slips] += kick.belt_slip
    slack = np.zeros(len(rate), dtype=bool)
    slack[joints] = kick.slack
    asked = layout.problem
    problem = asked._replace(free=asked.free & ~excluded, pushes=asked.pushes & ~excluded & ~slack)
    on = problem.free | (problem.pushes & (rate < 0 if active is None else active.on))
    slip = np.zeros(len(asked.friction.row), dtype=np.intp)
    if active is not None:
        on[layout.slips], slip = active.on[layout.slips], active.slip
    guess = Active(on, slip)
    return solve_rows(kick, layout.asking(problem), kick.rows_at_start.jacobian, rate, guess)[0]
