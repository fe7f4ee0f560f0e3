"""The plugin of acting events: each takes effect at its own time within a drift.

See `events/joint_cuts_and_force_switches.py`. At the event the bodies are held in place and kicked
for half of the remaining drift, with the forces that act from there on, so that exact joints hold
at its end. pymunk is then given the positions and velocities of a straight drift with the same end.
Euler's schemes have no velocities at the steps, and errors of a step in time anyway: there, events
act at the step that finds them.

In a drift with landings, an event waits for the start of the next one, where landings are located
as at the start of a run: from an event within a drift they could not be located again.

A joint that breaks is an event like others, which waits for its force. If several joints are
overloaded at once, the most overloaded one breaks first, and may relieve the rest. For a blow see
`events/joints_breaking_at_impact.py`. Tying a joint, or a bounce off a stop, changes velocities at
once, in a *jolt*: see `events/joint_impacts.py`.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.events import SingleEvent, breaking_loads, events_by_name
from sandbox.model.expressions import Array
from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.energy.taut_rope_jerks import reached_by_jerk
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.events.elastic_stops import Bounces
from sandbox.physics.events.joint_cuts_and_force_switches import (
    Part,
    entries_at_step,
    entries_of,
    stored_energy,
)
from sandbox.physics.events.joint_impacts import Jolt, jolt
from sandbox.physics.events.joints_breaking_at_impact import broken_jolt
from sandbox.physics.geometry.outline_distance import surfaces
from sandbox.physics.joints.joint_changes import catch, let_go
from sandbox.physics.joints.joint_forces import JointForces, pulls_of
from sandbox.physics.state.motion import Instant
from sandbox.physics.stepping.next_event import EventFinder
from sandbox.physics.stepping.step_plugin import Plugin, Setup

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift

Act = Callable[[float], None]
"""Performs an event at a time [s]."""

MOST = 1000
"""The most events in one step."""


def make(setup: Setup) -> Plugin:
    """Make the plugin."""
    acting = EventPlugin(setup)
    return Plugin(
        before_drift=acting.perform,
        started=acting.start,
        pre_kick_velocity=acting.pre_kick_velocity,
        record=acting.record,
        calls=1,
    )


class EventPlugin:
    """Waits for the events of a level, and performs them; n bodies."""

    def __init__(self, setup: Setup) -> None:
        level, scene = setup.level, setup.scene
        self._kicks, self._forces, self._scene = setup.kicks, setup.forces, scene
        self._dt, self._leapfrog = setup.kicks.clock.dt, setup.leapfrog
        self._has_contacts = level.effects.contact is not None
        found = events_by_name(level.events, level.joints, setup.values)
        self._pending = {name: one for name, one in found.items() if name not in scene.event_times}
        self._finder = EventFinder(setup, self._pending)
        self._breaking_loads = breaking_loads(level.joints, setup.values)
        self._bounces = Bounces.of(scene, level, setup.values, self._breaking_loads, self._dt)
        self._laws = (*((scene.gravity,) if scene.gravity else ()), *scene.laws)
        self._fixed = scene.mass == 0
        self._surfaces = surfaces(scene.bodies.values())
        self._last_forces: tuple[JointForces, JointForces] | None = None  # of the last two kicks
        self._parts: list[Part] = []
        self._jolts: list[Jolt] = []
        self._switched = 0.0
        self.start(scene.batch.velocity(), np.zeros_like(scene.inertia))

    def start(self, velocity: Array, acceleration: Array) -> None:
        """Start from a motion: velocities and accelerations at its start, (n, 3) each."""
        self._pre_kick_velocity = velocity - acceleration * (self._dt / 2)
        self._finder.begin()

    def pre_kick_velocity(self) -> Array:
        """Return the velocities at the beginning of the last kick: (n, 3) [m/s, rad/s]."""
        return self._pre_kick_velocity

    def record(self, step: StepRecord) -> StepRecord:
        """Add the events in the drift of a step to its record."""
        if not self._parts:
            return step
        if self._leapfrog:
            laws, inertia = self._laws, self._scene.inertia
            done = entries_of(self._parts, laws, inertia, self._surfaces, self._switched, self._dt)
        else:
            done = entries_at_step(self._pre_kick_velocity, self._laws, self._switched)
        return step._replace(events=done._replace(jolts=tuple(self._jolts)))

    def perform(self) -> None:
        """Perform the events of the coming drift."""
        state, self._parts, self._switched = self._scene.batch.state(), [], 0.0
        self._jolts = []
        before, self._pre_kick_velocity = self._velocity_before_kick(), state[:, 3:]
        for broken in self._pending.keys() & self._scene.event_times.keys():
            del self._pending[broken]  # by a blow
        if self._bounces:
            self._bounces.release()
        if not (self._pending or self._bounces):
            return
        parts = list(self._split(*self._undivided(state, before)))
        if len(parts) > 1:
            self._parts = parts
            self._rejoin(parts[-1], state)

    @property
    def _divided_drift(self) -> "DividedDrift | None":
        """The coming drift, if it is taken in parts."""
        return self._scene.direct.drifts.drift_after if self._scene.direct else None

    def _velocity_before_kick(self) -> Array:
        """Return the velocities before the last kick: (n, 3) [m/s, rad/s]."""
        drifted = self._scene.direct.drifts.drift_before if self._scene.direct else None
        before = drifted.pre_kick_velocity if drifted else self._pre_kick_velocity
        return self._forces.after_belated_change(before)

    def _undivided(self, state: Array, before: Array) -> tuple[Part, Booleans]:
        """Return the coming drift without events and landings, given states (n, 6).

        Also the bodies that the kick before it struck or jerked: (n,).
        """
        landing, smooth = self._divided_drift, self._forces.law_acceleration
        after = landing.post_kick_velocity if landing else state[:, 3:]
        acceleration = (after - before) / self._dt
        struck = self._struck() | self._jerked()
        acceleration[struck] = smooth[struck]
        acceleration[self._fixed] = 0.0
        velocity = after - acceleration * (self._dt / 2) if self._leapfrog else after
        duration = self._dt if self._leapfrog else 0.0
        t = self._kicks.clock.after(0)
        return Part(t, duration, state[:, :3], velocity, acceleration), struck

    @property
    def _contacts(self) -> Contacts:
        """The contacts of the last kick."""
        return self._scene.direct.contacts if self._scene.direct else self._scene.batch.contacts()

    def _forces_of(self, duration: float, without: Booleans | None = None) -> Contacts:
        """Return the contacts of a kick that lasts so long [s], with forces; some bodies' not."""
        contacts = self._contacts
        if without is not None and len(contacts.bodies):
            kept = ~without[contacts.bodies].any(axis=1)
            contacts = Contacts._make(field[kept] for field in contacts)
        return contacts.scaled(1 / duration)

    def _struck(self) -> Booleans:
        """Return the bodies whose velocities an impact changed in the last kick: (n,)."""
        if self._scene.direct:
            return self._scene.direct.last.struck
        struck = np.zeros(len(self._fixed), dtype=bool)
        if self._has_contacts:
            contacts = self._scene.batch.contacts()
            struck[contacts.bodies[contacts.first]] = True
        return struck

    def _jerked(self) -> Booleans:
        """Return the bodies whose velocities a rope that becomes taut changed: (n,)."""
        scene, movable = self._scene, ~self._fixed
        forces = pulls_of(scene.joints, len(movable))
        before = self._last_forces or (forces, forces)
        self._last_forces, slack = (forces, before[0]), forces.slack_before(*before)
        if not forces.pulls_only.any() or forces.new(before[0]).any():
            return np.zeros(len(movable), dtype=bool)
        tightened = reached_by_jerk(forces, self._contacts, slack, movable)
        return np.asarray(forces.jacobian[tightened].any(axis=(0, 2)))

    def _split(self, part: Part, struck: Booleans) -> Iterator[Part]:
        """Yield the parts of a drift, from one event or bounce to the next; see `_undivided`."""
        for number in range(MOST):
            found = self._first(part) if self._pending else None
            bounce = self._bounces.first(part) if self._bounces else None
            if bounce is not None and (found is None or bounce[1] < found[1]):
                wait, jolts = bounce[1], True
                act = partial(self._bounce, bounce[0], part, wait)
            elif found is not None:
                name, wait = found
                happening = self._pending.pop(name)
                act, jolts = partial(self._switch, name, happening), bool(happening.tie)
            else:
                break
            if not number:
                part = part._replace(forces=self._forces_of(self._dt, struck))
            left = part.duration - wait
            *head, part = self._up_to_jolt(part, wait) if jolts else (part._replace(duration=wait),)
            yield from (*head, part)
            part = self._perform_event(part, left, act)
        self._finder.note()
        jolted = self._jolts and self._leapfrog and not self._divided_drift
        yield from self._last_halves(part) if jolted else (part,)

    def _first(self, part: Part) -> tuple[str, float] | None:
        """Return the first event in a part, and the time from its start [s]; None if none."""
        if landing := self._divided_drift:
            at_start = self._finder.first(part._replace(duration=0.0))
            if at_start is None:
                self._finder.note_crossings(part, landing.kicks_between)
            return at_start
        return self._finder.first(part)

    def _up_to_jolt(self, part: Part, wait: float) -> Sequence[Part]:
        """Return the parts up to a jolt, with the force there at their end; see `_last_halves`."""
        if not (self._leapfrog and wait):
            return (part._replace(duration=wait),)
        left = part.duration - wait
        tried = self._trial(part, self._ahead(left), part.state(wait), (left / 2, left))
        return _in_halves(part._replace(duration=wait), *tried)

    def _ahead(self, left: float) -> float:
        """Return the share of a step that has passed, given the time left of a drift [s]."""
        return 1 - left / self._dt if self._leapfrog else 0.0

    def _perform_event(self, part: Part, left: float, act: Act) -> Part:
        """Perform an event at the end of a part; return the rest of the drift.

        Its length is `left` [s].
        """
        scene, ahead = self._scene, self._ahead(left)
        pose, velocity = part.state(part.duration)
        t = self._kicks.clock.after(ahead)
        scene.batch.set_state(np.concatenate((pose, velocity), axis=1))
        motion, count = Instant.at(t, pose, velocity), len(self._jolts)
        before = stored_energy(self._laws, motion)
        act(t)
        self._switched += stored_energy(self._laws, motion) - before
        if self._jolts[count:]:
            velocity = self._jolts[-1].velocity_after
            scene.batch.set_velocity(velocity)
        if not self._leapfrog:
            return part._replace(velocity=velocity, duration=left)
        if scene.direct:
            scene.direct.drifts.forget()
        with self._kicks.hold():
            after = self._kicks.settle(ahead, velocity, left / 2, left, at_step=True)
        if landing := self._divided_drift:
            after = landing.post_kick_velocity
        acceleration = (after - velocity) / (left / 2)
        acceleration[self._fixed] = 0.0
        forces = self._forces_of(left / 2)
        return Part(t, left, pose, velocity, acceleration, forces=forces)

    def _last_halves(self, part: Part) -> tuple[Part, Part]:
        """Return the halves of the last part of a drift with jolts, with the force at its end.

        So the rest of a drift after a jolt is a leapfrog step by itself, and as accurate.
        """
        pose, _ = part.state(part.duration)
        _, middle = part.state(part.duration / 2)
        duration = (part.duration + self._dt) / 2, self._dt
        return _in_halves(part, *self._trial(part, 1.0, (pose, middle), duration))

    def _trial(
        self, part: Part, ahead: float, state: tuple[Array, Array], lengths: tuple[float, float]
    ) -> tuple[Array, Contacts]:
        """Return the accelerations in a trial kick, (n, 3) [m/s², rad/s²], and its contacts.

        Bodies that an impact, or a rope that becomes taut, stops in it keep those of the part. The
        kick is `ahead` steps after the last step, at positions and velocities `state`, (n, 3) each;
        `lengths` are the lengths of the kick and of the drift after it [s].
        """
        joints, count = self._scene.joints, len(self._fixed)
        before = pulls_of(joints, count)
        self._scene.batch.set_state(np.concatenate(state, axis=1))
        with self._kicks.trial():
            after = self._kicks.settle(ahead, state[1], *lengths, at_step=True)
            forces = self._forces_of(lengths[0])
        joint_forces = pulls_of(joints, count)
        tightened = joint_forces.pulls_only & (joint_forces.tension > 0) & ~(before.tension > 0)
        is_disturbed = self._struck() | joint_forces.jacobian[tightened].any(axis=(0, 2))
        trial_acceleration = (after - state[1]) / lengths[0]
        forces = part.forces if is_disturbed.any() else forces
        keeps = (is_disturbed | self._fixed)[:, None]
        return np.where(keeps, part.acceleration, trial_acceleration), forces

    def _switch(self, name: str, happening: SingleEvent, t: float) -> None:
        """Cut, tie, switch and reverse what an event names, at a time [s]."""
        scene, (_, cut, tie, on, off, reverse) = self._scene, happening
        scene.event_times[name] = t
        for joint in cut:
            let_go(scene.joints, joint, t)
        if cut and scene.direct:
            scene.direct.relay()
        for changed in (*cut, *off, *tie, *on):
            if switch := scene.switches.get(changed):
                switch.turn(t, on=changed in tie or changed in on)
        if reverse and scene.gates:
            scene.gates.reverse(reverse)
        if catch(scene.joints, tie, t):
            impact = broken_jolt(scene, t, self._breaking_loads, self._dt, partial(jolt, scene, t))
            self._jolts.append(impact)
            assert scene.joints.together
            scene.joints.together.end_added_impact()

    def _bounce(self, side: int, part: Part, wait: float, t: float) -> None:
        """Let a body bounce off a side of a stop, a time `wait` [s] after the start of a part."""
        assert self._bounces
        rests = self._bounces.would_rest(side, part, wait)
        self._jolts.append(self._bounces.respond(side, t, rests=rests))

    def _rejoin(self, last: Part, state: Array) -> None:
        """Give pymunk a straight drift to the end of the last part; states are (n, 6)."""
        scene, dt = self._scene, self._dt
        if not self._leapfrog:
            self._pre_kick_velocity = last.velocity
            return
        end, velocity = last.state(last.duration)
        start = velocity - last.acceleration * (dt / 2)
        pose = end - start * dt
        start[self._fixed], pose[self._fixed] = (state[self._fixed, 3:], state[self._fixed, :3])
        if self._has_contacts and not scene.direct:  # pymunk's warm start needs whole impulses
            with self._kicks.hold():
                self._kicks.settle(1.0, start, dt, dt)
        scene.joints.time(dt, dt)
        mean = start
        if landing := self._divided_drift:
            pose, mean = last.pose, (landing.end_pose - last.pose) / dt
            mean = np.where(landing.reached[:, None], mean, start)
        scene.batch.set_state(np.concatenate((pose, mean), axis=1))
        self._forces.restart(start - last.acceleration * dt)
        self._pre_kick_velocity = start


def _in_halves(part: Part, acceleration: Array, forces: Contacts) -> tuple[Part, Part]:
    """Return the halves of a part with the same end and another force in the second half.

    `acceleration`, (n, 3), is that at the end [m/s², rad/s²].
    """
    half, (pose, _) = part.duration / 2, part.state(part.duration)
    _, middle = part.state(half)
    begin = pose - middle * half - acceleration * (half * half / 2)
    later = Part(part.t + half, half, begin, middle, acceleration, half, forces)
    return part._replace(duration=half), later
