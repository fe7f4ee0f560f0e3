"""Subdrifts: the parts of a drift that is cut where bodies land; and the outcome of the drift."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.drifts.fallback_subdivision import (
    DividedDrift,
    KickBetweenParts,
)
from sandbox.physics.contacts.direct.kicks.kick_records import KickResult, Stage
from sandbox.physics.contacts.direct.prediction.convex_parts import Pair
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.joints.exact.constraint_interface import (
    GROWS,
    Coordinates,
    coordinate_indices,
    inertia_of,
)

DEEP = 1e-3
"""m: a drift is divided if an overlap in it is larger. Each part adds a little energy where bodies
are squeezed out, so smaller overlaps are left to their correction."""

ROUGH = 0.1
"""In a part below this share of a drift, forces follow from differences that are too small."""

UNSURE = 10.0
"""The share of a velocity that a body cannot gain by a change of its forces within a part."""

JERKS = 1e-3
"""In a jerk, joints give or take at least this share of the kinetic energy."""


class Subdrift(NamedTuple):
    """A part of a drift, and the kick before it: r rows, N bodies with the plane.

    Attributes
    ----------
    kick
        The rows of that kick.
    time_left, drift
        The time from its beginning to the end of the whole drift, and its length [s].
    start_velocity
        (3 N,), the velocities after the impacts at its beginning [m/s, rad/s].
    kick_duration
        The length of the kick after these impacts [s].
    forces
        (r,), the forces in that kick [N].
    active
        Its active rows.
    velocity
        (3 N,), the velocities in the part [m/s, rad/s].
    stages
        The stages at its beginning before that kick.
    continuing_forces
        (r,), the forces that continue after it, if its own are too rough for that; else None [N].
    flat
        See `KickResult`.
    stopped_crowds
        Whether crowds were stopped in the drift; see `crowded_landings`.
    """

    kick: Kick
    time_left: float
    drift: float
    start_velocity: Array
    kick_duration: float
    forces: Array
    active: Active
    velocity: Array
    stages: tuple[Stage, ...] = ()
    continuing_forces: Array | None = None
    flat: bool = False
    stopped_crowds: bool = False

    @classmethod
    def whole_drift(cls, taken: KickResult, drift: float, velocity: Array) -> "Subdrift":
        """Return the whole drift after a kick, of a length [s] and with velocities (3 N,)."""
        start, solution = (taken.start_velocity, taken.duration), (taken.forces, taken.active)
        first = cls(taken.kick, drift, drift, *start, *solution, velocity, taken.stages[:-1])
        return first._replace(flat=taken.flat)

    @property
    def constraint_acceleration(self) -> Array:
        """(3 N,), the accelerations by joints and contacts [m/s², rad/s²]."""
        return np.asarray(self.forces @ self.kick.response)

    @property
    def later_forces(self) -> Array:
        """(r,), the forces that continue after it [N]."""
        return self.forces if self.continuing_forces is None else self.continuing_forces

    @property
    def deep_pairs(self) -> list[Pair]:
        """The pairs of bodies that end deeper in each other than they should."""
        if not self.flat:
            return []
        kick, gaps = self.kick, self.kick.layout.gaps
        left = (kick.rows(self.drift * self.velocity).total - kick.targets())[gaps]
        return kick.layout.touching.pairs(np.flatnonzero(left < -DEEP))

    @property
    def end(self) -> Coordinates:
        """The positions at its end."""
        return Coordinates(self.kick.pose.values + self.drift * self.velocity)


def rows_acting_on(kick: Kick, reached: Booleans) -> Booleans:
    """Return which rows of a kick act on some of the bodies, (n,): (r,)."""
    return np.asarray(kick.acts[:, reached].any(axis=1))


def movable(kick: Kick) -> Booleans:
    """Return which bodies impulses can move: (n,)."""
    return np.asarray(kick.joints.inverse[coordinate_indices(kick.acts.shape[1])].any(axis=1))


def around(kick: Kick, pairs: Sequence[Pair]) -> Booleans:
    """Return which bodies are in the islands of some pairs: (n,)."""
    reached = np.zeros(kick.acts.shape[1], dtype=bool)
    reached[[body for pair in pairs for body in pair]] = True
    return linked(kick, reached)


def linked(kick: Kick, some: Booleans) -> Booleans:
    """Return which bodies are in the islands of some bodies, (n,): (n,)."""
    reached = some & movable(kick)
    for rows, _, _ in kick.layout.islands:
        bodies = kick.acts[rows].any(axis=0)
        if (bodies & reached).any():
            reached |= bodies
    return reached


def others_of(part: Subdrift, laws: Array, reached: Booleans) -> tuple[Booleans, Array, Array]:
    """Return which rows act on `reached` bodies, and the forces of the others: (r,) each.

    Also the accelerations by the latter forces and by force laws, (3 N,).
    """
    mine = rows_acting_on(part.kick, reached)
    others = np.where(mine, 0.0, part.forces)
    return mine, others, laws + others @ part.kick.response


@dataclass(frozen=True)
class CutDrift:
    """A drift that was cut where bodies landed; n bodies.

    The rest of the step knows only whole kicks: the one before the drift, as if nothing landed, and
    the one after it, with the forces of the last part. The excess of each is taken back at that end
    of the drift. Bodies that take no part in the landings go on as they were.

    `whole` and `parts` are the drift without landings, and its parts with them. `laws`, (3 N,), are
    the accelerations by gravity and force laws [m/s², rad/s²]. `reached`, (n,), tells which bodies
    take part in the landings; `start`, (n, 3), are the positions at its start [m, rad].
    """

    whole: Subdrift
    parts: Sequence[Subdrift]
    laws: Array
    reached: Booleans
    start: Array

    @cached_property
    def divided(self) -> DividedDrift:
        """The drift in parts, for the rest of the step."""
        whole, led, duration = self.whole, self._led, self.whole.kick_duration
        change = duration * (self.laws + led.constraint_acceleration)
        after = self._moving((led.start_velocity + change)[self._indices])
        lead = Stage.of(led.kick, duration, after, duration * led.forces)
        kept, back = self._taken_back()
        stages = [(part.kick, stage) for part in self.parts[1:] for stage in self._stages(part)]
        between = (self.parts[0].kick, self._given_less()), *stages, (kept, back)
        excess_energy = self._excess_energy(after, [stage for _, stage in between])
        return DividedDrift(
            after,
            back.velocity,
            self.reached,
            (*whole.stages, lead),
            tuple(self._kick_record(kick, stage) for kick, stage in between),
            1.0,
            self._body_poses(self.parts[-1].end),
            excess_energy,
        )

    @property
    def end_acceleration(self) -> Array:
        """(n, 3), the accelerations at its end [m/s², rad/s²]."""
        last = self.parts[-1]
        return np.asarray((self.laws + last.later_forces @ self._ended.response)[self._indices])

    @cached_property
    def _indices(self) -> Integers:
        return coordinate_indices(len(self.start))

    @cached_property
    def _ended(self) -> Kick:
        """The rows of the last part, at its end."""
        last = self.parts[-1]
        return last.kick.at_pose(last.end)

    @cached_property
    def _led(self) -> Subdrift:
        """The part whose forces stand for the kick before the drift.

        It is the whole drift, without landings; but the first part if a rope becomes taut only
        after its landing, or if joints would do work in a jerk that the landing prevents. The
        forces of a brief part are too inexact to show such a jerk.
        """
        first, whole = self.parts[0], self.whole
        if first.drift < ROUGH * whole.drift:
            return first if _catches(whole, first) else whole
        least = JERKS * whole.kick.joints.kinetic_energy(whole.start_velocity)
        jerks = abs(self._work(whole)) > abs(self._work(first)) + least
        return first if jerks or _catches(whole, first) else whole

    def _work(self, part: Subdrift) -> float:
        """Return the work of the joints in a whole kick before a part [J]."""
        duration, rows = self.whole.kick_duration, part.kick.layout.joints
        mean = part.start_velocity + duration / 2 * (self.laws + part.constraint_acceleration)
        return duration * float(part.forces[rows] @ (part.kick.rows_at_start.jacobian[rows] @ mean))

    @property
    def _missing(self) -> float:
        """The time by which the kick after it is shorter than a whole one [s]."""
        return (self.whole.drift - self.parts[-1].drift) / 2

    @cached_property
    def _end_forces(self) -> Array:
        """(r,), the forces of its last part that are traced back [N]; see `_traced_forces`."""
        return _traced_forces(self.parts[-1], self.laws, self._missing, self.reached)

    def _excess_energy(self, after: Array, stages: Sequence[Stage]) -> float:
        """Return the excess of the energy in the middle of it, see `DividedDrift` [J].

        The work of constant laws is the change of their potential energy, on any path. The books
        take the work from the kicks, at their mean velocities, and read the potential energy along
        the straight parts. The two differ where forces set in or end: a falling body has
        m a² h² / 8 more energy on its parabola than in the middle of the chord. Bodies that rest,
        but whose forces are not traced back, are read as if they fell.

        `after`, (n, 3), are the velocities after the whole kick before it [m/s, rad/s]. `stages`
        are the kicks from there on, up to the velocities before the whole kick after it.
        """
        ended = [stage.velocity for stage in stages]
        velocity_before, indices = [after, *ended[:-1]], self._indices
        displacement = np.zeros_like(after)
        for stage, before in zip(stages, velocity_before, strict=True):
            displacement += stage.duration / 2 * (before + stage.velocity)
        for part in self.parts:
            displacement -= part.drift * part.velocity[indices]
        whole, last = self.whole.drift, self.parts[-1]
        displacement += whole / 2 * (after + ended[-1])
        free = ((_uncrowded_forces(last) - self._end_forces) @ self._ended.response)[indices]
        displacement -= (whole**2 - last.drift**2) / 8 * free
        inertia = inertia_of(self.whole.kick.joints.inverse)[indices]
        return float(np.sum((inertia * self.laws[indices] * displacement)[self.reached]))

    def _given_less(self) -> Stage:
        """Return the difference between the kick before it and a whole one."""
        first, full = self.parts[0], self.whole.kick_duration
        less = first.forces * first.kick_duration - full * self._led.forces
        return Stage.of(first.kick, first.kick_duration - full, first.velocity[self._indices], less)

    def _taken_back(self) -> tuple[Kick, Stage]:
        """Return the excess of the whole kick after it, taken back, and its rows."""
        last, kick, missing, forces = self.parts[-1], self._ended, self._missing, self._end_forces
        end = last.velocity - missing * (self.laws + _balanced(forces, last, kick, missing))
        return kick, Stage.of(kick, -missing, self._moving(end[self._indices]), -missing * forces)

    def _stages(self, part: Subdrift) -> tuple[Stage, ...]:
        """Return the stages at the beginning of a part."""
        velocity, rest = part.velocity[self._indices], part.forces * part.kick_duration
        return *part.stages, Stage.of(part.kick, part.kick_duration, velocity, rest)

    def _kick_record(self, kick: Kick, stage: Stage) -> KickBetweenParts:
        """Return a stage, limited to the bodies and joints that take part in the landings."""
        joints = kick.layout.joints
        some = stage.among(self.reached, rows_acting_on(kick, self.reached)[joints])
        jacobian = -kick.rows_at_start.jacobian[joints][:, self._indices]
        moving = some._replace(velocity=self._moving(stage.velocity))
        return KickBetweenParts(self._body_poses(kick.pose), jacobian, moving)

    def _moving(self, velocity: Array) -> Array:
        """Return velocities, (n, 3), with those of the whole drift for all other bodies."""
        return np.where(self.reached[:, None], velocity, self.whole.velocity[self._indices])

    def _body_poses(self, coordinates: Coordinates) -> Array:
        """Return the positions of the bodies: (n, 3) [m, rad]."""
        displacement = coordinates.values - self.whole.kick.pose.values
        return self.start + displacement[self._indices]


def _catches(whole: Subdrift, first: Subdrift) -> bool:
    """Return whether a rope becomes taut in a drift, but not before its first landing."""
    joints = whole.kick.layout.joints
    taut, taut_at_first = (part.forces[joints] > 0 for part in (whole, first))
    return bool((whole.kick.joints.pulls_only & taut & ~taut_at_first).any())


def _uncrowded_forces(last: Subdrift) -> Array:
    """Return the forces of the last part in islands where no gaps of a crowd close: (r,) [N]."""
    kick, layout, forces = last.kick, last.kick.layout, last.later_forces
    closes = kick.ahead & (last.forces[layout.gaps] > 0)
    if not (last.stopped_crowds and closes.any()):
        return forces
    rows, forces = np.zeros(len(forces), dtype=bool), forces.copy()
    rows[layout.gaps] = closes
    for island, _, _ in layout.islands:
        if rows[island].any():
            forces[island] = 0.0
    return forces


def _balanced(forces: Array, last: Subdrift, kick: Kick, missing: float) -> Array:
    """Return the accelerations by forces of the last part, at its end: (3 N,) [m/s², rad/s²].

    `kick` has the rows there. Large forces cancel on a light body between heavy ones, but not with
    the rows of another place: traced back over the `missing` time [s], they would give it far more
    than its velocity. Its own are those at the beginning of the part.
    """
    at_end, at_start = forces @ kick.response, forces @ last.kick.response
    weights, indices = inertia_of(kick.joints.inverse), coordinate_indices(kick.acts.shape[1])
    speeds = missing * (at_end - at_start), np.abs(last.velocity) + missing * np.abs(at_start)
    added_speed, last_speed = (np.sqrt(weights * v * v)[indices].max(axis=1) for v in speeds)
    unsure = np.zeros(len(at_start), dtype=bool)
    unsure[indices] = (added_speed > UNSURE * last_speed)[:, None]
    return np.where(unsure, at_start, at_end)


def _traced_forces(last: Subdrift, laws: Array, missing: float, reached: Booleans) -> Array:
    """Return the forces of the last part that may stand for a whole kick after it: (r,).

    Forces of bodies that jam do not last. Traced back over the `missing` time [s], they would give
    the bodies more energy than they have, or than the laws alone give them, and count as 0. So do
    those of islands in which gaps of a crowd close: such forces do work, and would give it back.
    """
    last = last._replace(continuing_forces=_uncrowded_forces(last))
    kinetic, pulls = last.kick.joints.kinetic_energy, last.later_forces @ last.kick.response
    least = kinetic(last.velocity) + kinetic(missing * laws)
    if kinetic(last.velocity - missing * (laws + pulls)) <= GROWS * least:
        return last.later_forces
    return np.where(rows_acting_on(last.kick, reached), 0.0, last.later_forces)
