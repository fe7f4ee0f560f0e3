"""A level that runs.

pymunk's step drifts the positions with the velocities of the step before, then kicks the
velocities. Started naively it is first order: free fall is late by half a step. Given half a kick
before the first step, the same loop is leapfrog (Störmer-Verlet): second order, symplectic, and
exact where accelerations are constant. Positions then live on the steps and pymunk's velocities
half-way between; the velocity *at* a step is the mean of the two around it.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from math import inf
from typing import TYPE_CHECKING, NoReturn

import numpy as np
import pymunk

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.contacts.sequential_impacts import Sequence
from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.engine.batch import NO_CONTACTS, Contacts
from sandbox.physics.engine.grab import Hand
from sandbox.physics.engine.handles import stepper
from sandbox.physics.engine.hook import Hook
from sandbox.physics.events.located_impacts import Located, locate
from sandbox.physics.events.restart import Onwards
from sandbox.physics.events.slip_ends import Stops, stop
from sandbox.physics.guarding.energy_audit import Audit
from sandbox.physics.guarding.watchdog import Watchdog
from sandbox.physics.scene.integrators import (
    LEAPFROG,
    Composition,
    Substep,
    composition,
    require,
    substeps,
)
from sandbox.physics.scene.scene import Scene, make_scene
from sandbox.physics.scene.stability_limits import MARGIN, check_springs
from sandbox.physics.state.errors import (
    BreakdownError,
    EndlessImpacts,
    JointFailure,
    NoForces,
    SimulationError,
    way_out,
)
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.applied_forces import Forces
from sandbox.physics.stepping.bounds import Fence
from sandbox.physics.stepping.initial_kick import Settling
from sandbox.physics.stepping.observer import Observer

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.solver import Direct

Pair = frozenset[str]


def make_world(level: Level, values: Values, stepping: Stepping) -> "World":
    """Make the world of a level at a rate that is chosen.

    Parameters
    ----------
    level, values
        What to simulate, and its parameters.
    stepping
        How time advances; no accuracy, which `build` finds a setting for.

    Raises
    ------
    SimulationError
        If the world cannot even start.
    SchemeError
        If the scheme is not for such a level.
    ValueError
        If an accuracy is asked for.
    """
    if stepping.accuracy is not None:
        raise ValueError("an accuracy is asked for, and no rate is chosen")
    try:
        with np.errstate(all="ignore"):  # what is not finite is told by name
            return World(level, values, stepping)
    except SimulationError as error:
        error.refuse(level)
        raise
    except SandboxError:
        raise
    except JointFailure as error:
        failure = SimulationError(error.joint, 0.0, str(error))
        failure.refuse(level)
        raise failure from error
    except Exception as error:  # whatever it is, whoever builds gets an answer
        raise BreakdownError(error, 0.0) from error


class World:
    """The bodies of a level in motion; made by `make_world`.

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
    forces
        What gravity and the force laws do.
    located
        Finds the impacts that are located in time; None if none are.
    stops
        Finds where slipping ends, if that is located in time; None if not.
    parts
        What a step is made of.
    disturbed
        Whether a hand has touched the scene, so that no formula for it holds any more.
    """

    def __init__(self, level: Level, values: Values, stepping: Stepping) -> None:
        require(level, stepping.scheme)
        self.level, self.values, self.stepping = level, values, stepping
        self.dt = 1 / stepping.rate
        self.steps = 0
        self.disturbed = False
        self._trail: list[Array] | None = None  # where books are kept
        self._ended: Exception | None = None
        self.scene: Scene = make_scene(level, values, stepping)
        self._space = self.scene.space
        self._pymunk = stepper(self._space)
        self._fence = Fence(self.scene) if self.scene.reach < inf else None
        self._step = partial(self._step_within, self._fence) if self._fence else self._pymunk
        self._bodies = list(self.scene.bodies.values())
        self._batch, self._joints = self.scene.batch, self.scene.joints
        self._compose(composition(stepping.scheme, held=bool(self._joints.together)))
        # the step last observed, and the velocities half a step on
        self._seen = -1, self._batch.velocity()
        self._early = stepping.scheme == "explicit-euler" and bool(self.scene.laws)
        self._leapfrog = not stepping.as_it_comes
        self._scale = 1.0  # what forces are multiplied by in the next kick
        self._led = False  # whether all substeps but the last are taken
        self._kicks_after: float = 1  # steps from the last to the time of the next kick
        self._drifts_then: float = 1  # and how many the drift lasts that follows it
        # joints take turns with contacts: there their last pull acts from the start of a kick
        turns = level.effects.contact is not None and self.scene.direct is None
        pulling = self._joints.together if turns else None
        self.forces = Forces(self.scene, pulling, leapfrog=self._leapfrog)
        self._sequence = self._make_sequence()
        strikes = self._sequence or self.scene.direct
        self._observer = Observer(level, stepping, self.scene, self.forces, strikes)
        self.located = locate(level, values, self.scene, self.dt) if self._leapfrog else None
        self._hook = self._make_hook()
        self._settling = Settling(
            self._space,
            self._bodies,
            self._batch,
            self._joints,
            self._finish,
            touching=level.effects.contact is not None,
            placed=self.scene.direct is not None,
        )
        self.stops = self._make_stops()
        self.hand = Hand(self._space, self._bodies)
        self.contacts: Contacts = NO_CONTACTS
        self.snapshot: Snapshot = self._start()
        self._watchdog = self._make_watchdog()

    @property
    def t(self) -> float:
        """The time [s]."""
        return self.steps * self.dt

    @property
    def last(self) -> StepRecord:
        """What books must know of the last step that was observed."""
        return StepRecord(
            self.steps,
            self.dt,
            self.snapshot,
            self.contacts,
            self._begun,
            self.forces.seen,
            self.forces.smooth,
            self.parts,
            self._trail or (),
            self.located.last if self.located else None,
            self.stops.last if self.stops else None,
            self._sequence.last.jump if self._sequence else None,
            self.hand.hold,
        )

    def keep_trail(self) -> None:
        """Keep the states between the parts of a step from now on, for books."""
        if self._trail is None:  # others may keep books, too
            self._trail = []

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
        """How often a step calls Python, if each pair that needs it has one contact."""
        hooked = (self._hook.count if self._hook else 0) * len(self.parts)
        before = self._early + (self.located is not None) + (self.stops is not None)
        return before + hooked + self.scene.pair_callbacks

    @property
    def composed(self) -> bool:
        """Whether a step is made of several drifts and kicks."""
        return bool(self._leading)

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
            with np.errstate(all="ignore"):  # as in the hook
                self._apply_forces()
        if self.located:
            self._cut(self.located)
        if self.stops:
            self._end_slipping(self.stops)
        if self._leading:
            self._lead()
            self._led = False
        self._step(self._last.drift)
        if self._hook:
            self._hook.finish()
        self.steps += 1
        if self._hook and self._hook.error:
            self._fail(self._hook.error)
        if self.stops:
            self.stops.look()

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
        try:
            with np.errstate(all="ignore"):  # what is not finite is told by name
                return self._advance(steps)
        except SandboxError:
            raise
        except Exception as error:  # noqa: BLE001 (whatever it is, whoever steps gets an answer)
            self._fail(error)

    @property
    def doubted(self) -> bool:
        """Whether the run has stopped and could go on: it is not lost, but not to be trusted.

        Something is too deep in something else, has parted, or has energy from nowhere.
        """
        return self._ended is not None and self._watchdog.doubts

    def go_on(self) -> None:
        """Go on with a run that is `doubted`, whatever it shows, as pymunk would."""
        assert self.doubted
        self._watchdog.doubts, self._watchdog.trusts = False, True
        self._ended, self.disturbed = None, True

    def _advance(self, steps: int) -> Snapshot:
        for _ in range(steps - 1):
            self.step()
        if self._leading:
            self._lead()
            before = self._batch.velocity()
        else:
            before = self._seen[1] if self._seen[0] == self.steps else self._batch.velocity()
        self.step()
        try:
            self._observe(before)
        except JointFailure as error:  # that only a look at it finds
            self.snapshot = self._watchdog.good
            self._fail(error)
        return self.snapshot

    def _step_within(self, fence: Fence, drift: float) -> None:
        """Take a step of pymunk's, unless it would end beyond the grid in which pairs are found."""
        if name := fence.leaver(self.steps, drift):
            self._ended = self._beyond(name)
            raise self._ended
        self._pymunk(drift)

    def _beyond(self, name: str) -> SimulationError:
        reach = self.scene.reach
        told = f"'{name}' leaves the {reach:.3g} m around the origin that so many shapes may be in"
        return SimulationError(name, self.t, told)

    def _compose(self, shares: Composition) -> None:
        """Take steps from now on that are made like that."""
        self.parts = substeps(shares, self.dt)
        *self._leading, self._last = self.parts
        if self._joints.together:
            self._joints.together.parts = len(self.parts)

    def _lead(self) -> None:
        """Take all substeps of a step but the last, unless that is done."""
        if self._led:
            return
        trail = self._trail = None if self._trail is None else []
        for substep in self._leading:
            self._turn_to(substep)
            self._step(substep.drift)
            if self._hook:
                self._hook.finish()
            if trail is not None:
                trail.append(self._batch.state())
        self._turn_to(self._last)
        self._led = True

    def _turn_to(self, substep: Substep) -> None:
        """Let the next kick be that of a substep."""
        self._kicks_after, self._scale = substep.ahead, (scale := substep.scale)
        self._joints.time(substep.kick, substep.following)
        if gravity := self.scene.gravity:
            x, y = gravity.acceleration
            self._space.gravity = x * scale, y * scale

    def _make_sequence(self) -> Sequence | None:
        scene = self.scene
        if scene.restitution is None:
            return None
        together = self._joints.together
        return Sequence(self._batch, scene.restitution, scene.agility, together, self.dt)

    def _make_hook(self) -> Hook | None:
        strings = self._joints.strings.values()
        before = [string.warm_start for string in strings] if self.level.effects.contact else []
        if self.forces.acts and not self._early:
            before.insert(0, self._apply_forces)
        if self._sequence:
            before.append(self._collide)
        if direct := self.scene.direct:
            before.append(partial(self._begin, direct))
        after = self._joints.solvers(
            lambda: (self.steps + self._kicks_after + self._drifts_then) * self.dt,
            direct.solve if direct else None,
        )
        dynamic = next((b for b in self._bodies if b.body_type == pymunk.Body.DYNAMIC), None)
        if dynamic is None or not (before or after):
            return None
        return Hook(self._space, dynamic, before, after)

    def _cut(self, located: Located) -> None:
        """Let what would touch in the coming drift collide there."""
        jump = self._sequence.last.jump if self._sequence else None
        try:
            cut = located.cut(self.forces.smooth, jump)
        except (EndlessImpacts, JointFailure) as error:
            self._fail(error)
        if cut:
            self.forces.older = self.forces.older + cut.jump
            if self._sequence:
                self._sequence.shift(cut.struck, cut.place, cut.jump, cut.change)

    def _end_slipping(self, stops: Stops) -> None:
        """Let slipping end in the coming drift, where no impact has changed it."""
        if self.located and self.located.impacts:
            stops.drop(self.located.begun)
        elif cut := stops.cut():
            self.forces.older = cut.begun - cut.pull * self.dt
            if self.located:
                self.located.begun = cut.begun

    def _make_stops(self) -> Stops | None:
        if not self._leapfrog:
            return None
        forces, scene = self.forces, self.scene
        onwards = partial(Onwards, scene, self._kick_held, self._held, self.dt)
        return stop(self.level, self.values, scene, onwards, lambda: forces.smooth, self.dt)

    @contextmanager
    def _held(self) -> Iterator[None]:
        """Hold all bodies where they are, between two steps."""
        kicks_after = self._kicks_after
        with self.forces.tried(), self._settling.held():
            yield
        self._kicks_after, self._drifts_then = kicks_after, 1
        self._joints.time(self.dt, self.dt)

    def _kick_held(self, ahead: float, start: Array, length: float, drift: float) -> Array:
        """Kick bodies that are held, so many steps after the last; see `Stops`."""
        self._kicks_after, self._drifts_then, self.forces.older = ahead, drift / self.dt, start
        return self._settling.kick(start, length, drift, self.forces.smooth)

    def _begin(self, direct: "Direct") -> None:
        """Tell what solves contacts what else acts in a kick."""
        pull = self.forces.smooth
        if self.hand.hold:
            pull = pull + self.hand.pull(self._batch.velocity(), self.scene.agility, self.dt)
        direct.begin(pull, start=self._kicks_after == 0)

    def _collide(self) -> None:
        """Let one impact come after the other, if that is how the level wants them."""
        assert self._sequence
        self._sequence.collide(self.forces.smooth, start=self._kicks_after == 0)
        self.forces.older = self.forces.older + self._sequence.last.jump

    def _apply_forces(self) -> None:
        ahead = 0 if self._early else self._kicks_after
        self.forces.apply((self.steps + ahead) * self.dt, self._scale)

    def _start(self) -> Snapshot:
        """Observe the initial state; for leapfrog, also give the first half kick."""
        self._begun = start = self._batch.velocity()
        if self.scene.direct:
            self.scene.direct.forget()
        self._seen = -1, start
        if not self._leapfrog:
            self._joints.time(self.dt, self.dt)
            nowhere = np.full_like(start, np.nan)
            state = self._batch.state()
            return self._observer.snapshot(self.t, state, start, nowhere, NO_CONTACTS, np.nan)
        kick = self._last.kick / 2
        self._scale = 1.0
        if self.scene.gravity:
            self._space.gravity = self.scene.gravity.acceleration
        self._kicks_after, self.forces.older = 0, start
        with self._settling.held():
            after = self._settling.kick(start, kick, self._last.following, self.forces.smooth)
            self.contacts = self._read_contacts()
            begun = start + self._sequence.last.jump if self._sequence else start
            acceleration = (after - begun) / kick
            if self.stops:
                acceleration = self.stops.start(begun, acceleration)
                after = begun + acceleration * kick
                self.contacts = self._read_contacts()
            state = self._batch.state()
            if self._leading and self._joints.together:
                _, acceleration = self._joints.together.motion(start, self.forces.smooth)
            snapshot = self._observer.snapshot(
                self.t, state, start, acceleration, self.contacts, kick
            )
            if self.level.effects.contact and not self.scene.direct:
                # what pymunk remembers for the next step are impulses: leave it a whole step's
                self._settling.kick(start, self.dt, self.dt, self.forces.smooth)
                self._batch.set_velocity(after)
        if self.located:
            self.located.begin(begun, acceleration)
        self._joints.time(self.dt, self.dt)
        self._kicks_after = 1
        self.forces.start(begun, after)
        return snapshot

    def _observe(self, before: Array) -> None:
        """Take up the state, and let the watchdog look at it."""
        state = self._batch.state()
        self._seen = self.steps, state[:, 3:]
        if cutting := self.stops or self.located:
            before = cutting.begun
        self._begun = before
        contacts = self._read_contacts()
        rates = self._observer.rates(state, before, contacts, self.parts)
        if self.located:
            contacts = self.located.contacts().and_(contacts)
        self.snapshot = self._observer.snapshot(self.t, state, *rates, contacts, self.dt)
        self.contacts = contacts
        try:
            cut = bool(self.located and self.located.impacts)
            self._watchdog.look(self.snapshot, contacts, before, disturbed=self.disturbed, cut=cut)
        except SimulationError as error:
            self._ended, self.snapshot = error, self._watchdog.good
            raise

    def _read_contacts(self) -> Contacts:
        if not self.level.effects.contact:
            return NO_CONTACTS
        if direct := self.scene.direct:
            contacts = direct.contacts
        else:
            contacts = (self.stops and self.stops.kicked) or self._batch.contacts()
        touches = self._joints.touches
        return touches.with_latest(contacts) if touches else contacts

    def _make_watchdog(self) -> Watchdog:
        start, contacts = self.snapshot, self.contacts
        with np.errstate(all="ignore"):  # what is not finite is told by name
            audit = partial(Audit, self)
            dog = Watchdog(
                self.level, self.values, self.stepping, self.scene, start, contacts, audit
            )
            dog.look(start, contacts, self._seen[1], disturbed=True)
        return dog

    def _finish(self) -> None:
        """Do what belongs after a kick of pymunk's, and raise what went wrong in it."""
        if self._hook:
            self._hook.finish()
            if self._hook.error:
                self._fail(self._hook.error)

    def _fail(self, error: Exception) -> NoReturn:
        """Raise what a hook has kept; such a world has ended."""
        self._ended = error
        if isinstance(error, NoForces):
            names = list(self.scene.bodies)
            told = "no forces were found between '{}' and '{}'".format(
                *(names[b] for b in error.bodies)
            )
            rate = MARGIN * self.stepping.rate
            hint = way_out(rate, self.stepping.rate)
            self._ended = SimulationError(names[error.bodies[0]], self.t, told, rate, hint=hint)
        elif isinstance(error, JointFailure):
            finer = error.finer and error.finer * self.stepping.rate
            hint = way_out(finer, self.stepping.rate) if finer else ""
            self._ended = SimulationError(error.joint, self.t, str(error), finer, hint=hint)
        elif isinstance(error, EndlessImpacts):
            body = list(self.scene.bodies)[error.body]
            self._ended = SimulationError(body, self.t, str(error).format(body=f"'{body}'"))
        elif not isinstance(error, SandboxError):
            self._ended = BreakdownError(error, self.t)
        raise self._ended from error

    def grab(self, body: str, point: tuple[float, float]) -> None:
        """Take hold of a dynamic body at a point of the plane [m], as with a stiff spring.

        Raises
        ------
        SimulationError
            If the scene cannot go on with leapfrog, which a hand needs.
        """
        self._take_one_drift()
        self.hand.grab(list(self.scene.bodies).index(body), point)
        self.disturbed = True

    def _take_one_drift(self) -> None:
        """Go on with leapfrog where there were substeps: no hand pulls backwards in time."""
        if self._leading:
            scene, angle = self.scene, self.snapshot.angle
            check_springs(self._joints.springs, scene.agility, angle, self.stepping.rate)
            self._compose(LEAPFROG)
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

        Raises
        ------
        SimulationError
            If it cannot go on from there.
        """
        for name, position in positions.items():
            if self._fence and not self._fence.keeps_in(position):
                raise self._beyond(name)
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
