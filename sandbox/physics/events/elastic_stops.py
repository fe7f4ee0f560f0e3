"""Elastic stops: a body that runs into one rebounds with some of its speed.

It rebounds at its own time within a drift, by Newton's law of restitution (see `joint_impacts.py`).
Until then the stop is no part of the equations of the joints. A body that would return within a
step rests on the stop: from then on the stop is a one-sided joint that pushes, until the body
leaves. So a ball that bounces lower and lower comes to rest; the stop absorbs its last bounces,
those lower than g dt²/8.

Stops without a restitution, and ropes, are one-sided joints at all times, which the direct solver
locates (see `taut_ropes_and_reached_stops`). In a scene with elastic stops they are located here,
as with e = 0.
Beside contacts solved directly, without events, the direct solver locates elastic stops as well.
"""

from collections.abc import Mapping
from functools import partial
from typing import Self

import numpy as np

from sandbox.model.events import rebounding_stops, stops_without_rebound
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level
from sandbox.physics.contacts.direct.drifts.taut_ropes_and_reached_stops import OFTEN
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.events.joint_cuts_and_force_switches import NEAR, Part, first_time
from sandbox.physics.events.joint_impacts import Jolt, jolt
from sandbox.physics.events.joints_breaking_at_impact import broken_jolt
from sandbox.physics.joints.exact.constraint_interface import QUADRATIC
from sandbox.physics.joints.exact.joint_system import JointSystem, coordinates_of
from sandbox.physics.joints.exact.shake import TAUT, ExactJoints
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.simulation_errors import JointFailure

TOUCHING = 1e-9
"""m or rad, the distance at which a stop counts as touched."""

WORK = 15_000
"""The largest product of the bounces in a step and the equations of all joints, which each bounce
solves anew, with the elastic stops, which it looks at, and `BOUNCE` more: about a second."""

BOUNCE = 40
"""The equations that take as long as what a bounce takes besides them."""


