"""Events that act: what they cut and switch is done at its own time, within a drift.

See `events/acting.py`. From there on bodies are held and kicked for half of what is left of the
drift, by all that still acts, so that exact joints hold at its end. pymunk is then handed the
places and the velocities of a straight drift that leads there. A force that is only known at steps,
such as that of a rod, is taken to change as it did in the last. Euler's schemes know no velocities
at a step, and are no better than a step: there events act at the step that finds them.

A joint that breaks is an event like others, which waits for its force. Where several bear too much
at once, the one that is furthest beyond what it bears goes first, and may take the load off the
rest. For a blow see `events/blows.py`.
"""

from collections.abc import Callable, Iterator

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.happenings import Crossing, Happening, happenings, loads
from sandbox.physics.energy.jerks import reached
from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.engine.batch import Booleans
from sandbox.physics.events.acting import Part, acted, crosses, stored, within
from sandbox.physics.events.blows import SUDDEN
from sandbox.physics.joints.cutting import let_go
from sandbox.physics.joints.pulls import Pulls, pulls_of
from sandbox.physics.metering.meter import Meter
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.stage import Setup, Stage

NEAR = 1e-6
"""The share of a step before its end in which nothing happens: it waits for the next drift."""

Value = Callable[[str, float], float]
"""Tells a quantity so long after the beginning of a part [s]."""

MOST = 1000
"""How much may happen in one step, one after the other."""


def make(setup: Setup) -> Stage:
    """Make the stage."""
    acting = Acting(setup)
    return Stage(
        before_drift=acting.look,
        started=acting.start,
        begun=acting.begun,
        record=acting.record,
        calls=1,
    )


