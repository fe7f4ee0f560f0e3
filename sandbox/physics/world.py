"""A level that runs.

pymunk's step drifts the positions with the velocities of the step before, then kicks the
velocities. Started naively it is first order: free fall is late by half a step. Given half a kick
before the first step, the same loop is leapfrog (Störmer-Verlet): second order, symplectic, and
exact where accelerations are constant. Positions then live on the steps and pymunk's velocities
half-way between; the velocity *at* a step is the mean of the two around it.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import NoReturn

import numpy as np
import pymunk

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.batch import NO_CONTACTS, Contacts
from sandbox.physics.build import Scene, make_scene
from sandbox.physics.errors import EndlessImpacts, JointFailure, SimulationError
from sandbox.physics.hand import Hand
from sandbox.physics.hook import Hook
from sandbox.physics.impacts import impacts
from sandbox.physics.located import Located, locate
from sandbox.physics.massflow import MassFlows
from sandbox.physics.motion import Instant
from sandbox.physics.schemes import Substep, require, substeps
from sandbox.physics.sequence import Sequence
from sandbox.physics.snapshot import Snapshot
from sandbox.physics.watchdog import Watchdog

Pair = frozenset[str]

MAX_KICKS = 500
"""How often the first kick is repeated while contacts and strings come to terms."""

PATIENCE = 50
"""After how many kicks that settle nothing each is given twice as many sweeps of the solver."""

UNSETTLED = 1000
"""How many times the rounding velocities must still change for that."""

MAX_SWEEPS = 5000
"""How many sweeps a kick may then have, times the pairs in contact: it bounds the time it takes."""


def build(level: Level, values: Values | None = None, stepping: Stepping | None = None) -> "World":
    """Make the world of a level.

    Parameters
    ----------
    level
        What to simulate.
    values
        The parameters; the level's defaults if left out.
    stepping
        How time advances; as the level says if left out. If it only says how accurate, the setting
        is found out, or remembered.

    Raises
    ------
    AccuracyError
        If an accuracy is asked for that cannot be had.
    SimulationError
        If the world cannot even start.
    SchemeError
        If the scheme is not for such a level.
    """
    values, stepping = level.defaults if values is None else values, stepping or level.stepping
    if stepping.accuracy is not None:
        from sandbox.physics.accuracy import resolved  # it runs worlds itself

        stepping = resolved(level, values, stepping)
    return World(level, values, stepping)


class World:
    """The bodies of a level in motion; made by `build`.

    Attributes
    ----------
    level, values, stepping
        What it was built from.
    dt
        The time step [s].
    steps
        How many steps were taken; the time is `steps * dt`.
    scene
        The masses and laws of what moves.
    snapshot
        The state when it was last observed.
    contacts
        Who touched whom when it was last observed.
    hand
        What takes hold of bodies.
    kick
        What the force laws saw in the last kick; None if there are none, or before it.
    located
        Finds the impacts that are located in time; None if none are.
    disturbed
        Whether a hand has touched the scene, so that no formula for it holds any more.
    """

    def __init__(self, level: Level, values: Values, stepping: Stepping) -> None:
        require(level, stepping.scheme)
        self.level, self.values, self.stepping = level, values, stepping
        self.dt = 1 / stepping.rate
        self.steps = 0
        self.disturbed = False
        self.kick: Instant | None = None
        self._ended: Exception | None = None
        self.scene: Scene = make_scene(level, values, stepping)
        self._space = self.scene.space
        self._bodies = list(self.scene.bodies.values())
        self._batch, self._joints = self.scene.batch, self.scene.joints
        self._field = np.zeros((len(self._bodies), 3))  # acceleration by gravity
        self._untouched = np.zeros(len(self._bodies))
        self._untouched.setflags(write=False)
        self._seen = -1, self._field  # the step last observed, and the velocities half a step on
        if self.scene.gravity:
            self._field[self.scene.mass > 0, :2] = self.scene.gravity.acceleration
        self._smooth = self._field  # acceleration by gravity and laws
        self._agility = self.scene.agility
        self._early = stepping.scheme == "explicit-euler" and bool(self.scene.laws)
        self._leapfrog = not stepping.as_it_comes
        *self._leading, last = substeps(stepping.scheme, self.dt)
        self._drift, self._scale = last.drift, last.scale
        self._led = False  # whether all substeps but the last are taken
        self._guesses = self._leapfrog and any(law.needs_velocity for law in self.scene.laws)
        self._older = self._field  # the velocities that the last kick began with
        self._kicks_after: float = 1  # steps from the last to the time of the next kick
        # joints take turns with contacts: there their last pull acts from the start of a kick
        self._pulling = self._joints.together if level.effects.contact else None
        self._sequence = self._make_sequence()
        self.located = locate(level, values, self.scene, self.dt) if self._leapfrog else None
        self._hook = self._make_hook()
        self.hand = Hand(self._space, self._bodies)
        self.contacts: Contacts = NO_CONTACTS
        self.snapshot: Snapshot = self._start()
        self._watchdog = self._make_watchdog()

    @property
    def t(self) -> float:
        """The time [s]."""
        return self.steps * self.dt

    @property
    def jump(self) -> Array | None:
        """What impacts in sequence changed in the last step [m/s, rad/s]: (n, 3); None without."""
        return self._sequence.last.jump if self._sequence else None

    @property
    def impacts(self) -> list[tuple[Pair, float]]:
        """Who hit whom between the last two steps, and when [s], where that is located."""
        if not self.located:
            return []
        names, before = list(self.scene.bodies), (self.steps - 1) * self.dt
        located = self.located.impacts
        return [(frozenset(names[b] for b in i.bodies), before + i.time) for i in located]

    @property
    def hooks(self) -> int:
        """How many Python callbacks a step makes, if each pair that needs any has one contact."""
        hooked = (self._hook.count if self._hook else 0) * (len(self._leading) + 1)
        return hooked + self.scene.pair_callbacks

    def time_hooks(self) -> None:
        """Take the time of the shared hook from now on."""
        if self._hook:
            self._hook.timed()

    @property
    def hook_seconds(self) -> float:
        """What the shared hook has taken since it is timed [s]."""
        return self._hook.seconds if self._hook else 0.0

    def step(self) -> None:
        """Take one step without looking at it: nothing but pymunk's own step is paid for.

        Raises
        ------
        SimulationError
            If a joint cannot be kept.
        """
        if self._early:
            self._apply_forces()
        if self.located:
            self._cut(self.located)
        if self._leading:
            self._lead()
            self._led = False
        self._space.step(self._drift)
        self.steps += 1
        if self._hook and self._hook.error:
            self._fail(self._hook.error)

    def advance(self, steps: int = 1) -> Snapshot:
        """Take one or more steps, observe the last, and return the state there.

        Raises
        ------
        SimulationError
            If a joint cannot be kept, or a body is nowhere any more. The last good state stays in
            `snapshot`.
        ValueError
            If there are no steps to take.
        """
        if self._ended:
            raise self._ended
        if steps < 1:
            raise ValueError(f"steps is {steps}, but must be at least 1")
        for _ in range(steps - 1):
            self.step()
        if self._leading:
            self._lead()
            before = self._batch.velocity()
        else:
            before = self._seen[1] if self._seen[0] == self.steps else self._batch.velocity()
        self.step()
        with np.errstate(all="ignore"):  # what is not finite is told by name
            self.snapshot = self._observe(before)
        return self.snapshot

    def _lead(self) -> None:
        """Take all substeps of a step but the last, unless that is done."""
        if self._led:
            return
        for substep in self._leading:
            self._turn_to(substep)
            self._space.step(substep.drift)
        self._turn_to(Substep(self._drift, 1, 1.0))
        self._led = True

    def _turn_to(self, substep: Substep) -> None:
        """Let the next kick be that of a substep."""
        self._kicks_after, self._scale = substep.ahead, substep.scale
        if gravity := self.scene.gravity:
            x, y = gravity.acceleration
            self._space.gravity = x * substep.scale, y * substep.scale

    def _make_sequence(self) -> Sequence | None:
        scene = self.scene
        if scene.restitution is None:
            return None
        together = self._joints.together
        return Sequence(self._batch, scene.restitution, scene.agility, together, self.dt)

    def _make_hook(self) -> Hook | None:
        strings = self._joints.strings.values()
        before = [string.warm_start for string in strings] if self.level.effects.contact else []
        if (self.scene.laws or self._pulling) and not self._early:
            before.insert(0, self._apply_forces)
        if self._sequence:
            before.append(self._collide)
        after = self._joints.solvers(lambda: (self.steps + self._kicks_after + 1) * self.dt)
        dynamic = next((b for b in self._bodies if b.body_type == pymunk.Body.DYNAMIC), None)
        if dynamic is None or not (before or after):
            return None
        return Hook(self._space, dynamic, before, after)

    def _cut(self, located: Located) -> None:
        """Let what would touch in the coming drift collide there."""
        try:
            jump = located.cut(self._smooth, self._sequence.last.jump if self._sequence else 0.0)
        except EndlessImpacts as error:
            self._fail(error)
        if jump is not None:
            self._older = self._older + jump
            if self._sequence:
                self._sequence.shift(jump)

    def _collide(self) -> None:
        """Let one impact come after the other, if that is how the level wants them."""
        assert self._sequence
        self._sequence.collide(self._smooth, start=self._kicks_after == 0)
        self._older = self._older + self._sequence.last.jump

    def _apply_forces(self) -> None:
        """Read all bodies once, add up the laws, and write all forces once."""
        self.kick = motion = self._motion()
        if isinstance(self.scene.share, MassFlows):
            self._weigh(self.scene.share, motion.t)
        wrench = np.zeros_like(self._field)
        with np.errstate(all="ignore"):  # a force without a value ends the run when it is observed
            for law in self.scene.laws:
                law.add(motion, wrench)
            self._smooth = self._field + wrench * self._agility
        if self._pulling:
            self._pulling.pull(wrench)
        self._batch.set_force(wrench if self._scale == 1 else wrench * self._scale)

    def _weigh(self, share: MassFlows, t: Array) -> None:
        """Give the bodies whose mass changes that of a time [s], for the kick around it."""
        now = share(t)
        for row in share.bodies:
            body = self._bodies[row]
            body.mass = self.scene.mass[row] * now[row]
            if self.scene.moment[row]:
                body.moment = self.scene.moment[row] * now[row]
        self._agility = self.scene.agility / now[:, None]

    def _motion(self) -> Instant:
        """Return the motion that the laws see in a kick.

        pymunk's velocities are half a step old. Those at the kick are, to second order, 3/2 of them
        less 1/2 of those another step ago.
        """
        state = self._batch.state()
        velocity = state[:, 3:]
        if self._guesses:
            velocity = 1.5 * state[:, 3:] - 0.5 * self._older
            self._older = state[:, 3:]
        ahead = 0 if self._early else self._kicks_after
        t = np.asarray((self.steps + ahead) * self.dt)
        return Instant(t, state[:, :2], state[:, 2], velocity[:, :2], velocity[:, 2])

    def _start(self) -> Snapshot:
        """Observe the initial state; for leapfrog, also give the first half kick."""
        start = self._batch.velocity()
        self._seen = -1, start
        if not self._leapfrog:
            self._joints.time(self.dt, self.dt)
            nowhere = np.full_like(start, np.nan)
            return self._snapshot(self._batch.state(), start, nowhere, NO_CONTACTS, np.nan)
        kick = self._drift / 2
        self._kicks_after, self._older = 0, start
        with self._held():
            after = self._settle(start, kick)
            self.contacts = self._read_contacts()
            begun = start + self._sequence.last.jump if self._sequence else start
            acceleration = (after - begun) / kick
            state = self._batch.state()
            snapshot = self._snapshot(state, start, acceleration, self.contacts, kick)
            if self.level.effects.contact:
                # what pymunk remembers for the next step are impulses: leave it a whole step's
                self._settle(start, self.dt)
                self._batch.set_velocity(after)
        if self.located:
            self.located.begin(acceleration)
        self._joints.time(self.dt, self.dt)
        self._kicks_after = 1
        if self._guesses:
            self._older = begun + (begun - after)
        return snapshot

    @contextmanager
    def _held(self) -> Iterator[None]:
        """Hold all bodies where they are, whatever is stepped."""
        moving = [b for b in self._bodies if b.body_type != pymunk.Body.STATIC]
        bias, self._space.collision_bias = self._space.collision_bias, 1.0
        for body in moving:
            body.position_func = _stay
        try:
            yield
        finally:
            for body in moving:
                body.position_func = pymunk.Body.update_position
            self._space.collision_bias = bias

    def _settle(self, start: Array, kick: float) -> Array:
        """Kick held bodies, and return their velocities after it.

        Contacts and strings are solved in turn, one a step. So the kick is repeated from the same
        velocities, each time from the impulses found before, until nothing changes any more.
        """
        self._joints.time(kick, self.dt)
        swept = self._space.iterations
        close = 1e-15 * kick * np.abs(self._smooth).max(initial=0.0)
        after = np.full_like(start, np.inf)  # at least two kicks are compared
        for count in range(MAX_KICKS if self.level.effects.contact else 1):
            previous = after
            self._batch.set_velocity(start)
            self._space.step(kick)
            if self._hook and self._hook.error:
                self._fail(self._hook.error)
            after = self._batch.velocity()
            change = np.abs(after - previous).max(initial=0.0)
            if change <= close:
                break
            if count % PATIENCE == PATIENCE - 1 and change > UNSETTLED * close:
                most = MAX_SWEEPS // max(len(self._batch.contacts().bodies), 1)
                self._space.iterations = max(min(2 * self._space.iterations, most), swept)
        self._space.iterations = swept
        return after

    def _observe(self, before: Array) -> Snapshot:
        state = self._batch.state()
        after = state[:, 3:]
        self._seen = self.steps, after
        if self.located:
            before = self.located.begun
        contacts = self._read_contacts()
        velocity, acceleration = after, (after - before) / self._drift
        if self._leapfrog:
            velocity = (before + after) / 2
            if self._sequence:
                struck = self._sequence.last
                hit = np.flatnonzero(struck.jump.any(axis=1))
                acceleration[hit] = (after - struck.velocity)[hit] / (self.dt / 2)
                velocity[hit] = struck.velocity[hit]
            elif contacts.first.any():
                solid, mass = self._joints.solids.pairs, self.scene.mass
                hit, onwards = impacts(contacts, solid, before, after, self._smooth, mass, self.dt)
                acceleration[hit] = onwards
                velocity[hit] = after[hit] - onwards * (self.dt / 2)
        if self.located:
            contacts = self.located.contacts().and_(contacts)
        snapshot = self._snapshot(state, velocity, acceleration, contacts, self.dt)
        try:
            self._watchdog.look(snapshot, contacts, disturbed=self.disturbed)
        except SimulationError as error:
            self._ended, self.snapshot = error, self._watchdog.good
            raise
        self.contacts = contacts
        return snapshot

    def _read_contacts(self) -> Contacts:
        if not self.level.effects.contact:
            return NO_CONTACTS
        contacts = self._batch.contacts()
        touches = self._joints.touches
        return touches.with_latest(contacts) if touches else contacts

    def _snapshot(
        self, state: Array, velocity: Array, acceleration: Array, contacts: Contacts, kick: float
    ) -> Snapshot:
        normal: Array = self._untouched
        friction: Array = self._untouched
        if len(contacts.bodies):
            normal = _sums(contacts, contacts.normal / kick, len(normal))
            if self._sequence:
                normal = normal + self._sequence.last.impulse / kick
            friction = _sums(contacts, contacts.friction / kick, len(friction))
        motion = Instant(
            np.array(self.t), state[:, :2], state[:, 2], velocity[:, :2], velocity[:, 2]
        )
        return Snapshot(
            *motion,
            acceleration=acceleration[:, :2],
            angular_acceleration=acceleration[:, 2],
            normal=normal,
            friction=friction,
            tension=self._joints.tension(motion),
            torque=self._joints.torque(),
        )

    def _make_watchdog(self) -> Watchdog:
        start, contacts = self.snapshot, self.contacts
        with np.errstate(all="ignore"):  # what is not finite is told by name
            dog = Watchdog(self.level, self.values, self.stepping, self.scene, start, contacts)
            dog.look(start, contacts, disturbed=True)
        return dog

    def _fail(self, error: Exception) -> NoReturn:
        """Raise what a hook has kept; such a world has ended."""
        self._ended = error
        if isinstance(error, JointFailure):
            self._ended = SimulationError(error.joint, self.t, str(error), error.rate)
        elif isinstance(error, EndlessImpacts):
            body = list(self.scene.bodies)[error.body]
            self._ended = SimulationError(body, self.t, str(error))
        raise self._ended from error

    def grab(self, body: str, point: tuple[float, float]) -> None:
        """Take hold of a dynamic body at a point of the plane [m], as with a stiff spring."""
        self._take_one_drift()
        self.hand.grab(list(self.scene.bodies).index(body), point)
        self.disturbed = True

    def _take_one_drift(self) -> None:
        """Go on with leapfrog where there were substeps: no hand pulls backwards in time."""
        if self._leading:
            self._leading, self._drift = [], self.dt
            self.place({})

    def drag(self, point: tuple[float, float]) -> None:
        """Pull the body that is held towards a point of the plane [m]."""
        self.hand.drag(point)

    def release(self) -> None:
        """Let go of the body that is held."""
        self.hand.release()

    def place(self, positions: Mapping[str, tuple[float, float]]) -> Snapshot:
        """Put bodies elsewhere [m] with the velocities they have; strings are cut to fit.

        Returns the new state, from which the run goes on as if it had started there.
        """
        for name, position in positions.items():
            self.scene.bodies[name].position = position
            self._space.reindex_shapes_for_body(self.scene.bodies[name])
        self._joints.refit(self.t)
        snapshot = self.snapshot
        self._batch.set_velocity(np.column_stack((snapshot.velocity, snapshot.angular_velocity)))
        self.disturbed = True
        self.snapshot = self._start()
        self._watchdog = self._make_watchdog()
        return self.snapshot


def _sums(contacts: Contacts, values: Array, count: int) -> Array:
    """Add up for each body the values of its contacts."""
    sums = np.bincount(contacts.bodies.T.ravel(), np.tile(values, 2), count)
    return sums.astype(np.float64, copy=False)


def _stay(_body: pymunk.Body, _dt: float) -> None:
    """Move nothing."""