class Bounces:
    """Makes bodies bounce off the stops of a scene; n bodies, s sides of stops.

    `sides` are the equations of the sides. `restitution` and `breaking_loads` hold, by name, each
    stop's coefficient and the breaking force of each joint that has one [N]; `dt` is the time step
    [s].
    """

    def __init__(
        self,
        scene: Scene,
        sides: JointSystem,
        restitution: Mapping[str, float],
        breaking_loads: Mapping[str, float],
        dt: float,
    ) -> None:
        self._scene, self._sides, self._breaking_loads, self._dt = scene, sides, breaking_loads, dt
        self._restitution = [restitution[name] for name in sides.names]
        self._resting: set[int] = set()
        self._work = 0  # in this step, see `WORK`
        self._begin()

    @classmethod
    def of(
        cls,
        scene: Scene,
        level: Level,
        values: Values,
        breaking_loads: Mapping[str, float],
        dt: float,
    ) -> Self | None:
        """Return the bounces of a scene; None if it has no elastic stops."""
        sides = scene.joints.elastic
        restitution = dict.fromkeys(stops_without_rebound(level.joints, level.events), 0.0)
        restitution |= {name: e(values) for name, e in rebounding_stops(level.joints)}
        return cls(scene, sides, restitution, breaking_loads, dt) if sides else None

    def _begin(self) -> None:
        """Hold bodies that rest at a stop at the start."""
        state = self._scene.batch.state()
        beyond, rate = self._beyond(state[:, :3]), self._rate(state[:, :3], state[:, 3:])
        for side in np.flatnonzero((np.abs(beyond) <= TOUCHING) & (np.abs(rate) <= TOUCHING)):
            self._hold(int(side))
        if self._resting:
            self._together.end_added_impact()

    def release(self) -> None:
        """Begin a step: release bodies that leave the stop on which they rest.

        A drift with landings, wherever they are, was solved with the stop: they are released at the
        first step before a drift without any.
        """
        self._work = 0
        if self._scene.direct and self._scene.direct.drifts.drift_after:
            return
        for side in sorted(self._resting):
            if not self._together.tension[self._rows(side)].any():
                self._release_side(side)

    def _release_slack(self) -> None:
        """Release bodies that have left the stop on which they rest within this drift.

        An impact elsewhere may drive them back to it, which is an impact of its own.
        """
        beyond = self._beyond(self._scene.batch.state()[:, :3])
        for side in sorted(self._resting):
            if beyond[side] < -(TAUT + QUADRATIC):
                self._release_side(side)

    def first(self, part: Part) -> tuple[int, float] | None:
        """Return the side reached first in a part of a drift, and when [s]; None if none is."""
        states = part.state(0.0), part.state(part.duration)
        now, later = (self._beyond(pose) for pose, _ in states)
        meets = later > 0
        if not meets.any():
            return None
        rates = [self._rate(pose, velocity) for pose, velocity in states]
        waits: dict[int, float] = {}
        apart: dict[int, float] = {}  # how long sides are certainly not reached [s]
        for side in np.flatnonzero(meets).tolist():
            begins, ends = (float(rate[side]) for rate in rates)
            if side in self._resting or (part.duration == 0 and begins < 0):
                continue
            if begins >= 0 and now[side] >= -TOUCHING:
                waits[side] = 0.0
                continue
            turns = part.duration * begins / (begins - ends) if begins < 0 < ends else 0.0
            apart[side] = turns
        waits |= self._reached(part, apart, min(waits.values(), default=part.duration))
        latest = part.duration - NEAR * self._dt
        soon = {side: wait for side, wait in waits.items() if wait <= max(latest, 0.0)}
        return min(soon.items(), key=lambda item: item[1], default=None)

    def _reached(self, part: Part, apart: Mapping[int, float], soonest: float) -> dict[int, float]:
        """Return when sides are reached in a part [s]; some that come later are left out.

        Another one is reached after the time `soonest` [s]; until the times `apart`, none is.
        """
        waits: dict[int, float] = {}
        rows, seen = len(self._sides.equations.rows), None
        for side, low in apart.items():
            if soonest < part.duration and side < rows:
                if seen is None:
                    seen = self._beyond(part.state(soonest)[0]) > 0  # of all sides at once
                if not seen[side]:
                    continue
            elif soonest < part.duration and not self._is_beyond(side, part, soonest):
                continue
            waits[side] = first_time(partial(self._is_beyond, side, part), low, part.duration)
            if waits[side] < soonest:
                soonest, seen = waits[side], None
        return waits

    def _is_beyond(self, side: int, part: Part, t: float) -> bool:
        """Return whether a side is reached at a time [s]; faster than a look at all sides."""
        sides, pose = self._sides, part.state(t)[0]
        other = side - len(sides.equations.rows)
        if other < 0:
            return bool(self._beyond(pose)[side] > 0)
        value, _ = sides.equations.others[other].evaluate(sides.at(pose))
        return bool(value - sides.length[side] > 0)

    def would_rest(self, side: int, part: Part, wait: float) -> bool:
        """Return whether a body that reaches a stop in a part would return to it within a step.

        At a stop without a rebound it stays, until it is released.
        """
        if not self._restitution[side]:
            return True
        pose, velocity = part.state(wait)
        approach_speed = self._rate(pose, velocity)[side]
        approach_acceleration = self._rate(pose, part.acceleration)[side]
        return bool(
            2 * self._restitution[side] * approach_speed <= approach_acceleration * self._dt
        )

    def respond(self, side: int, t: float, *, rests: bool) -> Jolt:
        """Let a body that reaches a side at a time t [s] bounce off it, or stay if it rests.

        Raises `JointFailure` if stops are met too often in a step.
        """
        self._work += BOUNCE + len(self._together.names) + len(self._restitution) // 2
        if self._work > WORK:
            name = self._sides.names[side]
            raise JointFailure(name, OFTEN.filled(name=name))
        self._release_slack()
        self._hold(side)

        def impact() -> Jolt:
            row = int(np.flatnonzero(self._rows(side))[0])
            return jolt(self._scene, t, {} if rests else {row: self._restitution[side]})

        found = broken_jolt(self._scene, t, self._breaking_loads, self._dt, impact)
        if rests:
            self._together.end_added_impact()
        else:
            self._release_side(side)
        return found

    @property
    def _together(self) -> ExactJoints:
        together = self._scene.joints.together
        assert together
        return together

    def _hold(self, side: int) -> None:
        equations = self._sides.equations
        first = len(equations.rows)
        if side < first:
            self._together.add([equations.rows[side]], [])
        else:
            self._together.add([], [equations.others[side - first]])
        self._resting.add(side)

    def _release_side(self, side: int) -> None:
        self._together.drop(self._sides.names[side])
        self._resting.discard(side)
        if self._scene.direct:
            self._scene.direct.relay()

    def _rows(self, side: int) -> Booleans:
        """Return which of the equations solved together belong to a side: (m,)."""
        name = self._sides.names[side]
        return np.array([joint == name for joint in self._together.names], dtype=bool)

    def _beyond(self, pose: Array) -> Array:
        """Return how far positions, (n, 3), lie beyond the stops: (s,) [m, rad]."""
        return self._sides.evaluate(self._sides.at(pose)).total - self._sides.length

    def _rate(self, pose: Array, velocity: Array) -> Array:
        """Return the speeds of approach to the stops at those positions: (s,) [m/s, rad/s]."""
        jacobian = self._sides.evaluate(self._sides.at(pose)).jacobian
        return np.asarray(jacobian @ coordinates_of(velocity).values)
