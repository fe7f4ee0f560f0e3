"""The end of slipping, located in time.

Kinetic friction lasts as long as the slip: then the body rests, moves with the belt, or rolls.
pymunk detects that in the next kick, and reduces the friction of that whole kick so that nothing
slips back: the end comes up to half a step early or late. Here the drift is cut where the slip
ends. Between two kicks leapfrog represents a motion with the acceleration of the last, so a slip
changes linearly and its zero is known. pymunk's solver and the joints determine how the bodies
continue from there for the rest of the step (`post_event_accelerations.py`). pymunk is then given
the positions at the end of the drift, and the velocities half a kick before.

If the slip ends within the second half of a kick, the half after its step, pymunk has reduced the
friction at the step already. That kick is then taken again, short enough for everything to keep
slipping, so that the values at the step are right.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.joints import bodies_of, is_exact
from sandbox.model.level import Level
from sandbox.physics.contacts.coefficients.pair_coefficients import pair_coefficients
from sandbox.physics.contacts.impacts.impact_step_velocity import impacts, reached
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers
from sandbox.physics.events.post_event_accelerations import ContinuationSolver
from sandbox.physics.events.slip_end_detection import SlipDetector
from sandbox.physics.events.slip_phases import Phase, SlipEntries, Slips, slip_entries
from sandbox.physics.scene.make_scene import Scene

MOST = 100
"""The most cuts of the drift of a step; slips that end later are left to pymunk."""

LATE = 0.1
"""A slip that is reversed by more than this share of its change per step was only rounding."""

ALIKE = 1e-9
"""Two kicks are alike if they differ by less than this share of the effect of gravity and force
laws. Slips then change at a steady rate, and are next checked half-way to their end."""

FAR = 1_000_000
"""The most steps without a check."""


class Cut(NamedTuple):
    """The outcome of a drift in which slipping ended; n bodies."""

    pre_kick_velocity: Array
    """(n, 3), the velocities at the beginning of the next kick [m/s, rad/s]."""
    acceleration: Array
    """(n, 3), the accelerations since slipping last ended [m/s², rad/s²]."""


class SlipEndLocator:
    """Cuts the drift of a step where the slipping of named bodies ends; n bodies.

    `lookout` detects the end of slipping, and `continuation` finds how bodies continue. `linked`,
    (l, 2), are pairs of bodies that strings and pymunk's own joints connect; `tied`, (n,), are
    bodies held by other exact joints: together with contacts, these converge too slowly for a kick
    to tell how the bodies continue. `smooth` returns the accelerations by gravity and force laws in
    the last kick: (n, 3) [m/s², rad/s²]. `dt` is the time step [s].

    `pre_kick_velocity`, (n, 3), are the velocities at the beginning of the last kick [m/s, rad/s].
    `kicked` are the contacts of that kick if it was taken again, else None: then they are pymunk's.
    `last` are the entries for the books from the last drift; None if no slipping ended in it.
    """

    def __init__(
        self,
        scene: Scene,
        linked: Integers,
        tied: Booleans,
        lookout: SlipDetector,
        continuation: ContinuationSolver,
        smooth: Callable[[], Array],
        dt: float,
    ) -> None:
        self._scene, self._batch, self._linked, self._tied = scene, scene.batch, linked, tied
        self._lookout, self._continuation, self._smooth, self._dt = (
            lookout,
            continuation,
            smooth,
            dt,
        )
        self._next = self.pre_kick_velocity = self._change = self._batch.velocity()
        self._ground = self._next[scene.mass == 0]
        self._ground[:, :2] += continuation.running[scene.mass == 0]
        # steps without a check, while the squared difference of kicks stays within `_alike`
        self._quiet, self._alike = 0, 0.0
        self._acceleration: Array | None = None  # until the next step, if it is known
        self._due: tuple[Phase, Slips, Array] | None = None
        self.kicked: Contacts | None = None
        self.last: SlipEntries | None = None

    def start(self, velocity: Array, acceleration: Array) -> Array:
        """Check the first kick, of half a step; return the accelerations at the start.

        `velocity`, (n, 3), are the velocities at the start, and `acceleration`, (n, 3), the
        accelerations that pymunk gave [m/s, rad/s, m/s², rad/s²].
        """
        half, self._quiet, self.last = self._dt / 2, 0, None
        self._continuation.adds = np.abs(self._smooth()) * self._dt
        self._acceleration = acceleration = self._detect(velocity, velocity, acceleration, half)
        self.pre_kick_velocity, self._next = (
            velocity - acceleration * half,
            velocity + acceleration * half,
        )
        return acceleration

    def detect(self) -> None:
        """Check whether slipping ends in the coming drift; take the last kick again if so."""
        velocity_before, after = self._next, self._batch.velocity()
        self.pre_kick_velocity, self._next, change = velocity_before, after, after - velocity_before
        self.kicked = self._due = None
        if self._quiet:
            self._quiet -= 1
            differs = (change - self._change).ravel()
            if differs @ differs <= self._alike:
                return
        self._quiet, self._change = 0, change
        smooth = self._smooth()
        if self._struck(smooth):
            self._acceleration = None
            return
        self._continuation.adds = np.abs(smooth) * self._dt
        acceleration = change / self._dt
        until = acceleration if self._acceleration is None else self._acceleration
        step_velocity = velocity_before + until * (self._dt / 2)
        self._acceleration = self._detect(velocity_before, step_velocity, acceleration, self._dt)
        if self._acceleration is not acceleration:
            self._next = velocity_before + self._acceleration * self._dt
            self._batch.set_velocity(self._next)

    def _struck(self, smooth: Array) -> bool:
        """Return whether the last kick held an impact, which no acceleration represents."""
        contacts, solid = self._batch.contacts(), self._scene.joints.joined
        if not contacts.first.any():
            return False
        pose, mass = self._batch.state()[:, :3], self._scene.mass
        hit, _ = impacts(
            contacts, solid, pose, self.pre_kick_velocity, self._next, smooth, mass, self._dt
        )
        return bool(len(hit))

    def _detect(
        self, velocity_before: Array, step_velocity: Array, acceleration: Array, length: float
    ) -> Array:
        """Check whether slipping ends, and return the accelerations until it does.

        `velocity_before` and `step_velocity`, (n, 3), are the velocities at the beginning of the
        kick, and those at the step, from the accelerations until then. The kick's `length` [s] is a
        step, or half a step if it began at the step.
        """
        if not len(self._batch.contacts().bodies):
            return acceleration
        velocity = velocity_before + acceleration * (length - self._dt / 2)
        slip_state = self._lookout.detect(step_velocity, velocity, acceleration)
        if not slip_state.ends.any():
            if (self._ground == self._ground[:1]).all():  # all the ground moves alike
                self._quiet = int(min(max(slip_state.steps - 2, 0) / 2, FAR))
                self._alike = (ALIKE * float(self._continuation.adds.max())) ** 2
            return acceleration
        contacts = self._batch.contacts()
        tied = (self._island(slip_state.slips, slip_state.ends) & self._tied).any()
        if tied or self._continuation.is_approaching(contacts, slip_state.pose, velocity, self._dt):
            return acceleration
        if slip_state.weakened.any():
            return self._retake_slipping(velocity_before, step_velocity, acceleration, length)
        forces = contacts.scaled(1 / length)
        part = Phase(self._dt, slip_state.pose, velocity, acceleration, forces)
        self._due = part, slip_state.slips, slip_state.sense
        return acceleration

    def _retake_slipping(
        self, velocity_before: Array, step_velocity: Array, acceleration: Array, length: float
    ) -> Array:
        """Take the last kick again with everything still slipping; see `_detect`."""
        after, memory, time_since = (
            self._batch.velocity(),
            self._continuation.memory(),
            length - self._dt / 2,
        )
        settled = (
            self._continuation.settled(0.0, velocity_before, length, self._dt) - velocity_before
        ) / length
        slip_state = self._lookout.detect(
            step_velocity, velocity_before + settled * time_since, settled
        )
        slips, sense = slip_state.slips, slip_state.sense
        found = self._continuation.solve(
            slip_state.pose, velocity_before, 0.0, self._dt / 2, slips, sense
        )
        self._continuation.restore(memory)
        self._batch.set_velocity(after)
        if found and slip_state.weakened.any():
            island = self._island(slips, slip_state.weakened)
            slipping = np.where(island[:, None], found.acceleration, acceleration)
            velocity = velocity_before + slipping * time_since
            over = -LATE * np.abs(slips.change(slipping)) * self._dt
            if (sense * slips.speed(velocity) >= over)[slip_state.weakened].all():
                self.kicked = found.forces.scaled(length)
                part = Phase(self._dt, slip_state.pose, velocity, slipping, found.forces)
                self._due = part, slips, sense
                return slipping
        self._continuation.settled(
            0.0, velocity_before, length, self._dt
        )  # for pymunk's warm start
        self._continuation.restore(memory)
        self._batch.set_velocity(after)
        return acceleration

    def leave_to_impact(self, velocity_before: Array) -> None:
        """Leave the coming drift to an impact; the next kick then begins with velocities (n, 3)."""
        self._due = self.last = self._acceleration = None
        self._next, self._quiet = velocity_before, 0

    def cut(self) -> Cut | None:
        """Let slipping end in the coming drift; return the outcome, None if none ends."""
        due, self._due, self.last = self._due, None, None
        if due is None:
            return None
        state, memory = self._batch.state(), self._continuation.memory()
        smooth = self._smooth()
        phases, moved_bodies = self._follow(*due, state)
        pose, velocity_before = state[:, :3], state[:, 3:]
        if len(phases) > 1:
            self.last = slip_entries(
                phases, self._scene.inertia, smooth, self._continuation.running, self._dt
            )
            ends, _ = phases[-1].at(phases[-1].duration)
            velocity_before = np.where(
                moved_bodies[:, None], self.last.pre_kick_velocity, velocity_before
            )
            pose = np.where(moved_bodies[:, None], ends - velocity_before * self._dt, pose)
        self._continuation.settled(
            1.0, velocity_before, self._dt, self._dt
        )  # for pymunk's warm start
        self._continuation.restore(
            {p: known for p, known in memory.items() if not moved_bodies[[*p]].any()}
        )
        self._batch.set_state(np.concatenate((pose, velocity_before), axis=1))
        self._next, self._acceleration = velocity_before, phases[-1].acceleration
        return Cut(velocity_before, phases[-1].acceleration) if self.last else None

    def _follow(
        self, part: Phase, slips: Slips, sense: Array, state: Array
    ) -> tuple[list[Phase], Booleans]:
        """Let slips end one after the other; return the drift's parts and the changed bodies."""
        phases: list[Phase] = []
        kinematic = self._scene.mass == 0
        moved_bodies = np.zeros_like(kinematic)
        while len(phases) < MOST:
            adds, (_, velocity) = part.acceleration * self._dt, part.at(part.duration)
            if not self._lookout.ends(slips, sense, part.forces, velocity, adds).any():
                break
            wait = self._lookout.time_to_stop(slips, sense, part.velocity, part.acceleration)
            first = min(float(wait.min()), part.duration)
            pose, velocity = part.at(first)
            still = self._continuation.sense(slips, part.forces, velocity, adds)
            still[wait <= first] = 0.0
            island = self._island(slips, (sense != 0) & (still == 0))
            current_pose = np.where(
                (moved_bodies | island | kinematic)[:, None], pose, state[:, :3]
            )
            left = part.duration - first
            ahead, longest = 1 - left / self._dt, self._dt / 2
            found = self._continuation.solve(current_pose, velocity, ahead, longest, slips, still)
            if found is None:
                break
            phases.append(part._replace(duration=first))
            acceleration = np.where(island[:, None], found.acceleration, part.acceleration)
            part = Phase(left, pose, velocity, acceleration, found.forces)
            slips, sense, moved_bodies = found.slips, found.sense, moved_bodies | island
        return [*phases, part], moved_bodies

    def _island(self, slips: Slips, ended: Booleans) -> Booleans:
        """Return the bodies connected by contacts or strings to ended slips: (n,)."""
        return reached(slips.bodies, ended, self._scene.mass > 0, linked=self._linked)


def stop(
    level: Level,
    values: Values,
    scene: Scene,
    make_continuation: Callable[[], ContinuationSolver],
    smooth: Callable[[], Array],
    dt: float,
) -> SlipEndLocator | None:
    """Return the locator of the ends of slipping for a level; None if it names no bodies."""
    friction, names = level.effects.friction, list(level.bodies)
    if friction is None or friction.located is None:
        return None
    tied, linked = np.zeros(len(names), dtype=bool), np.empty((0, 2), dtype=np.intp)
    for name, joint in level.joints.items():
        rows = sorted(names.index(body) for body in {*bodies_of(joint)})
        if is_exact(joint) and name not in scene.joints.strings:
            tied[rows] = True
        elif len(rows) > 1 and not joint.kind.force:
            linked = np.append(linked, [rows], axis=0)
    for pair in level.effects.sticking.pairs if level.effects.sticking else ():
        tied[[names.index(body) for body in pair.bodies]] = True
    named = np.array([name in friction.located for name in names])
    coefficients = pair_coefficients(level, values, "friction")
    found = make_continuation()
    lookout = SlipDetector(scene.batch, named, coefficients, found, dt)
    return SlipEndLocator(scene, linked, tied, lookout, found, smooth, dt)
