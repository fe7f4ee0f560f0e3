"""Running and measuring rows of an experiment, with identical results on any machine."""

import pickle
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import groupby
from time import perf_counter
from typing import NamedTuple

import numpy as np

from sandbox.experiments.observables import Observable, holds_at
from sandbox.experiments.plan import Plan, Row
from sandbox.experiments.results_table import Cell, columns
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.model.rules.conditions.numbers_and_shapes import MAX_STEPS
from sandbox.model.translatable_message import NOTHING
from sandbox.physics.ensemble.batched_runs import BatchStepper, can_be_batched, can_join
from sandbox.physics.measuring.recording import Trace, count_steps
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World

TOGETHER = 400
"""The most runs in a batch of arrays; larger ones hardly save time, but need more memory."""

LARGEST = 8_000_000
"""The most numbers that a batch may record."""


class Task(NamedTuple):
    """A range of rows to run."""

    plan: bytes
    """the plan, pickled by `pack`"""
    start: int
    stop: int


class TaskResults(NamedTuple):
    """The results of some rows, and the time they took [s]."""

    start: int
    stop: int
    columns: list[list[Cell]]
    """(R,) each, in the order of the table's columns"""
    seconds: float


class _Setting(NamedTuple):
    """The level, parameters and stepping of a row."""

    row: Row
    level: Level
    values: Values
    stepping: Stepping


class _Run(NamedTuple):
    """The run of a row, and whether the condition ended it; or the reason why there is no run."""

    row: Row
    trace: Trace | None
    stopped: bool
    failure: str | None


def pack(plan: Plan) -> bytes:
    """Pickle a plan; each process unpickles it only once for all its tasks."""
    return pickle.dumps(plan)


@lru_cache(maxsize=1)
def _unpacked(plan: bytes) -> Plan:
    return pickle.loads(plan)


def run(task: Task) -> TaskResults:
    """Run the rows of a task."""
    began = perf_counter()
    plan = _unpacked(task.plan)
    cells = list(measured(plan, task.start, task.stop))
    columns = [list(column) for column in zip(*cells, strict=True)]
    return TaskResults(task.start, task.stop, columns, perf_counter() - began)


def measured(plan: Plan, start: int, stop: int) -> Iterator[list[Cell]]:
    """Yield the cells of some rows, in the order of the table's columns."""
    for found in _runs(plan, plan.rows(start, stop)):
        yield _cells(plan, found)


def rows_per_batch(plan: Plan) -> int:
    """Return how many rows of a plan best share a batch of arrays: 1 if each runs alone."""
    setting = next(_settings(plan, plan.rows(0, 1)))
    if isinstance(setting, _Run) or _kind(plan, setting) is None:
        return 1
    return _batch_limit(plan, setting)


def _cells(plan: Plan, found: _Run) -> list[Cell]:
    """Return the cells of a row."""
    cells: list[Cell] = [found.row.number, *found.row.varied]
    failure, trace = found.failure, found.trace
    numbers: list[Cell] = [None] * len(columns(plan))
    if trace is not None:
        try:
            numbers = list(_numbers(plan, trace, stopped=found.stopped))
        except SandboxError as error:
            failure = str(error)
    return [*cells, *numbers, failure]


def _numbers(plan: Plan, trace: Trace, *, stopped: bool) -> Iterator[Cell]:
    until = float(trace.t[-1]) if stopped else None
    for measure in plan.measures:
        found = measure.measured(trace, until)
        value, t = found or (None, None)
        value = value if value is not None and np.isfinite(value) else None
        yield value
        if measure.of is not None and measure.check is not None:
            expected = measure.expected(trace, t)
            yield expected
            if value is None or expected is None:
                yield None
            else:
                yield measure.error(value, expected, trace)


def _runs(plan: Plan, rows: Iterator[Row]) -> Iterator[_Run]:
    """Yield the runs of all rows in their order, batched where possible."""
    for together, group in groupby(_settings(plan, rows), lambda s: _kind(plan, s)):
        if not together:
            yield from (_run_single(plan, setting) for setting in group)
            continue
        flock: list[_Setting] = []
        for setting in group:
            assert isinstance(setting, _Setting)
            flock.append(setting)
            if len(flock) == _batch_limit(plan, flock[0]):
                yield from _run_batch(plan, flock)
                flock = []
        yield from _run_batch(plan, flock)


