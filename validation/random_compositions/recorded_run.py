"""A run of a random scene, recorded at every step."""

from dataclasses import dataclass, field
from math import ceil
from time import process_time

import numpy as np

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array
from sandbox.model.level import HIGHEST_RATE, Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.guarding.least_step_rate import required_rate
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from sandbox.physics.scene.stability_limits import MARGIN
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from validation.random_compositions.seeded_scenes import Scene

MOST_STEPS = 720
"""The most steps of a run; a run with a high rate is shorter."""

LIMIT = 20.0
"""The processor time that a run may take [s]: 28 ms for each of the most steps."""

TRIES = 8
"""The most rates that are tried in turn."""

Pairs = frozenset[tuple[int, int]]


class Refused(Exception):  # noqa: N818 (an outcome, and no error)
    """A scene that cannot start, with the reason."""


@dataclass(slots=True)
class RecordedRun:
    """The record of a run; T instants, the first at the start."""

    scene: Scene
    level: Level
    """The scene, and the level that was run."""
    rate: float
    """The rate of its steps [Hz]."""
    states: Snapshot
    """The states, with time as the first axis."""
    pairs: list[Pairs]
    """(T,), the pairs of bodies that touch at each instant, by their indices."""
    taut: Array
    """(T, j), which joints exert a force."""
    ledger_energy: Array
    """(T,), the energy in the ledger, in the middle of the drifts [J]."""
    unexplained: Array
    """(T,), the energy that the ledger cannot explain [J]."""
    lost_momentum: Array
    """(T, 3), the momentum that it cannot explain [N s, N s, N m s]."""
    worked: float
    """The energy that the scene's drives have put in, or taken out, at the end [J]."""
    intended_duration: float
    """The intended length of the run [s]."""
    failure: str = ""
    """Why it stopped earlier; empty if it did not."""
    advised: float | None = None
    """The rate at which it should not stop, if one is advised [Hz]."""

    @property
    def dt(self) -> float:
        """The step [s]."""
        return 1 / self.rate

    @property
    def steps(self) -> int:
        """The number of steps taken."""
        return len(self.pairs) - 1

    def undisturbed(self) -> int:
        """Return the number of steps before a contact begins or ends."""
        same = [pairs == self.pairs[0] for pairs in self.pairs[1:]]
        return same.index(False) if False in same else len(same)


def start(level: Level, rate: float | None = None) -> World:
    """Return the world of a level at the first rate that the sandbox accepts, from one on [Hz].

    Raises `Refused` if no sufficient rate is advised.
    """
    rate = rate or level.stepping.rate
    for _ in range(TRIES):
        try:
            world = build(level, stepping=level.stepping.at(rate))
        except SimulationError as error:
            if error.rate is None or error.rate <= rate:
                raise Refused(str(error)) from error
            rate = error.rate
            continue
        asked = required_rate(world.scene, world.snapshot)
        if MARGIN * asked <= rate:
            return world
        rate = ceil(MARGIN * asked)
        if rate > HIGHEST_RATE:
            raise Refused(f"needs a rate of {rate:,} Hz")
    raise Refused(f"needs ever higher rates, at last {rate:,} Hz")


def run_at_advised_rate(scene: Scene, level: Level) -> RecordedRun:
    """Run a level and, if it stops and a rate is advised, run it again at that rate.

    Raises `Refused` if it cannot start.
    """
    recorded = run(scene, level, start(level))
    for _ in range(TRIES):
        if recorded.advised is None or recorded.advised <= recorded.rate:
            break
        recorded = run(scene, level, start(level, recorded.advised), recorded.intended_duration)
    return recorded


def run(scene: Scene, level: Level, world: World, duration: float | None = None) -> RecordedRun:
    """Run a world, and record every step and its ledger.

    By default it is as long as the level, but has at most `MOST_STEPS` steps.
    """
    steps = count_steps(world, duration)
    if duration is None:
        steps = min(steps, MOST_STEPS)
    notes, limit = _Notes(world), LIMIT * max(1.0, steps / MOST_STEPS)
    failure, advised, deadline = "", None, process_time() + limit
    with np.errstate(all="ignore"):
        for _ in range(steps):
            try:
                world.advance()
                notes.take()
            except SandboxError as error:
                failure, advised = str(error), getattr(error, "rate", None)
                break
            if process_time() > deadline:
                failure = f"took more than {limit:g} s"
                break
    return notes.recorded_run(scene, level, steps * world.dt, failure, advised)


@dataclass(slots=True)
class _Notes:
    """The notes on a run in progress."""

    world: World
    ledger: Ledger = field(init=False)
    states: list[Snapshot] = field(init=False)
    pairs: list[Pairs] = field(init=False)
    ledger_energy: list[float] = field(init=False)
    unexplained: list[float] = field(init=False)
    lost_momentum: list[Array] = field(init=False)

    def __post_init__(self) -> None:
        self.ledger = Ledger(self.world)
        self.states, self.pairs = [self.world.snapshot], [_pairs(self.world)]
        self.ledger_energy = [self.ledger.balance.energy]
        self.unexplained, self.lost_momentum = [0.0], [np.zeros(3)]

    def take(self) -> None:
        """Record a step."""
        self.ledger.note()
        balance = self.ledger.balance
        self.states.append(self.world.snapshot)
        self.pairs.append(_pairs(self.world))
        self.ledger_energy.append(balance.energy)
        self.unexplained.append(balance.unexplained)
        self.lost_momentum.append(balance.unexplained_impulse)

    def recorded_run(
        self, scene: Scene, level: Level, asked: float, failure: str, advised: float | None
    ) -> RecordedRun:
        """Return the complete record."""
        seen = Snapshot.stack(self.states)
        return RecordedRun(
            scene, level, self.world.stepping.rate, seen, self.pairs,
            seen.tension != 0, np.array(self.ledger_energy), np.array(self.unexplained),
            np.array(self.lost_momentum),
            sum(map(abs, self.ledger.balance.work.values())), asked, failure, advised,
        )  # fmt: skip


def _pairs(world: World) -> Pairs:
    return frozenset(map(tuple, np.sort(world.contacts.bodies, axis=1).tolist()))


def positions(level: Level, rate: float, steps: int, every: int) -> Snapshot:
    """Return states of a level at another rate, a number of steps apart.

    Raises `SandboxError` if the run stops before the last state, or takes too long.
    """
    world = build(level, stepping=level.stepping.at(rate))
    seen, deadline = [world.snapshot], process_time() + LIMIT
    with np.errstate(all="ignore"):
        for _ in range(steps):
            seen.append(world.advance(every))
            if process_time() > deadline:
                raise SandboxError("took more than {limit:g} s", limit=LIMIT)
    return Snapshot.stack(seen)
