"""The warm start of a kick: forces and active rows of the last ones.

While the same rows are active and their forces change smoothly, the next forces are extrapolated by
a parabola through the last three. Newton's method then converges in its first iteration.
"""

from collections import Counter
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.complementarity.redundant_systems import max_abs
from sandbox.physics.contacts.direct.rows.contact_points import ContactPoints
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Layout
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.joints.exact.shake import parabola

SMOOTH = 0.5
"""Forces change smoothly if their second difference is at most this share of their last change.
Forces that jump to and fro would be extrapolated further off, and may lead to another solution."""

AT_REST = 1e-9
"""m/s, the largest slip velocity at which friction of a new contact sticks."""


Key = tuple[int, int, int, int]
"""The two bodies, the lower index first, which of their contacts it is, and which of its points."""


class LastKick(NamedTuple):
    """The outcome of a kick, for the next one: its layout, forces, (r,) [N], and active rows."""

    layout: Layout
    forces: Array
    active: Active

    @property
    def tension(self) -> Array:
        """The forces of the joints: (m,) [N]."""
        return self.forces[self.layout.joints]

    @property
    def force(self) -> Array:
        """The forces at the gaps: (k,) [N]."""
        return self.forces[self.layout.gaps]


class WarmStart:
    """Remembers a kick for the next one."""

    def __init__(self) -> None:
        self._known: LastKick | None = None
        self._past: list[Array] = []  # the forces since the same rows hold, (r,) [N], newest first

    def forget(self) -> None:
        """Forget everything."""
        self._known, self._past = None, []

    def note(self, kick: Kick, forces: Array, active: Active) -> None:
        """Remember the forces of a kick, (r,) [N], and its active rows."""
        before_last, self._known = self._known, LastKick(kick.layout, forces, active)
        same = (
            before_last and before_last.layout is kick.layout and before_last.active.equals(active)
        )
        self._past = [forces, *self._past[:2]] if same else [forces]

    def guess(self, kick: Kick, motion: Array, length: float) -> tuple[Array, Active]:
        """Return a guess of the impulses of a kick, (r,), and of its active rows.

        New contacts are active if they approach, and slip if their surfaces do. `motion`, (3 N,),
        are the velocities without impulses [m/s, rad/s], and `length` is that of the kick [s].
        """
        if last := self._recalled(kick):
            return self._expected() * length, last.active
        force, along, on, slip = self._new(kick, motion)
        tension, taut = kick.joints.expected()
        if self._known and len(self._known.tension) == len(tension):
            tension = self._known.tension
        impulse = np.concatenate((tension, force, along)) * length
        if not len(slip):
            return impulse, Active(np.concatenate((taut, on)), slip)
        contact, first = kick.layout.problem.friction.contact, kick.layout.gaps.start
        presses = (on[contact - first * (contact >= 0)] & (contact >= 0)).any(axis=0)
        slip = np.where(presses, slip, 0)
        return impulse, Active(np.concatenate((taut, on, presses & (slip == 0))), slip)

    @property
    def last_two(self) -> tuple[LastKick, Array] | None:
        """The last kick, and the forces before it, (r,) [N]; None if other rows held then."""
        return (self._known, self._past[1]) if self._known and len(self._past) > 1 else None

    def was_loaded(self, kick: Kick) -> Booleans:
        """Return which gaps had a normal force in the last kick: (k,)."""
        if last := self._recalled(kick):
            return np.asarray(last.force > 0)
        force = np.zeros(len(kick.layout.touching.pair))
        for gap, old in self._same(kick):
            assert self._known
            force[gap] = self._known.force[old]
        return np.asarray(force > 0)

    def existed(self, kick: Kick) -> Booleans:
        """Return which gaps existed in the last kick: (k,)."""
        if self._recalled(kick):
            return np.ones(len(kick.layout.touching.pair), dtype=bool)
        found = np.zeros(len(kick.layout.touching.pair), dtype=bool)
        found[[gap for gap, _ in self._same(kick)]] = True
        return found

    def _expected(self) -> Array:
        """Return the forces that come next, (r,) [N], if the same rows hold."""
        last = self._past[0]
        if len(self._past) < 3:
            return last
        _, before, first = self._past
        bend = max_abs(last - 2 * before + first)
        return parabola(self._past) if bend <= SMOOTH * max_abs(last - before) else last

    def _recalled(self, kick: Kick) -> LastKick | None:
        """Return the last kick, if it had the same contacts."""
        last = self._known
        return last if last and last.layout.touching is kick.layout.touching else None

    def _new(self, kick: Kick, motion: Array) -> tuple[Array, Array, Booleans, Integers]:
        """Return a guess for other contacts: from the last kick where known, else from the motion.

        It consists of the normal forces, (k,), the friction, (f,), the active gaps, (k,), and the
        signs of sliding friction, (f,), 0 where it sticks.
        """
        touching, layout, last = kick.layout.touching, kick.layout, self._known
        rates = kick.rows_at_start.jacobian @ motion
        rates[layout.slips] += kick.belt_slip
        on, speed = rates[layout.gaps] < 0, rates[layout.slips]
        force, along = np.zeros(len(on)), np.zeros(len(speed))
        slip = np.where(np.abs(speed) > AT_REST, -np.sign(speed), 0).astype(np.intp)
        if last:
            old_force, old_on = last.force, last.active.on[last.layout.gaps]
            old_along = last.forces[last.layout.slips]
            before = last.layout.touching
            keys, old_keys = _keys(touching), _keys(before)
            for gap, old in _same(keys, old_keys):
                force[gap], on[gap] = old_force[old], old_on[old]
            for index, old in _same(_rubbing(touching, keys), _rubbing(before, old_keys)):
                along[index], slip[index] = old_along[old], last.active.slip[old]
        return force, along, on, slip

    def _same(self, kick: Kick) -> list[tuple[int, int]]:
        """Return the gaps that existed in the last kick, with their indices then."""
        if self._known is None:
            return []
        return _same(_keys(kick.layout.touching), _keys(self._known.layout.touching))


def recalled(old: Kick, forces: Array, active: Active, new: Kick) -> tuple[Array, Active]:
    """Return the forces of a kick, (r,) [N], and its active rows, for one with other rows.

    New contacts have no force.
    """
    warm_start = WarmStart()
    warm_start.note(old, forces, active)
    return warm_start.guess(new, np.zeros(new.response.shape[1]), 1.0)


def _same(new: list[Key], old: list[Key]) -> list[tuple[int, int]]:
    """Return the indices of keys that there are in both lists, in each of them."""
    old_indices = {key: index for index, key in enumerate(old)}
    return [(index, old_indices[key]) for index, key in enumerate(new) if key in old_indices]


def _rubbing(touching: ContactPoints, keys: list[Key]) -> list[Key]:
    """Return the keys of friction, at either point, from those of all gaps."""
    return [(*keys[gap][:3], 0) for gap in touching.friction_points.tolist()]


def _keys(touching: ContactPoints) -> list[Key]:
    """Return the keys by which gaps are recognised in the next step.

    pymunk may exchange the two bodies of a contact from one step to the next. Its two points then
    change places, too.
    """
    seen: Counter[tuple[int, int]] = Counter()
    numbers: list[int] = []  # of the contacts between the same two bodies
    keys = []
    points = (*touching.bodies, touching.pair, touching.point, touching.partner >= 0)
    for a, b, pair, point, two in np.stack(points, axis=1).tolist():
        both = (min(a, b), max(a, b))
        if not point:
            numbers.append(seen[both])
            seen[both] += 1
        keys.append((*both, numbers[pair], 1 - point if two and b < a else point))
    return keys