def _settings(plan: Plan, rows: Iterator[Row]) -> "Iterator[_Setting | _Run]":
    for row in rows:
        try:
            yield _Setting(row, *plan.setting(row))
        except SandboxError as error:
            yield _Run(row, None, stopped=False, failure=str(error))


def _kind(plan: Plan, setting: "_Setting | _Run") -> tuple[int, str] | None:
    """Return a key that is equal for runs that can share a batch; None if they must run alone."""
    if isinstance(setting, _Run) or not can_be_batched(
        setting.level, setting.stepping, plan.quantities
    ):
        return None
    return id(setting.level), setting.stepping.model_dump_json()


def _batch_limit(plan: Plan, setting: _Setting) -> int:
    """Return the most such runs that may share a batch."""
    duration = plan.experiment.duration or setting.level.duration(setting.values)
    recorded = duration * setting.stepping.rate * len(plan.quantities)
    return int(max(min(TOGETHER, LARGEST / max(recorded, 1)), 1))


def _run_batch(plan: Plan, flock: Sequence[_Setting]) -> Iterator[_Run]:
    """Run rows in one batch of arrays; those that cannot share it run alone."""
    worlds: list[World | None] = []
    for setting in flock:
        try:
            world = build(setting.level, setting.values, setting.stepping)
        except SandboxError:
            worlds.append(None)  # running alone gives the reason
        else:
            worlds.append(world if can_join(world) else None)
    flying = [world for world in worlds if world]
    if len(flying) < 2:
        yield from (_run_single(plan, setting) for setting in flock)
        return
    stop = _Stop(plan.until) if plan.until else None
    steps = [_steps(plan, world) for world in flying]
    flights = iter(BatchStepper(flying, plan.quantities, steps, stop.first if stop else None).run())
    for setting, start in zip(flock, worlds, strict=True):
        found = next(flights) if start else None
        if found is None or found.trace is None:
            yield _run_single(plan, setting)
        else:
            yield _Run(setting.row, found.trace, found.has_stopped, None)


def _steps(plan: Plan, world: World) -> int:
    """Return the number of steps in a run that no condition ends."""
    steps = count_steps(world, plan.experiment.duration)
    return max(steps, 1)


def _run_single(plan: Plan, setting: "_Setting | _Run") -> _Run:
    """Run a single row."""
    if isinstance(setting, _Run):
        return setting
    stop = _Stop(plan.until) if plan.until else None
    try:
        duration = plan.experiment.duration or setting.level.duration(setting.values)
        if duration * setting.stepping.rate > MAX_STEPS:
            raise SandboxError(
                "{duration:g} s take more than {most:,} steps", duration=duration, most=MAX_STEPS
            )
        trace = simulate(
            setting.level,
            setting.values,
            duration,
            plan.quantities,
            setting.stepping,
            until=stop.now if stop else None,
        )
    except SandboxError as error:
        message = (
            error.with_advice(NOTHING) if isinstance(error, SimulationError) else error.message
        )
        return _Run(setting.row, None, stopped=False, failure=message)
    return _Run(setting.row, trace, bool(stop and stop.held), None)


class _Stop:
    """The condition that ends a run."""

    def __init__(self, condition: Observable) -> None:
        self._condition = condition
        self._meter: Meter | None = None
        self.held = False

    def now(self, world: World) -> bool:
        """Return whether it holds for a world now."""
        if self._meter is None:
            self._meter = Meter(world, ["t", *self._condition.quantities])
        columns = self._meter(world.snapshot)
        found = self._condition.over(columns, world.snapshot.t, world.values)
        self.held = bool(np.nan_to_num(found))
        return self.held

    def first(self, columns: Mapping[str, Array], t: Array, world: World) -> int | None:
        """Return the index of the first instant at which it holds; None if it never does."""
        return holds_at(self._condition, columns, t, world.values)
