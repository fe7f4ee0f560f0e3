"""Many runs in one batch of arrays, for scenes with gravity and exact joints but no contacts.

Each run starts as a world of its own, with its first kick. From there on all runs step together:
drifts and kicks use the same arithmetic as pymunk, joints are solved by `ManyJoints`, and each
world has its own `Meter`. On x86-64 each run ends with the same bits as if run alone. A run that
would be stopped, or is close to it, is taken out and run alone.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.level import Level, Stepping
from sandbox.model.quantities import Quantity, quantity
from sandbox.physics.engine.space_arrays import Booleans, Integers
from sandbox.physics.joints.exact.joints_of_many_runs import ManyJoints
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.state.motion import Instant, kinetic_energy
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World

CHUNK = 500
"""The steps between two checks of the measurements."""

DOUBTED = 0.25
"""The relative gain of energy above which a run is taken out and run alone. The watchdog stops runs
at a gain of this, or more."""

_UNKNOWN = ("tension", "push", "torque", "normal", "friction", "contact.normal", "contact.friction")
"""Quantities that only a world of its own can measure."""

Stop = Callable[[Mapping[str, Array], Array, World], int | None]
"""Returns the row, among some instants, at which a run is over; None if it continues."""


def can_be_batched(level: Level, stepping: Stepping, names: Sequence[str]) -> bool:
    """Return whether runs that measure quantities may share a batch, judging by the level."""
    no_motions = all(body.type != "kinematic" for body in level.bodies.values())
    simple = stepping.scheme == "leapfrog" and set(level.effects.declared) <= _EFFECTS
    no_events = no_motions and not level.has_events
    return simple and no_events and all(_is_available(quantity(name, level)) for name in names)


_EFFECTS = {"gravity", "rotation"}


def _is_available(name: Quantity) -> bool:
    return name.is_momentary and name.attribute not in _UNKNOWN


def can_join(world: World) -> bool:
    """Return whether a world may be in a batch: all its joints are lengths, solved together."""
    joints = world.scene.joints
    others = joints.strings or joints.own or joints.springs or joints.wires
    return not others and (joints.together is None or joints.together.plain)


@dataclass(slots=True)
class BatchedRun:
    """The outcome of a run."""

    trace: Trace | None
    """The recorded run; None if it must be run alone."""
    has_stopped: bool
    """Whether a condition ended it."""


class BatchStepper:
    """Steps N worlds of one level together, from right after their start, and records quantities.

    The worlds are all accepted, with the same bodies and joints and the same step. `steps` is the
    number of steps of each; the condition `stop` ends a run early.
    """

    def __init__(
        self, worlds: Sequence[World], names: Sequence[str], steps: Sequence[int], stop: Stop | None
    ) -> None:
        self._worlds, self._stop = worlds, stop
        self._steps = np.array(steps)
        self._dt = worlds[0].dt
        self._meters = [Meter(world, names) for world in worlds]
        self._columns: list[list[dict[str, Array]]] = [
            [{n: np.atleast_1d(c) for n, c in meter(world.snapshot).items()}]
            for meter, world in zip(self._meters, worlds, strict=True)
        ]
        self._finished: list[BatchedRun | None] = [None] * len(worlds)
        self._running = np.arange(len(worlds))
        state = np.array([world.scene.batch.state() for world in worlds])
        self._pose, self._velocity = state[:, :, :3].copy(), state[:, :, 3:].copy()
        self._is_movable = np.array([world.scene.mass > 0 for world in worlds])
        self._kick = np.array([_gravity(world) for world in worlds]) * self._dt
        self._kick = np.where(self._is_movable[:, :, None], self._kick[:, None], 0.0)
        together = [j for world in worlds if (j := world.scene.joints.together)]
        self._joints = ManyJoints(together, self._dt) if together else None
        self._energies = _Energies(worlds)

    def run(self) -> list[BatchedRun]:
        """Run all worlds to their ends."""
        taken = 0
        with np.errstate(all="ignore"):  # runs with non-finite values are run alone
            while len(self._running):
                count = int(min(CHUNK, self._steps[self._running].max() - taken))
                uncertain = self._chunk(taken, count) if count else None
                taken += count
                self._store_finished(taken, uncertain)
        return [outcome or BatchedRun(None, has_stopped=False) for outcome in self._finished]

    def _chunk(self, taken: int, count: int) -> Booleans:
        """Take a number of steps, measure them, and return which runs must be run alone: (N,)."""
        shape = len(self._running), count, self._pose.shape[1], 3
        pose, velocity, acceleration = np.empty(shape), np.empty(shape), np.empty(shape)
        uncertain = np.zeros(len(self._running), dtype=bool)
        for i in range(count):
            before = self._velocity
            uncertain |= self._step()
            pose[:, i] = self._pose
            velocity[:, i] = (before + self._velocity) / 2
            acceleration[:, i] = (self._velocity - before) / self._dt
        uncertain |= self._energies.uncertain(self._running, pose, velocity)
        t = self._times(taken + 1, taken + count)
        for at, run in enumerate(self._running):
            columns = _measured(self._meters[run], t, pose[at], velocity[at], acceleration[at])
            self._columns[run].append(columns)
        return uncertain

    def _step(self) -> Booleans | bool:
        """Take a step, and return which runs must be repeated alone: (N,)."""
        self._pose = self._pose + self._velocity * self._dt
        velocity = self._velocity.copy()
        velocity[:, :, :2] = velocity[:, :, :2] + self._kick
        if self._joints is None:
            self._velocity = velocity
            return False
        self._velocity, uncertain = self._joints.solve(self._pose, velocity)
        return uncertain

    def _store_finished(self, taken: int, uncertain: Booleans | None) -> None:
        """Store the runs that are over, and keep the others."""
        going = np.ones(len(self._running), dtype=bool)
        for at, run in enumerate(self._running):
            if uncertain is not None and uncertain[at]:
                self._finished[run], going[at] = BatchedRun(None, has_stopped=False), False
            elif outcome := self._outcome(int(run), taken):
                self._finished[run], going[at] = outcome, False
        if going.all():
            return
        self._running = self._running[going]
        self._pose, self._velocity = self._pose[going], self._velocity[going]
        self._kick = self._kick[going]
        if self._joints:
            self._joints.keep(going)

    def _outcome(self, run: int, taken: int) -> BatchedRun | None:
        """Return the outcome of a run; None if it has not ended."""
        parts, world = self._columns[run], self._worlds[run]
        if self._stop and len(parts) > 1:
            last = parts[-1]
            t = self._times(taken - len(next(iter(last.values()))) + 1, taken)
            at = self._stop(last, t, world)
            if at is not None and (end := taken - len(t) + at + 1) <= self._steps[run]:
                return BatchedRun(self._trace(run, end), has_stopped=True)
        if taken < self._steps[run]:
            return None
        return BatchedRun(self._trace(run, int(self._steps[run])), has_stopped=False)

    def _times(self, first: int, last: int) -> Array:
        """Return the times of some steps, as a world counts them [s]."""
        return np.asarray(np.arange(first, last + 1) * self._dt, dtype=float)

    def _trace(self, run: int, steps: int) -> Trace:
        world, parts = self._worlds[run], self._columns[run]
        columns = {n: np.concatenate([part[n] for part in parts])[: steps + 1] for n in parts[0]}
        units = {name: found.unit for name, found in self._meters[run].quantities.items()}
        t = self._times(0, steps)
        self._columns[run] = []
        return Trace(world.level, world.values, world.stepping, t, columns, units, {}, {})


class _Energies:
    """Checks whether runs have gained energy, kinetic and that of gravity."""

    def __init__(self, worlds: Sequence[World]) -> None:
        self._mass = np.array([world.scene.mass for world in worlds])
        self._moment = np.array([world.scene.moment for world in worlds])
        self._gravity = np.array([_gravity(world) for world in worlds])
        self._min_energy = np.full(len(worlds), np.inf)
        self._min_potential = np.full(len(worlds), np.inf)

    def uncertain(self, runs: Integers, pose: Array, velocity: Array) -> Booleans:
        """Return which runs must be run alone, (N,), given arrays (N, T, n, 3)."""
        mass, moment = self._mass[runs, None], self._moment[runs, None]
        fall = np.einsum("ntbc,nc->ntb", pose[..., :2], self._gravity[runs])
        potential = -(mass * fall).sum(axis=-1)
        motion = Instant.at(0.0, pose, velocity)
        energy = potential + kinetic_energy(mass, moment, motion).sum(axis=-1)
        self._min_energy[runs] = np.minimum(self._min_energy[runs], energy.min(axis=1))
        self._min_potential[runs] = np.minimum(self._min_potential[runs], potential.min(axis=1))
        available = self._min_energy[runs] - self._min_potential[runs]
        is_bounded = energy.max(axis=1) - self._min_energy[runs] <= DOUBTED * available
        return ~(is_bounded & np.isfinite(energy).all(axis=1))


def _gravity(world: World) -> tuple[float, float]:
    gravity = world.scene.gravity
    return gravity.acceleration if gravity else (0.0, 0.0)


def _measured(
    meter: Meter, t: Array, pose: Array, velocity: Array, acceleration: Array
) -> dict[str, Array]:
    """Return the quantities at T instants of one run, given arrays (T, n, 3)."""
    nothing = np.zeros(pose.shape[:2])
    none = np.zeros((len(t), 0))
    return meter(
        Snapshot(
            t=t,
            position=pose[..., :2],
            angle=pose[..., 2],
            velocity=velocity[..., :2],
            angular_velocity=velocity[..., 2],
            acceleration=acceleration[..., :2],
            angular_acceleration=acceleration[..., 2],
            normal=nothing,
            friction=nothing,
            tension=none,
            torque=none,
        )
    )
