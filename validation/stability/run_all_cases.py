"""Running cases and frontiers on all cores."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import inf, log2, nan
from time import perf_counter

import numpy as np

from sandbox.model.level import Level
from sandbox.model.level_catalog import find
from sandbox.model.loading import choose, load
from sandbox.parallel_processes import spread
from sandbox.physics.run import build
from validation.stability.families import all_cases, all_frontiers
from validation.stability.frontier import QUICK_TIME, reach, trial
from validation.stability.frontier_history import last, moved_inward, read
from validation.stability.hard_case import Frontier, HardCase, figure_of, make, watch
from validation.stability.run_measures import Run

HALVINGS = 2
"""How often the step is halved, down to the level's own, to measure the order."""


LONG = 500_000
"""The number of steps above which a case takes longer than most frontiers."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of a case or a frontier."""

    name: str
    family: str
    group: str
    criterion: str
    bound: float
    beyond: str | None
    """As in the case; a frontier has no group."""
    passed: bool
    """Whether the figure is within its bound; for a frontier, whether it has not receded."""
    figure: float
    """The figure of the run; for a frontier, of the hardest run that held."""
    cost: float = nan
    """The processor time per second of the scene [s]."""
    order: float | None = None
    """The power of the step with which the figure falls, if the case claims one."""
    axis: str | None = None
    unit: str | None = None
    """The quantity that makes a frontier harder."""
    frontier: float | None = None
    naive_frontier: float | None = None
    """The greatest difficulty that holds, here and for pymunk alone at the same cost."""
    previous: float | None = None
    """The frontier in its last entry."""
    rate: float | None = None
    naive_rate: float | None = None
    """The rates of the steps at the two frontiers [Hz]."""
    seconds: float = 0.0
    """The total time [s]."""
    failure: str = ""
    """Why a run stopped, if it did."""


def outcomes(*, quick: bool) -> Iterator[Outcome]:
    """Yield the outcomes of all cases and frontiers as they finish; the long ones start first."""
    steps = {case.name: _steps(case, quick=quick) for case in all_cases()}
    frontiers = [frontier.name for frontier in all_frontiers()]
    long = [name for name in steps if steps[name] >= LONG]
    short = [name for name in steps if steps[name] < LONG]
    names = [*long, *frontiers, *short]
    for _, outcome in spread(partial(run, quick=quick), names):
        yield outcome


def run(name: str, *, quick: bool) -> Outcome:
    """Run a case, or search for a frontier."""
    is_case = any(case.name == name for case in all_cases())
    return (run_case if is_case else run_frontier)(name, quick=quick)


def run_case(name: str, *, quick: bool) -> Outcome:
    """Run a case."""
    case = next(case for case in all_cases() if case.name == name)
    begin = perf_counter()
    level = scene(case)
    duration = _duration(case, level, quick=quick)
    order = None
    if case.special:
        figure, run, failure = case.special(level, duration), None, ""
    else:
        figure, run, failure = _figure(case, level, duration)
        if case.order is not None and np.isfinite(figure):
            order = _order(case, level, duration, figure)
    passed = figure <= case.bound and (case.order is None or (order or 0) >= case.order)
    return Outcome(
        case.name, case.family, case.group, case.criterion, case.bound, case.beyond, passed, figure,
        cost=run.seconds if run else nan, order=order, seconds=perf_counter() - begin,
        failure=failure,
    )  # fmt: skip


def _duration(case: HardCase, level: Level, *, quick: bool) -> float:
    """Return the length of a case's run [s]."""
    return (case.quick if quick else None) or case.duration or level.duration(level.defaults)


def _steps(case: HardCase, *, quick: bool) -> float:
    """Return the number of steps of a case."""
    level = scene(case)
    return _duration(case, level, quick=quick) * (case.rate or level.stepping.rate)


def scene(case: HardCase) -> Level:
    """Return the level of a case, with its parameters set."""
    level = make(case.scene) if case.scene else load(find(case.level))
    values = choose(level, case.parameters)
    parameters = {
        name: parameter.model_copy(update={"value": values[name]})
        for name, parameter in level.parameters.items()
    }
    return level.model_copy(update={"parameters": parameters})


def _figure(
    case: HardCase, level: Level, duration: float, coarser: float = 1.0
) -> tuple[float, Run | None, str]:
    """Return the figure of a run with a longer step, the run, and the reason if it stopped."""
    assert case.figure
    rate = (case.rate or level.stepping.rate) / coarser
    stepping = level.stepping.model_copy(update={"rate": rate})

    def run() -> Run:
        world = build(level, stepping=stepping)
        return watch(level, world, duration, every_step=case.every_step)

    return figure_of(case.figure, run)


def _order(case: HardCase, level: Level, duration: float, figure: float) -> float:
    """Return the slope of log figure over log step."""
    coarser = [_figure(case, level, duration, 2**i)[0] for i in range(1, HALVINGS + 1)]
    figures = [figure, *coarser]
    if not all(0 < f < inf for f in figures):
        return 0.0
    return float(np.polyfit(range(len(figures)), [log2(f) for f in figures], 1)[0])


def run_frontier(name: str, *, quick: bool) -> Outcome:
    """Search for a frontier; in a quick run, check whether it is still where it was."""
    frontier = next(frontier for frontier in all_frontiers() if frontier.name == name)
    before = last(read(), name)
    begin = perf_counter()
    if quick and before:
        return _still_there(frontier, before["figure"], before["naive"], begin)
    here, alone = reach(frontier), reach(frontier, alone=True)
    passed = here.difficulty > 0 and not moved_inward(here.difficulty, before, frontier.tolerance)
    return Outcome(
        frontier.name, frontier.family, "", frontier.criterion, frontier.bound, frontier.beyond,
        passed, here.figure, cost=here.cost, axis=frontier.axis, unit=frontier.unit,
        frontier=here.difficulty, naive_frontier=alone.difficulty,
        previous=before["figure"] if before else None, rate=here.rate, naive_rate=alone.rate,
        seconds=perf_counter() - begin,
    )  # fmt: skip


def _still_there(frontier: Frontier, before: float, naive: float, begin: float) -> Outcome:
    """Try a frontier once, at its last difficulty reduced by the tolerance."""
    inside = before / frontier.tolerance
    if frontier.whole:
        inside = max(float(int(inside)), frontier.start)
    if frontier.over_time:
        inside = min(inside, QUICK_TIME)
        frontier = replace(frontier, duration=inside)
    tried = trial(frontier, inside)
    return Outcome(
        frontier.name, frontier.family, "", frontier.criterion, frontier.bound, frontier.beyond,
        tried.figure <= frontier.bound, tried.figure, cost=tried.cost, axis=frontier.axis,
        unit=frontier.unit, frontier=before, naive_frontier=naive, previous=before,
        rate=tried.rate, seconds=perf_counter() - begin,
    )  # fmt: skip
