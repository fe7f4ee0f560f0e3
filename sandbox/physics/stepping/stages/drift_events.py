"""The stage of acting events: each takes effect at its own time within a drift.

See `events/switching_events.py`. At the event the bodies are held in place and kicked for half of
the remaining drift, with the forces that act from there on, so that exact joints hold at its end.
pymunk is then given the positions and velocities of a straight drift with the same end. Euler's
schemes have no velocities at the steps, and errors of a step in time anyway: there, events act at
the step that finds them.

In a drift with landings, an event waits for the start of the next one, where landings are located
as at the start of a run: from an event within a drift they could not be located again.

A joint that breaks is an event like others, which waits for its force. If several joints are
overloaded at once, the most overloaded one breaks first, and may relieve the rest. For a blow see
`events/breaking_at_impact.py`. Tying a joint, or a bounce off a stop, changes velocities at once,
in a *jolt*: see `events/joint_impacts.py`.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.events import SingleEvent, happenings, loads
from sandbox.model.expressions import Array
from sandbox.physics.energy.impulse_propagation import reached
from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.events.breaking_at_impact import borne_jolt
from sandbox.physics.events.elastic_stops import Bounces
from sandbox.physics.events.joint_impacts import Jolt, jolt
from sandbox.physics.events.switching_events import Part, acted, acted_at_a_step, stored
from sandbox.physics.geometry.outline_distance import surfaces
from sandbox.physics.joints.joint_changes import catch, let_go
from sandbox.physics.joints.joint_forces import JointForces, pulls_of
from sandbox.physics.state.motion import Instant
from sandbox.physics.stepping.next_event import EventFinder
from sandbox.physics.stepping.stage import Setup, Stage

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift

Act = Callable[[float], None]
"""Performs an event at a time [s]."""

MOST = 1000
"""The most events in one step."""


def make(setup: Setup) -> Stage:
    """Make the stage."""
    acting = EventStage(setup)
    return Stage(
        before_drift=acting.look,
        started=acting.start,
        begun=acting.begun,
        record=acting.record,
        calls=1,
    )


class EventStage:
    """Waits for the events of a level, and performs them; n bodies."""

    def __init__(self, setup: Setup) -> None:
        level, scene = setup.level, setup.scene
        self._kicks, self._forces, self._scene = setup.kicks, setup.forces, scene
        self._dt, self._leapfrog = setup.kicks.clock.dt, setup.leapfrog
        self._touching = level.effects.contact is not None
        found = happenings(level.events, level.joints, setup.values)
        self._pending = {name: one for name, one in found.items() if name not in scene.happened}
        self._waiting = EventFinder(setup, self._pending)
        self._borne = loads(level.joints, setup.values)
        self._bounces = Bounces.of(scene, level, setup.values, self._borne, self._dt)
        self._laws = (*((scene.gravity,) if scene.gravity else ()), *scene.laws)
        self._fixed = scene.mass == 0
        self._running = surfaces(scene.bodies.values())
        # those in the last kick, and in the one before
        self._past: tuple[JointForces, JointForces] | None = None
        self._parts: list[Part] = []
        self._jolts: list[Jolt] = []
        self._switched = 0.0
        self.start(scene.batch.velocity(), np.zeros_like(scene.inertia))

    def start(self, begun: Array, acceleration: Array) -> None:
        """Start from a motion: velocities and accelerations at its start, (n, 3) each."""
        self._begun = begun - acceleration * (self._dt / 2)
        self._waiting.begin()

    def begun(self) -> Array:
        """Return the velocities at the beginning of the last kick: (n, 3) [m/s, rad/s]."""
        return self._begun

    def record(self, step: StepRecord) -> StepRecord:
        """Add the events in the drift of a step to its record."""
        if not self._parts:
            return step
        if self._leapfrog:
            done = acted(
                self._parts,
                self._laws,
                self._scene.inertia,
                self._running,
                self._switched,
                self._dt,
            )
        else:
            done = acted_at_a_step(self._begun, self._laws, self._switched)
        return step._replace(acted=done._replace(jolts=tuple(self._jolts)))

    def look(self) -> None:
        """Perform the events of the coming drift."""
        state, self._parts, self._switched = self._scene.batch.state(), [], 0.0
        self._jolts = []
        before, self._begun = self._before(), state[:, 3:]
        for broken in self._pending.keys() & self._scene.happened.keys():
            del self._pending[broken]  # by a blow
        if self._bounces:
            self._bounces.release()
        if not (self._pending or self._bounces):
            return
        parts = list(self._follow(*self._whole(state, before)))
        if len(parts) > 1:
            self._parts = parts
            self._go_on(parts[-1], state)

    @property
    def _landing(self) -> "DividedDrift | None":
        """The coming drift, if it is taken in parts."""
        return self._scene.direct.drifts.divided if self._scene.direct else None

    def _before(self) -> Array:
        """Return the velocities before the last kick: (n, 3) [m/s, rad/s]."""
        drifted = self._scene.direct.drifts.drifted if self._scene.direct else None
        return drifted.begun if drifted else self._begun

    def _whole(self, state: Array, before: Array) -> tuple[Part, Booleans]:
        """Return the coming drift without events and landings, given states (n, 6).

        Also the bodies that the kick before it struck or jerked: (n,).
        """
        landing, smooth = self._landing, self._forces.smooth
        after = landing.left if landing else state[:, 3:]
        acceleration = (after - before) / self._dt
        struck = self._struck() | self._jerked()
        acceleration[struck] = smooth[struck]
        acceleration[self._fixed] = 0.0
        velocity = after - acceleration * (self._dt / 2) if self._leapfrog else after
        lasts = self._dt if self._leapfrog else 0.0
        t = self._kicks.clock.after(0)
        return Part(t, lasts, state[:, :3], velocity, acceleration), struck

    @property
    def _contacts(self) -> Contacts:
        """The contacts of the last kick."""
        return self._scene.direct.contacts if self._scene.direct else self._scene.batch.contacts()

    def _forces_of(self, lasts: float, without: Booleans | None = None) -> Contacts:
        """Return the contacts of a kick that lasts so long [s], with forces; some bodies' not."""
        found = self._contacts
        if without is not None and len(found.bodies):
            left = ~without[found.bodies].any(axis=1)
            found = Contacts._make(field[left] for field in found)
        return found.times(1 / lasts)

    def _struck(self) -> Booleans:
        """Return the bodies whose velocities an impact changed in the last kick: (n,)."""
        if self._scene.direct:
            return self._scene.direct.last.struck
        struck = np.zeros(len(self._fixed), dtype=bool)
        if self._touching:
            contacts = self._scene.batch.contacts()
            struck[contacts.bodies[contacts.first]] = True
        return struck

    def _jerked(self) -> Booleans:
        """Return the bodies whose velocities a rope that becomes taut changed: (n,)."""
        scene, moves = self._scene, ~self._fixed
        pulls = pulls_of(scene.joints, len(moves))
        before = self._past or (pulls, pulls)
        self._past, slack = (pulls, before[0]), pulls.slack_before(*before)
        if not pulls.pulls_only.any() or pulls.new(before[0]).any():
            return np.zeros(len(moves), dtype=bool)
        caught = reached(pulls, self._contacts, slack, moves)
        return np.asarray(pulls.jacobian[caught].any(axis=(0, 2)))

    def _follow(self, part: Part, struck: Booleans) -> Iterator[Part]:
        """Yield the parts of a drift, from one event or bounce to the next; see `_whole`."""
        for number in range(MOST):
            found = self._first(part) if self._pending else None
            bounce = self._bounces.first(part) if self._bounces else None
            if bounce is not None and (found is None or bounce[1] < found[1]):
                wait, jolts = bounce[1], True
                act = partial(self._bounce, bounce[0], part, wait)
            elif found is not None:
                name, wait = found
                happening = self._pending.pop(name)
                act, jolts = partial(self._throw, name, happening), bool(happening.tie)
            else:
                break
            if not number:
                part = part._replace(forces=self._forces_of(self._dt, struck))
            left = part.lasts - wait
            *before, part = self._until(part, wait) if jolts else (part._replace(lasts=wait),)
            yield from (*before, part)
            part = self._happen(part, left, act)
        self._waiting.note()
        halved = self._jolts and self._leapfrog and not self._landing
        yield from self._halves(part) if halved else (part,)

    def _first(self, part: Part) -> tuple[str, float] | None:
        """Return the first event in a part, and the time from its start [s]; None if none."""
        if landing := self._landing:
            at_start = self._waiting.first(part._replace(lasts=0.0))
            if at_start is None:
                self._waiting.pass_by(part, landing.between)
            return at_start
        return self._waiting.first(part)

    def _until(self, part: Part, wait: float) -> Sequence[Part]:
        """Return the parts up to a jolt, with the force there at their end; see `_halves`."""
        if not (self._leapfrog and wait):
            return (part._replace(lasts=wait),)
        left = part.lasts - wait
        tried = self._tried(part, self._ahead(left), part.state(wait), (left / 2, left))
        return _in_halves(part._replace(lasts=wait), *tried)

    def _ahead(self, left: float) -> float:
        """Return the share of a step that has passed, given the time left of a drift [s]."""
        return 1 - left / self._dt if self._leapfrog else 0.0

    def _happen(self, part: Part, left: float, act: Act) -> Part:
        """Perform an event at the end of a part; return the rest of the drift.

        Its length is `left` [s].
        """
        scene, ahead = self._scene, self._ahead(left)
        place, velocity = part.state(part.lasts)
        t = self._kicks.clock.after(ahead)
        scene.batch.set_state(np.concatenate((place, velocity), axis=1))
        motion, count = Instant.at(t, place, velocity), len(self._jolts)
        before = stored(self._laws, motion)
        act(t)
        self._switched += stored(self._laws, motion) - before
        if self._jolts[count:]:
            velocity = self._jolts[-1].after
            scene.batch.set_velocity(velocity)
        if not self._leapfrog:
            return part._replace(velocity=velocity, lasts=left)
        if scene.direct:
            scene.direct.drifts.forget()
        with self._kicks.held():
            after = self._kicks.settle(ahead, velocity, left / 2, left, at_step=True)
        if landing := self._landing:
            after = landing.left
        acceleration = (after - velocity) / (left / 2)
        acceleration[self._fixed] = 0.0
        forces = self._forces_of(left / 2)
        return Part(t, left, place, velocity, acceleration, forces=forces)

    def _halves(self, part: Part) -> tuple[Part, Part]:
        """Return the halves of the last part of a drift with jolts, with the force at its end.

        So the rest of a drift after a jolt is a leapfrog step by itself, and as accurate.
        """
        place, _ = part.state(part.lasts)
        _, middle = part.state(part.lasts / 2)
        lasts = (part.lasts + self._dt) / 2, self._dt
        return _in_halves(part, *self._tried(part, 1.0, (place, middle), lasts))

    def _tried(
        self, part: Part, ahead: float, state: tuple[Array, Array], lasts: tuple[float, float]
    ) -> tuple[Array, Contacts]:
        """Return the accelerations in a trial kick, (n, 3) [m/s², rad/s²], and its contacts.

        Bodies that an impact, or a rope that becomes taut, stops in it keep those of the part. The
        kick is `ahead` steps after the last step, at positions and velocities `state`, (n, 3) each;
        `lasts` are the lengths of the kick and of the drift after it [s].
        """
        joints, count = self._scene.joints, len(self._fixed)
        before = pulls_of(joints, count)
        self._scene.batch.set_state(np.concatenate(state, axis=1))
        with self._kicks.tried():
            after = self._kicks.settle(ahead, state[1], *lasts, at_step=True)
            forces = self._forces_of(lasts[0])
        pulls = pulls_of(joints, count)
        caught = pulls.pulls_only & (pulls.tension > 0) & ~(before.tension > 0)
        wild = self._struck() | pulls.jacobian[caught].any(axis=(0, 2))
        found = (after - state[1]) / lasts[0]
        forces = part.forces if wild.any() else forces
        return np.where((wild | self._fixed)[:, None], part.acceleration, found), forces

    def _throw(self, name: str, happening: SingleEvent, t: float) -> None:
        """Cut, tie, switch and reverse what an event names, at a time [s]."""
        scene, (_, cut, tie, on, off, reverse) = self._scene, happening
        scene.happened[name] = t
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
            impact = borne_jolt(scene, t, self._borne, self._dt, partial(jolt, scene, t))
            self._jolts.append(impact)
            assert scene.joints.together
            scene.joints.together.calm()

    def _bounce(self, side: int, part: Part, wait: float, t: float) -> None:
        """Let a body bounce off a side of a stop, a time `wait` [s] after the start of a part."""
        assert self._bounces
        rests = self._bounces.rests(side, part, wait)
        self._jolts.append(self._bounces.bounce(side, t, rests=rests))

    def _go_on(self, last: Part, state: Array) -> None:
        """Give pymunk a straight drift to the end of the last part; states are (n, 6)."""
        scene, dt = self._scene, self._dt
        if not self._leapfrog:
            self._begun = last.velocity
            return
        end, velocity = last.state(last.lasts)
        begun = velocity - last.acceleration * (dt / 2)
        place = end - begun * dt
        begun[self._fixed], place[self._fixed] = state[self._fixed, 3:], state[self._fixed, :3]
        if self._touching and not scene.direct:  # pymunk's warm start needs whole impulses
            with self._kicks.held():
                self._kicks.settle(1.0, begun, dt, dt)
        scene.joints.time(dt, dt)
        mean = begun
        if landing := self._landing:
            place, mean = last.place, (landing.end - last.place) / dt
            mean = np.where(landing.reached[:, None], mean, begun)
        scene.batch.set_state(np.concatenate((place, mean), axis=1))
        self._forces.restart(begun - last.acceleration * dt)
        self._begun = begun


def _in_halves(part: Part, acceleration: Array, forces: Contacts) -> tuple[Part, Part]:
    """Return the halves of a part with the same end and another force in the second half.

    `acceleration`, (n, 3), is that at the end [m/s², rad/s²].
    """
    half, (place, _) = part.lasts / 2, part.state(part.lasts)
    _, middle = part.state(half)
    begin = place - middle * half - acceleration * (half * half / 2)
    later = Part(part.t + half, half, begin, middle, acceleration, half, forces)
    return part._replace(lasts=half), later
