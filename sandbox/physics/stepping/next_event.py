"""Finds the event that comes first in a part of a drift.

A force that is only known at steps, such as that of a rod, is extrapolated from the last drift.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.events import Crossing, SingleEvent, loads
from sandbox.model.expressions import Array
from sandbox.physics.events.breaking_at_impact import SUDDEN
from sandbox.physics.events.switching_events import NEAR, Part, crosses, within
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.state.motion import Instant
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.stage import Setup

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
        self._meter = Meter(setup, {h.waits.quantity for h in pending.values()} - {"t"})
        borne = loads(level.joints, setup.values)
        self._sudden = SUDDEN * np.array([borne.get(n, np.inf) for n in level.joints])
        self.begin()

    def begin(self) -> None:
        """Start from a motion without history."""
        self._was: dict[str, float] = {}
        self._pulled: tuple[Array, Array] | None = None  # tensions and torques at the last step
        self._passed = set[str]()  # what happened in a drift with landings

    def note(self) -> None:
        """Note the forces in the last part of a drift, for the extrapolation in the next."""
        self._pulled = self._pulls()

    def first(self, part: Part) -> tuple[str, float] | None:
        """Return the first event in a part, and the time from its start [s]; None if none."""
        forces = self._pulls()
        last = forces if self._pulled is None else self._pulled
        growth = [(now - then) / self._dt for now, then in zip(forces, last, strict=True)]
        growth[0] = np.where(np.abs(growth[0]) * self._dt > self._sudden, 0.0, growth[0])
        self._pulled = None
        seen: dict[float, dict[str, Array]] = {}

        def value(quantity: str, time: float) -> float:
            if time not in seen:
                seen[time] = self._meter(self._snapshot(part, time, growth))
            return float(seen[time][quantity])

        expected = [
            (wait, number, name)
            for number, (name, (waited, *_)) in enumerate(self._pending.items())
            if (wait := self._expected(name, waited, part, value)) is not None
        ]
        first, soonest = None, (np.inf, 0.0, 0)
        for wait, number, name in sorted(expected):
            waited = self._pending[name][0]
            if wait > 0 and waited.quantity != "t":
                wait = self._located(waited, part, value, min(soonest[0], part.lasts))
            beyond = waited.direction == "beyond" and wait < np.inf
            load = abs(value(waited.quantity, wait)) / waited.value if beyond else 0.0
            if (wait, -load, number) < soonest:
                first, soonest = name, (wait, -load, number)
        return None if first is None else (first, soonest[0])

    def pass_by(self, part: Part, landings: "Sequence[KickBetweenParts]") -> None:
        """Note which quantities cross their values in a drift with landings, and perhaps return.

        The first and the last of the landings are only corrections of the kicks around the drift.
        """
        still = [np.zeros_like(pulls) for pulls in self._pulls()]
        path = [self._snapshot(part, 0.0, still)]
        path += [self._there(path[0], landing) for landing in landings[1:-1]]
        values = [self._meter(place) for place in path]
        for name, (waited, *_) in self._pending.items():
            if waited.quantity != "t":
                seen = [float(value[waited.quantity]) for value in values]
                if any(crosses(waited, *two) for two in pairwise(seen)):
                    self._passed.add(name)
                self._was[name] = seen[-1]

    @staticmethod
    def _there(start: Snapshot, landing: "KickBetweenParts") -> Snapshot:
        """Return the state at a landing, with the forces at the start of its drift."""
        motion = Instant.at(float(start.t), landing.place, landing.stage.velocity)
        return replace(start, **motion._asdict())

    def _expected(self, name: str, waited: Crossing, part: Part, value: Value) -> float | None:
        """Return about when a quantity crosses its value [s]; None if not in this part.

        A time to wait for, and 0, if it has crossed already, are exact.
        """
        if waited.quantity == "t":
            wait = max(waited.value - part.t, 0.0)
            return wait if wait <= max(self._latest(part), 0.0) else None
        if name in self._passed:
            self._passed.discard(name)
            return 0.0
        now, then = (value(waited.quantity, time) for time in (0.0, part.lasts))
        was = self._was.get(name, now)
        self._was[name] = now
        if crosses(waited, was, now):
            return 0.0
        if not crosses(waited, now, then):
            return None
        sought = np.copysign(waited.value, then) if waited.direction == "beyond" else waited.value
        wait = float(sought - now) / (then - now) * part.lasts
        return wait if wait > 0 else float(np.nextafter(0.0, 1.0))

    def _located(self, waited: Crossing, part: Part, value: Value, soonest: float) -> float:
        """Return the time until a quantity crosses its value [s]; inf if another event is first."""
        now, then = (value(waited.quantity, time) for time in (0.0, soonest))
        if not crosses(waited, now, then):
            return np.inf
        wait = within(lambda time: value(waited.quantity, time), waited, part.lasts)
        return wait if wait <= self._latest(part) else np.inf

    def _latest(self, part: Part) -> float:
        return part.lasts - NEAR * self._dt

    def _pulls(self) -> tuple[Array, Array]:
        """Return the tensions and torques of the joints: (j,) each [N, N m]."""
        joints = self._scene.joints
        return joints.tensions(), joints.torque()

    def _snapshot(self, part: Part, time: float, growth: list[Array]) -> Snapshot:
        """Return the state at a time after the start of a part, with extrapolated forces."""
        motion, none = part.at(time), np.zeros(len(part.place))
        tension, torque = self._pulls()
        return Snapshot(
            *motion,
            acceleration=part.acceleration[:, :2],
            angular_acceleration=part.acceleration[:, 2],
            normal=none,
            friction=none,
            tension=tension + growth[0] * time,
            torque=torque + growth[1] * time,
        )
