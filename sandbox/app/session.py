"""A level being played: the world, its record, and how fast it runs. No window is needed.

The time step belongs to the level. A frame only decides how many whole steps are due; what cannot
be paid for within its budget is dropped and shown as a lower pace, never stretched.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from sandbox.app import milestones
from sandbox.app.clock import Clock
from sandbox.app.companions import NONE, Changes, Companion, Variant
from sandbox.app.grading import Grading, Reading
from sandbox.app.milestones import Milestone
from sandbox.app.pace import Pace, faster, slower
from sandbox.app.trail import Trail
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level
from sandbox.model.loading import choose
from sandbox.model.shapes import XY
from sandbox.physics.errors import SimulationError
from sandbox.physics.ledger import Balance, Ledger
from sandbox.physics.measure import Meter
from sandbox.physics.trace import Recorder, Trace, count_steps, needed
from sandbox.physics.world import World, build

INSTANTS = 500
"""At about how many instants of a level's duration the energies are kept."""

BUDGET = 0.009  # s, of a frame for steps
_ENERGIES = ("system.kinetic_energy", "system.potential_energy", "system.energy")


@dataclass(frozen=True, slots=True)
class Energies:
    """Of the whole system [J]."""

    kinetic: float
    potential: float
    total: float


class Session:
    """A level that is played.

    Attributes
    ----------
    original
        The level as its file declares it.
    level
        What is played: the original, or with other effects, or with another stepping.
    changes
        Which effects were switched off and on.
    companions
        Other runs beside it, in lockstep.
    clock
        What the steps take.
    world
        Its present run.
    end
        How many steps reach the level's duration.
    playing, speed
        Whether time passes by itself, and how fast.
    failure
        Why the run had to stop, or could not be built; None if all is well.
    trail
        Where the bodies have been.
    pace
        Whether the machine keeps up.

    Raises
    ------
    SandboxError
        If the level cannot be run with these values.
    """

    def __init__(
        self, level: Level, values: Values | None = None, rate: float | None = None
    ) -> None:
        self.original = level
        self.level = _at(level, rate)
        self.changes = NONE
        self.playing = False
        self.speed = 1.0
        self._begin(build(self.level, values), ())

    def _begin(self, world: World, companions: Sequence[Companion]) -> None:
        self.world = world
        self.companions = tuple(companions)
        self.clock = Clock()
        self.failure: SandboxError | None = None
        self.end = count_steps(world)
        self.trail = Trail(world.snapshot.position)
        self.pace = Pace()
        self._ledger = Ledger(world)
        self._recorder = Recorder(world, [*needed(self.original), *milestones.needed(self.level)])
        self._grading = Grading(self._recorder)
        self._owed = 0.0  # steps
        self._meter = Meter(world, _ENERGIES)
        self._start = self.energies()
        self._every = max(self.end // INSTANTS, 1)
        self._history = Trail(self._energies_at())
        self._held: tuple[str, XY] | None = None
        self._pulling = False

    @property
    def values(self) -> Values:
        """The parameters of the present run."""
        return self.world.values

    @property
    def t(self) -> float:
        """The time of what is shown [s]."""
        return float(self.world.snapshot.t)

    @property
    def duration(self) -> float:
        """The time at which the run pauses by itself [s]."""
        return self.end * self.world.dt

    @property
    def at_end(self) -> bool:
        """Whether the run stands where its level says that it is complete."""
        return self.world.steps == self.end

    def restart(self, settings: Mapping[str, float] | None = None) -> None:
        """Start anew, with some parameters changed.

        Raises
        ------
        ValueRangeError
            If a parameter cannot have that value.
        """
        values = choose(self.level, {**self.values, **(settings or {})})
        variants = [companion.variant for companion in self.companions]
        try:
            self._begin(*self._built(self.level, variants, values))
        except SandboxError as error:
            self._stop(error)

    @property
    def advised(self) -> float | None:
        """The rate at which a run that had to stop should hold; None if none is known [Hz]."""
        return self.failure.rate if isinstance(self.failure, SimulationError) else None

    def rerun(self, rate: float) -> None:
        """Play anew at another rate, from now on [Hz]."""
        self.level = _at(self.level, rate)
        self.restart()
        self.playing = self.failure is None

    def play_as(
        self, level: Level, beside: Sequence[Variant] = (), changes: Changes = NONE
    ) -> None:
        """Start anew with another form of the level, and with other runs beside it.

        Parameters
        ----------
        level
            The original, with other effects or another stepping.
        beside
            What runs beside it.
        changes
            The effects in which it differs from the original.

        Raises
        ------
        SandboxError
            If one of them cannot be run; then all stays as it was.
        """
        begun = self._built(level, beside, self.values)
        self.level, self.changes = level, changes
        self._begin(*begun)

    @staticmethod
    def _built(
        level: Level, beside: Sequence[Variant], values: Values
    ) -> tuple[World, list[Companion]]:
        world = build(level, values)
        return world, [Companion(variant, values) for variant in beside]

    def toggle(self) -> None:
        """Play, or pause."""
        self.playing = not self.playing and self.failure is None

    def step(self) -> None:
        """Pause, and take a single step."""
        self.playing = False
        self._advance()

    def faster(self) -> None:
        """Take the next higher speed."""
        self.speed = faster(self.speed)

    def slower(self) -> None:
        """Take the next lower speed."""
        self.speed = slower(self.speed)

    def update(self, seconds: float, budget: float = BUDGET) -> None:
        """Take the steps that are due after some real time, as far as the budget goes [s]."""
        if not self.playing:
            return
        self._owed += seconds * self.speed * self.world.stepping.rate
        due = int(self._owed)
        self._owed -= due
        taken = self._take(due, budget)
        dropped = due - taken if self.playing else 0
        self.pace.note(seconds, taken * self.world.dt, dropped)

    def _take(self, due: int, budget: float) -> int:
        deadline = perf_counter() + budget
        for taken in range(due):
            if not self.playing or (taken and perf_counter() > deadline):
                return taken
            self._advance()
        return due

    def _advance(self) -> None:
        if self.failure is not None:
            return
        try:
            with self.clock.running():
                snapshot = self.world.advance()
        except SandboxError as error:
            self._stop(error)
            return
        self._ledger.note()
        for companion in self.companions:
            companion.follow(self.t)
        self.trail.add(snapshot.position)
        if self.world.steps % self._every == 0:
            self._history.add(self._energies_at())
        if self.world.steps <= self.end and not self.world.disturbed:
            self._recorder.note()
        if self.at_end:
            self.playing = False

    def _stop(self, error: SandboxError) -> None:
        self.failure = error
        self.playing = False

    def readings(self) -> tuple[Reading, ...]:
        """Return how the checks stand."""
        return self._grading.readings(hurried=self.playing)

    def milestones(self) -> tuple[Milestone, ...]:
        """Return what has happened; nothing that counts once a hand has touched the run."""
        if self.world.disturbed:
            return ()
        self.readings()
        return self._grading.milestones

    @property
    def trace(self) -> Trace:
        """What was recorded of the run so far."""
        return self._recorder.trace

    def energies(self) -> Energies:
        """Return the energies of now."""
        return Energies(*(float(value) for value in self._meter(self.world.snapshot).values()))

    @property
    def balance(self) -> Balance:
        """The books of the run, from its start or from where a hand last put a body."""
        return self._ledger.balance

    @property
    def start_energies(self) -> Energies:
        """The energies with which the run began."""
        return self._start

    @property
    def history(self) -> Array:
        """Energies over time: (k, 4), [s], then kinetic, potential and total [J], up to now."""
        return np.vstack((self._history.points, self._energies_at()))

    def _energies_at(self) -> Array:
        now = self.energies()
        return np.array([self.t, now.kinetic, now.potential, now.total])

    def grab(self, body: str, point: XY) -> None:
        """Take hold of a body at a point [m]; nothing happens to it before `drag`."""
        x, y = self._position(body)
        self._held = body, (point[0] - x, point[1] - y)

    def drag(self, point: XY) -> None:
        """Pull what is held to a point [m]: while time runs with a force, else put it there."""
        if self._held is None or self.failure is not None:
            return
        body, (dx, dy) = self._held
        if not self.playing:
            self._let_loose()
            self._place(body, (point[0] - dx, point[1] - dy))
            return
        if not self._pulling:
            x, y = self._position(body)
            self.world.grab(body, (x + dx, y + dy))
            self._pulling = True
        self.world.drag(point)

    def release(self) -> None:
        """Let go."""
        self._let_loose()
        self._held = None

    def _let_loose(self) -> None:
        if self._pulling:
            self.world.release()
            self._pulling = False

    def _position(self, body: str) -> XY:
        row = list(self.level.bodies).index(body)
        x, y = self.world.snapshot.position[row]
        return float(x), float(y)

    def _place(self, body: str, point: XY) -> None:
        try:
            snapshot = self.world.place({body: point})
        except SandboxError as error:
            self._stop(error)
            return
        self._ledger = Ledger(self.world)
        self.trail.restart(snapshot.position)
        self._history.restart(self._energies_at())


def _at(level: Level, rate: float | None) -> Level:
    """Return a level, at another rate if one is given [Hz]."""
    if rate is None:
        return level
    return level.model_copy(update={"stepping": level.stepping.at(float(rate))})
