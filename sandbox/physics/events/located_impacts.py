"""Impacts located in time, for fast bodies and accurate impact times.

pymunk finds contacts once per step. A bullet is then already behind the wall, and a ball bounces up
to a step late. Here the drift of a step is cut at every impact of the bodies that a level names:
between two kicks leapfrog represents a motion with the acceleration of the last kick, so bodies
move along parabolas until two outlines touch, bounce off each other (see `impact_response`), and
continue along new parabolas for the rest of the step. pymunk is given the outcome: the positions at
the end of the drift, and the velocities half a kick before. Bodies that rest on each other after an
impact are left to pymunk from the next kick on.
"""

from cmath import rect
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.joints import bodies_of
from sandbox.model.level import Level
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.coefficients.pair_coefficients import pair_coefficients
from sandbox.physics.contacts.detection.time_of_impact import Hit, Path, meet, touching
from sandbox.physics.contacts.impacts.endless_impacts_error import EndlessImpacts
from sandbox.physics.contacts.impacts.impact_step_velocity import impacts
from sandbox.physics.contacts.impacts.pile_impacts import PRESSED
from sandbox.physics.contacts.shapes.pair_exclusion import meets
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.events.impact_order import ImpactOrder, Tally
from sandbox.physics.events.impact_response import (
    Coefficients,
    DriftImpacts,
    Impact,
    ImpactResponse,
)
from sandbox.physics.events.velocity_dependent_forces_between_impacts import (
    FlightForces,
    of_velocity,
)
from sandbox.physics.geometry.outline_distance import Outline, outlines
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.cancellation_points import cancellation_point
from sandbox.physics.state.motion import Reading, momentum

SHUT_IN = Message("{body} is wedged in, since what presses on it does not yield; give it more room")


class Cut(NamedTuple):
    """The outcome of the impacts within a drift; n bodies.

    `jump`, (n, 3), are the jumps of the velocities at the beginning of the next kick [m/s, rad/s],
    `acceleration_change`, (n, 3), the changes of the accelerations [m/s², rad/s²], and
    `wrench_change`, (n, 3), those of forces that depend on velocities [N, N m]; None if none do.
    """

    jump: Array
    acceleration_change: Array
    wrench_change: Array | None