class Acting:
    """Waits for what happens in a level, and does what that says; n bodies, j joints."""

    def __init__(self, setup: Setup) -> None:
        level, scene = setup.level, setup.scene
        self._kicks, self._forces, self._scene = setup.kicks, setup.forces, scene
        self._dt, self._leapfrog = setup.kicks.clock.dt, setup.leapfrog
        self._touching = level.effects.contact is not None
        found = happenings(level.events, level.joints, setup.values)
        self._pending = {name: one for name, one in found.items() if name not in scene.happened}
        self._meter = Meter(setup, {h.waits.quantity for h in self._pending.values()} - {"t"})
        self._laws = (*((scene.gravity,) if scene.gravity else ()), *scene.laws)
        self._fixed = scene.mass == 0
        borne = loads(level.joints, setup.values)
        self._sudden = SUDDEN * np.array([borne.get(n, np.inf) for n in level.joints])
        self._past: tuple[Pulls, Pulls] | None = None  # in the last kick, and in that before it
        self._parts: list[Part] = []
        self._switched = 0.0
        self.start(scene.batch.velocity(), np.zeros_like(scene.inertia))

    def start(self, begun: Array, acceleration: Array) -> None:
        """Take up a motion: the velocities and accelerations at its start, (n, 3) each."""
        self._begun = begun - acceleration * (self._dt / 2)
        self._was: dict[str, float] = {}
        self._pulled: tuple[Array, Array] | None = None  # tensions and torques at the last step

    def begun(self) -> Array:
        """Return the velocities that the last kick began with: (n, 3) [m/s, rad/s]."""
        return self._begun

    def record(self, step: StepRecord) -> StepRecord:
        """Add what happened in the drift of a step."""
        if not self._parts:
            return step
        told = acted(self._parts, self._laws, self._scene.inertia, self._switched, self._dt)
        return step._replace(acted=told)

    def look(self) -> None:
        """Let happen what does in the coming drift."""
        state, self._parts, self._switched = self._scene.batch.state(), [], 0.0
        before, self._begun = self._begun, state[:, 3:]
        for broken in self._pending.keys() & self._scene.happened.keys():
            del self._pending[broken]  # by a blow
        if not self._pending:
            return
        parts = list(self._follow(self._whole(state, before)))
        if len(parts) > 1 and self._leapfrog:
            self._parts = parts
            self._go_on(parts[-1], state)

    def _whole(self, state: Array, before: Array) -> Part:
        """Return the coming drift, of states (n, 6), if nothing happens in it."""
        after, smooth = state[:, 3:], self._forces.smooth
        acceleration = (after - before) / self._dt
        struck = self._struck() | self._jerked()
        acceleration[struck] = smooth[struck]
        acceleration[self._fixed] = 0.0
        velocity = after - acceleration * (self._dt / 2) if self._leapfrog else after
        lasts = self._dt if self._leapfrog else 0.0
        return Part(self._kicks.clock.after(0), lasts, state[:, :3], velocity, acceleration, smooth)

    def _struck(self) -> Booleans:
        """Return whose velocities an impact has changed in the last kick: (n,)."""
        if self._scene.direct:
            return self._scene.direct.last.struck
        struck = np.zeros(len(self._fixed), dtype=bool)
        if self._touching:
            contacts = self._scene.batch.contacts()
            struck[contacts.bodies[contacts.first]] = True
        return struck

    def _jerked(self) -> Booleans:
        """Return whose velocities a rope has changed that is being caught: (n,)."""
        scene, moves = self._scene, ~self._fixed
        pulls = pulls_of(scene.joints, len(moves))
        before = self._past or (pulls, pulls)
        self._past, slack = (pulls, before[0]), pulls.slack_before(*before)
        if not pulls.pulls_only.any() or len(slack) < len(pulls.joints):
            return np.zeros(len(moves), dtype=bool)
        contacts = scene.direct.contacts if scene.direct else scene.batch.contacts()
        caught = reached(pulls, contacts, slack, moves)
        return np.asarray(pulls.jacobian[caught].any(axis=(0, 2)))

    def _follow(self, part: Part) -> Iterator[Part]:
        """Yield the parts of a drift, from one event to the next."""
        for _ in range(MOST):
            found = self._next(part)
            if found is None:
                break
            name, wait = found
            happening = self._pending.pop(name)
            yield part._replace(lasts=wait)
            part = self._happen(name, happening, part, wait)
        self._pulled = self._pulls()
        yield part

    def _next(self, part: Part) -> tuple[str, float] | None:
        """Return what happens first in a part, and how long after its beginning [s]."""
        forces = self._pulls()
        last = forces if self._pulled is None else self._pulled
        growth = [(now - then) / self._dt for now, then in zip(forces, last, strict=True)]
        growth[0] = np.where(np.abs(growth[0]) * self._dt > self._sudden, 0.0, growth[0])
        self._pulled = None
        waits: dict[str, tuple[float, float]] = {}
        seen: dict[float, dict[str, Array]] = {}

        def value(quantity: str, time: float) -> float:
            if time not in seen:
                seen[time] = self._meter(self._snapshot(part, time, growth))
            return float(seen[time][quantity])

        for name, (waited, *_) in self._pending.items():
            if (wait := self._wait(name, waited, part, value)) is not None:
                beyond = waited.direction == "beyond"
                load = abs(value(waited.quantity, wait)) / waited.value if beyond else 0.0
                waits[name] = wait, -load
        if not waits:
            return None
        first = min(waits, key=lambda name: waits[name])
        return first, waits[first][0]

    def _wait(self, name: str, waited: Crossing, part: Part, value: Value) -> float | None:
        """Return how long it takes until a quantity crosses its value; None if not in this part."""
        latest = part.lasts - NEAR * self._dt
        if waited.quantity == "t":
            wait = max(waited.value - part.t, 0.0)
            return wait if wait <= max(latest, 0.0) else None
        now, then = (value(waited.quantity, time) for time in (0.0, part.lasts))
        was = self._was.get(name, now)
        self._was[name] = now
        if crosses(waited, was, now):
            return 0.0
        if not crosses(waited, now, then):
            return None
        wait = within(lambda time: value(waited.quantity, time), waited, part.lasts)
        return wait if wait <= latest else None

    def _pulls(self) -> tuple[Array, Array]:
        """Return the tensions and torques of the joints that are solved: (j,) each [N, N m]."""
        joints = self._scene.joints
        return joints.tensions(), joints.torque()

    def _snapshot(self, part: Part, time: float, growth: list[Array]) -> Snapshot:
        """Return the state so long after the beginning of a part; forces grow as they did."""
        motion, none = part.at(time), np.zeros(len(self._fixed))
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

    def _happen(self, name: str, happening: Happening, part: Part, wait: float) -> Part:
        """Cut and switch what is said; return what is left of the drift from there."""
        left, motion = part.lasts - wait, part.at(wait)
        ahead = 1 - left / self._dt if self._leapfrog else 0.0
        t = self._kicks.clock.after(ahead)
        motion = motion._replace(t=np.asarray(t))
        before = stored(self._laws, motion)
        self._throw(happening, t)
        self._switched += stored(self._laws, motion) - before
        self._scene.happened[name] = t
        place = np.column_stack((motion.position, motion.angle))
        velocity = np.column_stack((motion.velocity, motion.angular_velocity))
        if not self._leapfrog:
            return part
        self._scene.batch.set_state(np.concatenate((place, velocity), axis=1))
        with self._kicks.held():
            after = self._kicks.settle(ahead, velocity, left / 2, left, at_step=True)
        acceleration = (after - velocity) / (left / 2)
        acceleration[self._fixed] = 0.0
        return Part(t, left, place, velocity, acceleration, self._forces.smooth)

    def _throw(self, happening: Happening, t: float) -> None:
        """Cut and switch what is said, at a time [s]."""
        scene, (_, cut, on, off) = self._scene, happening
        for joint in cut:
            let_go(scene.joints, joint, t)
        if cut and scene.direct:
            scene.direct.relay()
        for name in (*cut, *off, *on):
            if switch := scene.switches.get(name):
                switch.turn(t, on=name in on)

    def _go_on(self, last: Part, state: Array) -> None:
        """Hand pymunk a straight drift to where the last part leads; states are (n, 6)."""
        scene, dt = self._scene, self._dt
        end = last.at(last.lasts)
        velocity = np.column_stack((end.velocity, end.angular_velocity))
        begun = velocity - last.acceleration * (dt / 2)
        place = np.column_stack((end.position, end.angle)) - begun * dt
        begun[self._fixed], place[self._fixed] = state[self._fixed, 3:], state[self._fixed, :3]
        if self._touching and not scene.direct:  # what pymunk is to remember are whole impulses
            with self._kicks.held():
                self._kicks.settle(1.0, begun, dt, dt)
        scene.joints.time(dt, dt)
        scene.batch.set_state(np.concatenate((place, begun), axis=1))
        self._forces.restart(begun - last.acceleration * dt)
        self._begun = begun
