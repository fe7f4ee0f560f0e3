"""Finds the event that comes first in a part of a drift.

A force that is only known at steps, such as that of a rod, is extrapolated from the last drift.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.events import Crossing, SingleEvent, breaking_loads
from sandbox.model.expressions import Array
from sandbox.physics.events.joint_cuts_and_force_switches import NEAR, Part, crosses, within
from sandbox.physics.events.joints_breaking_at_impact import SUDDEN
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.state.motion import Instant
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.step_plugin import Setup

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import KickBetweenParts

Value = Callable[[str, float], float]
"""Returns a quantity, by name, at a time after the start of a part [s]."""


class EventFinder:
    """Finds the events in a drift; j joints.

    `pending` are the events still to happen, by name; the caller removes those that have happened.
    """

    def __init__(self, setup: Setup, pending: Mapping[str, SingleEvent]) -> None:
        level, self._scene, self._dt = setup.level, setup.scene, setup.kicks.clock.dt
        self._pending = pending
        self._meter = Meter(setup, {h.trigger.quantity for h in pending.values()} - {"t"})
        limits = breaking_loads(level.joints, setup.values)
        self._jump_limits = SUDDEN * np.array([limits.get(n, np.inf) for n in level.joints])
        self.begin()

    def begin(self) -> None:
        """Start from a motion without history."""
        self._previous_values: dict[str, float] = {}
        self._previous_forces: tuple[Array, Array] | None = (
            None  # tensions and torques at the last step
        )
        self._crossed = set[str]()  # what happened in a drift with landings

    def note(self) -> None:
        """Note the forces in the last part of a drift, for the extrapolation in the next."""
        self._previous_forces = self._joint_forces()

    def first(self, part: Part) -> tuple[str, float] | None:
        """Return the first event in a part, and the time from its start [s]; None if none."""
        forces = self._joint_forces()
        last = forces if self._previous_forces is None else self._previous_forces
        growth = [(now - then) / self._dt for now, then in zip(forces, last, strict=True)]
        growth[0] = np.where(np.abs(growth[0]) * self._dt > self._jump_limits, 0.0, growth[0])
        self._previous_forces = None
        measured: dict[float, dict[str, Array]] = {}

        def value(quantity: str, time: float) -> float:
            if time not in measured:
                measured[time] = self._meter(self._snapshot(part, time, growth))
            return float(measured[time][quantity])

        estimates = [
            (wait, number, name)
            for number, (name, (crossing, *_)) in enumerate(self._pending.items())
            if (wait := self._estimate(name, crossing, part, value)) is not None
        ]
        first, soonest = None, (np.inf, 0.0, 0)
        for wait, number, name in sorted(estimates):
            crossing = self._pending[name][0]
            if wait > 0 and crossing.quantity != "t":
                wait = self._locate(crossing, part, value, min(soonest[0], part.duration))
            beyond = crossing.direction == "beyond" and wait < np.inf
            load = abs(value(crossing.quantity, wait)) / crossing.value if beyond else 0.0
            if (wait, -load, number) < soonest:
                first, soonest = name, (wait, -load, number)
        return None if first is None else (first, soonest[0])

    def note_crossings(self, part: Part, landings: "Sequence[KickBetweenParts]") -> None:
        """Note which quantities cross their values in a drift with landings, and perhaps return.

        The first and the last of the landings are only corrections of the kicks around the drift.
        """
        no_forces = [np.zeros_like(forces) for forces in self._joint_forces()]
        path = [self._snapshot(part, 0.0, no_forces)]
        path += [self._state_at_landing(path[0], landing) for landing in landings[1:-1]]
        values = [self._meter(state) for state in path]
        for name, (crossing, *_) in self._pending.items():
            if crossing.quantity != "t":
                series = [float(value[crossing.quantity]) for value in values]
                if any(crosses(crossing, *two) for two in pairwise(series)):
                    self._crossed.add(name)
                self._previous_values[name] = series[-1]

    @staticmethod
    def _state_at_landing(start: Snapshot, landing: "KickBetweenParts") -> Snapshot:
        """Return the state at a landing, with the forces at the start of its drift."""
        motion = Instant.at(float(start.t), landing.pose, landing.stage.velocity)
        return replace(start, **motion._asdict())

    def _estimate(self, name: str, crossing: Crossing, part: Part, value: Value) -> float | None:
        """Return about when a quantity crosses its value [s]; None if not in this part.

        A time to wait for, and 0, if it has crossed already, are exact.
        """
        if crossing.quantity == "t":
            wait = max(crossing.value - part.t, 0.0)
            return wait if wait <= max(self._latest_time(part), 0.0) else None
        if name in self._crossed:
            self._crossed.discard(name)
            return 0.0
        now, at_end = (value(crossing.quantity, time) for time in (0.0, part.duration))
        previous = self._previous_values.get(name, now)
        self._previous_values[name] = now
        if crosses(crossing, previous, now):
            return 0.0
        if not crosses(crossing, now, at_end):
            return None
        target = (
            np.copysign(crossing.value, at_end)
            if crossing.direction == "beyond"
            else crossing.value
        )
        wait = float(target - now) / (at_end - now) * part.duration
        return wait if wait > 0 else float(np.nextafter(0.0, 1.0))

    def _locate(self, crossing: Crossing, part: Part, value: Value, soonest: float) -> float:
        """Return the time until a quantity crosses its value [s]; inf if another event is first."""
        now, at_end = (value(crossing.quantity, time) for time in (0.0, soonest))
        if not crosses(crossing, now, at_end):
            return np.inf
        wait = within(lambda time: value(crossing.quantity, time), crossing, part.duration)
        return wait if wait <= self._latest_time(part) else np.inf

    def _latest_time(self, part: Part) -> float:
        return part.duration - NEAR * self._dt

    def _joint_forces(self) -> tuple[Array, Array]:
        """Return the tensions and torques of the joints: (j,) each [N, N m]."""
        joints = self._scene.joints
        return joints.tensions(), joints.torque()

    def _snapshot(self, part: Part, time: float, growth: list[Array]) -> Snapshot:
        """Return the state at a time after the start of a part, with extrapolated forces."""
        motion, no_forces = part.at(time), np.zeros(len(part.pose))
        tension, torque = self._joint_forces()
        return Snapshot(
            *motion,
            acceleration=part.acceleration[:, :2],
            angular_acceleration=part.acceleration[:, 2],
            normal=no_forces,
            friction=no_forces,
            tension=tension + growth[0] * time,
            torque=torque + growth[1] * time,
        )