class ImpactLocator:
    """Cuts the drift of a step at the impacts of named bodies; n bodies.

    `outlines` are the shapes of all bodies, `swept`, (n,), those whose impacts are located, and
    `held`, (n,), those held by joints of any kind. No exact joints hold bodies of the scene: where
    some do, contacts are solved directly. `dt` is the time step [s].

    `impacts` are those of the last drift, and `pre_kick_velocity`, (n, 3), the velocities at the
    beginning of the last kick [m/s, rad/s].
    """

    def __init__(
        self,
        outlines: Sequence[Outline],
        swept: Booleans,
        coefficients: Coefficients,
        scene: Scene,
        held: Booleans,
        dt: float,
    ) -> None:
        self._batch, self._outlines, self._dt = scene.batch, outlines, dt
        self._collision, self._held = ImpactResponse(coefficients, scene, dt), held
        self._mass, self._inertia, self._inverse_mass = (
            scene.mass,
            scene.inertia,
            scene.inverse_mass,
        )
        self._scene, self._joints, self._laws = scene, scene.joints, of_velocity(scene)
        self._flights: FlightForces | None = None  # if forces depend on velocities
        self._turns = ImpactOrder(self._collision.restitution, scene.mass > 0, dt)
        self._row = np.array([o.body for o in outlines])
        a, b = np.triu_indices(len(outlines), 1)
        i, j = self._row[a], self._row[b]
        group = np.array([o.group for o in outlines])
        wanted = (swept[i] | swept[j]) & (i != j) & ((group[a] != group[b]) | (group[a] == 0))
        bodies = list(scene.bodies.values())
        meeting = [
            meets(bodies[one], bodies[two]) for one, two in zip(i[wanted], j[wanted], strict=True)
        ]
        self._pairs = a[wanted][meeting], b[wanted][meeting]
        self._bodies = self._row[self._pairs[0]], self._row[self._pairs[1]]
        state = self._batch.state()
        self._gates = scene.gates
        self._low, self._high = self._boxes(state)
        self._first: Array | None = None
        self.pre_kick_velocity = state[:, 3:]
        self.impacts: list[Impact] = []
        self._reading_shift, self._extra_momentum = 0.0, np.zeros(3)

    @property
    def last(self) -> DriftImpacts | None:
        """The entries for the books from the impacts in the last drift; None if there were none."""
        if not self.impacts:
            return None
        return DriftImpacts(
            self.impacts,
            self.pre_kick_velocity,
            self._reading_shift,
            self._extra_momentum,
            self._flights.law_works if self._flights else (),
        )

    def begin(self, velocity: Array, acceleration: Array) -> None:
        """Start from a motion, given the velocities before its first kick and the accelerations."""
        self.pre_kick_velocity, self._first, self.impacts = velocity, acceleration, []

    def cut(
        self, law_acceleration: Array, law_motion: Reading | None, struck: Array | None
    ) -> Cut | None:
        """Let bodies collide in the coming drift; return the outcome, None without impacts.

        `law_acceleration`, (n, 3), are the accelerations by gravity and force laws in the last
        kick, in which the laws saw `law_motion`; `struck`, (n, 3), are the jumps of velocities by
        sequential impacts in it, None if pymunk solves impacts. Raises `EndlessImpacts` if bodies
        collide more often than can be followed.
        """
        state = self._batch.state()
        pose, drifts = state[:, :3], state[:, 3:].copy()
        total = self._total(drifts, struck)
        self._first, self.impacts = None, []
        bend = np.maximum(np.abs(law_acceleration), np.abs(total))
        near = self._near(pose, pose + drifts * self._dt, bend * self._dt**2)
        velocity_before, self.pre_kick_velocity = self.pre_kick_velocity, drifts
        if not len(near):
            return None
        acceleration = self._acceleration(law_acceleration, total)
        if struck is None:
            self._without_impacts(acceleration, law_acceleration, pose, (velocity_before, drifts))
        path = Path(pose, drifts - acceleration * (self._dt / 2), acceleration)
        self._extra_momentum = np.zeros(3)
        self._flights = None
        if (self._laws or self._scene.rotations) and law_motion:
            self._flights = FlightForces(self._scene, self._laws, law_motion, path)
        self._solve_in_order(path, near, law_acceleration * self._dt)
        return self._hand_over(path, state, acceleration) if self.impacts else None

    def _total(self, drifts: Array, struck: Array | None) -> Array:
        """Return the accelerations of the last kick without sequential impacts: (n, 3)."""
        if self._first is not None:
            return self._first
        total = (drifts - self.pre_kick_velocity) / self._dt
        return total if struck is None else total - struck / self._dt

    def _hand_over(self, path: Path, state: Array, acceleration: Array) -> Cut:
        """Give pymunk the end of a path, given the state and accelerations at its start."""
        drifts, hit = self.pre_kick_velocity, path.struck
        if self._flights:
            self._flights.finish(self._dt)
            self._extra_momentum += self._flights.momentum
        pose, velocity = path.at(self._dt)
        new_acceleration = path.acceleration
        self.pre_kick_velocity = np.where(
            hit[:, None], velocity - new_acceleration * (self._dt / 2), drifts
        )
        self._compare(path, (acceleration, new_acceleration), (state[:, :3], pose))
        state[hit, :3] = (pose - self.pre_kick_velocity * self._dt)[hit]
        state[:, 3:] = self.pre_kick_velocity
        self._batch.set_state(state)
        change = np.where(hit[:, None], new_acceleration - acceleration, 0.0)
        wrench_change = self._flights.change if self._flights else None
        return Cut(self.pre_kick_velocity - drifts, change, wrench_change)

    def _compare(
        self, path: Path, accelerations: tuple[Array, Array], poses: tuple[Array, Array]
    ) -> None:
        """Set the entries of the energy and momentum books for the middle of a drift.

        They follow from the accelerations and positions at the kicks before and after it.
        """
        half, struck = self._dt / 2, path.struck[:, None]
        before, after = (np.where(struck, acceleration, 0.0) for acceleration in accelerations)
        less = before * before - after * after
        if self._flights:  # only the others store energy
            less = (before - after) * (before - self._flights.first_acceleration)
        self._reading_shift = float(np.sum(self._inertia * less)) * half * half / 2
        self._extra_momentum += self._added_momentum(path, self._dt, path.struck)
        for acceleration, pose in zip((before, after), poses, strict=True):
            self._extra_momentum -= momentum(self._inertia * acceleration * half, pose)

    def _added_momentum(self, path: Path, t: float, bodies: Booleans) -> Array:
        """Return the momentum by accelerations of some bodies since their last impacts: (3,)."""
        elapsed = np.where(bodies, t - path.start, 0.0)[:, None]
        added = self._inertia * path.acceleration * elapsed
        return momentum(added, path.pose + path.velocity * (elapsed / 2))

    def _boxes(self, state: Array) -> tuple[Array, Array]:
        """Return the bounding boxes of shapes relative to their bodies: corners (s, 2) each."""
        turns = (self._inverse_mass[:, 2] > 0) | (state[:, 5] != 0)
        low, high = np.empty((len(self._outlines), 2)), np.empty((len(self._outlines), 2))
        for index, outline in enumerate(self._outlines):
            corners = [rect(1, state[outline.body, 2]) * corner for corner in outline.corners]
            if turns[outline.body]:
                corners = [complex(sign, sign) * outline.extent for sign in (-1, 1)]
            x, y = [c.real for c in corners], [c.imag for c in corners]
            low[index], high[index] = (min(x), min(y)), (max(x), max(y))
            low[index] -= outline.radius
            high[index] += outline.radius
        return low, high

    def _near(
        self, start: Array, end: Array, bend: Array, of: Booleans | None = None
    ) -> list[tuple[int, int]]:
        """Return the pairs of shapes whose boxes overlap on the way; paths deviate by bend / 8.

        If some bodies are given, (n,), only the pairs of which they are part.
        """
        (a, b), (i, j) = self._pairs, self._bodies
        if of is not None:
            some = of[i] | of[j]
            a, b = a[some], b[some]
        low = np.minimum(start, end)[:, :2] - bend[:, :2] / 8
        high = np.maximum(start, end)[:, :2] + bend[:, :2] / 8
        low, high = low[self._row] + self._low, high[self._row] + self._high
        meet = ((low[a] <= high[b]) & (low[b] <= high[a])).all(axis=1)
        if (together := self._joints.together) and len(together.bodies):
            stuck = np.isin(self._row, np.concatenate(together.bodies))
            meet &= ~(stuck[a] | stuck[b])  # joints pass impacts on: solved at the step
        near = list(zip(a[meet].tolist(), b[meet].tolist(), strict=True))
        return [pair for pair in near if not self._is_let(pair, start)]

    def _is_let(self, pair: tuple[int, int], pose: Array) -> bool:
        """Return whether one of two shapes lets the other pass from positions, (n, 3)."""
        if self._gates is None:
            return False
        rows = [self._outlines[shape].body for shape in pair]
        at, there = ((complex(x, y), rect(1, angle)) for x, y, angle in pose[rows].tolist())
        return self._gates.lets_pass_at(rows[0], rows[1], at, there)

    def _acceleration(self, law_acceleration: Array, total: Array) -> Array:
        """Return the accelerations of the last kick; for free bodies, those of the force laws.

        These have no rounding error.
        """
        tied = self._held.copy()
        tied[self._batch.contacts().bodies] = True
        return np.where(tied[:, None], total, law_acceleration)

    def _without_impacts(
        self,
        acceleration: Array,
        law_acceleration: Array,
        pose: Array,
        velocities: tuple[Array, Array],
    ) -> None:
        """Remove the effect of pymunk's impacts in the last kick from the accelerations."""
        contacts, solid = self._batch.contacts(), self._joints.joined
        hit, new_acceleration = impacts(
            contacts, solid, pose, *velocities, law_acceleration, self._mass, self._dt
        )
        acceleration[hit] = new_acceleration

    def _solve_in_order(self, path: Path, near: list[tuple[int, int]], adds: Array) -> None:
        """Solve one impact after the other until the drift is over."""
        hits = self._hits(path, near, 0.0, adds)
        tally = Tally(self._collision.restitution, self._mass > 0, self._dt)
        while hits:
            cancellation_point()
            groups = self._turns.next(hits)
            time, struck = groups[0][0].time, np.zeros_like(path.struck)
            for group in groups:
                struck |= self._collide(path, group, tally)
            pose, end = path.pose_at(time), path.pose_at(self._dt)
            bend = np.abs(path.acceleration) * (self._dt - time) ** 2
            moved_bodies = set(np.flatnonzero(struck).tolist())
            hits = [hit for hit in hits if moved_bodies.isdisjoint(hit.bodies)]
            hits += self._hits(path, self._near(pose, end, bend, struck), time, adds)

    def _around(self, path: Path, group: list[Hit]) -> list[Hit]:
        """Return all contacts that are connected to a group of hits, directly or through others."""
        time, shapes = group[0].time, self._outlines
        pose = path.pose_at(time)
        near = self._near(pose, pose, np.zeros_like(pose))
        found = (touching(path, shapes[a], shapes[b], time) for a, b in near)
        return self._turns.linked(group, [hit for hit in found if hit])

    def _hits(
        self, path: Path, near: list[tuple[int, int]], since: float, adds: Array
    ) -> list[Hit]:
        shapes = self._outlines
        velocity_changes = np.array((adds, path.acceleration * (self._dt - since)))
        found = (
            meet(path, shapes[a], shapes[b], since, self._dt, velocity_changes) for a, b in near
        )
        return [hit for hit in found if hit]

    def _collide(self, path: Path, group: list[Hit], tally: Tally) -> Booleans:
        """Let bodies bounce off each other, and return the bodies that impulses reached: (n,).

        Bodies that would bounce endlessly, ever more gently, come to rest with all that they touch.
        """
        time, around = group[0].time, self._around(path, group) if tally.count(group) else []
        dead = bool(around) and tally.gentle(around)
        hits = around if dead else group
        reached = path.struck & False
        if self._flights:
            reached = self._flights.divide(
                time, hits, lambda: self._collision.respond(path, hits, dead=dead).jump
            )
        bounce = self._collision.respond(path, hits, dead=dead)
        self._extra_momentum += self._added_momentum(path, time, bounce.struck)
        path.turn(time, bounce.jump, bounce.struck)
        path.acceleration += bounce.acceleration_change
        self.impacts += bounce.impacts
        if dead:
            left = min(self._around(path, group), key=lambda hit: hit.parting)
            if left.parting < PRESSED * group[0].parting:
                raise EndlessImpacts(max(left.bodies, key=lambda b: self._mass[b]), SHUT_IN)
        return bounce.struck | reached


def locate(level: Level, values: Values, scene: Scene, dt: float) -> ImpactLocator | None:
    """Return the locator of the impacts of a level's bodies; None if it names none."""
    contact, names = level.effects.contact, list(level.bodies)
    if contact is None or contact.located is None:
        return None
    hung = {name for joint in level.joints.values() for name in bodies_of(joint)}
    return ImpactLocator(
        outlines(list(scene.bodies.values())),
        np.array([name in contact.located for name in names]),
        Coefficients(
            pair_coefficients(level, values, "restitution"),
            pair_coefficients(level, values, "friction"),
        ),
        scene,
        np.array([name in hung for name in names]),
        dt,
    )
