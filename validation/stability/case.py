"""Hard cases and frontiers, and how their scenes are run."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import inf
from time import process_time

import numpy as np

from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from validation.stability.run_measures import Run
from validation.stability.scene import Document

Figure = Callable[[Run], float]
"""A number that is read off a run."""

LOOKS = 600
"""The observations of a run, at least, if it has so many steps."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HardCase:
    """A scene that must hold.

    Attributes
    ----------
    name
        The claim, in a few words.
    family
        The file it comes from.
    group
        A: should be exact; B: should converge; C: should stand; D: beyond pymunk's own solver.
    level
        Such as `hard/stack-of-15`.
    criterion
        What the figure is, and where the bound comes from.
    figure, bound
        The figure that is read off a run, and its bound.
    duration, quick
        How long it runs, and how long in a quick run [s]; as the level says if None.
    rate
        Hz; the level's own if None.
    parameters
        Those that differ from the level's defaults.
    scene
        A variation of the level, if it is not the level itself that is run.
    order
        The power of the step by which the figure must fall at least; None if it claims none.
    every_step
        Whether every step is looked at, instead of some hundreds.
    special
        Where no figure of one run will do: what gives it, from the level and the duration.
    beyond
        Why it is out of reach, if it is; then it is shown, and does not count as a failure.
    """

    name: str
    family: str
    group: str
    level: str
    criterion: str
    bound: float
    figure: Figure | None = None
    duration: float | None = None
    quick: float | None = None
    rate: float | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    scene: Document | None = None
    order: float | None = None
    every_step: bool = False
    special: Callable[[Level, float], float] | None = None
    beyond: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Frontier:
    """How hard a scene can be made until its bound breaks.

    Attributes
    ----------
    name, family
        As of a case.
    axis, unit
        What makes it harder.
    scene
        The level at a difficulty; its own stepping is the budget, which pymunk must not exceed.
    figure, bound, criterion
        As of a case.
    start, end
        The least difficulty, and that at which the search ends.
    duration
        How long a run lasts [s].
    whole
        Whether the difficulty is a whole number.
    over_time
        Whether the difficulty is the time until which the bound holds; `end` is then the duration.
    tolerance
        The factor by which the frontier may recede.
    beyond
        Why it lies further in than that of pymunk, if it does.
    """

    name: str
    family: str
    axis: str
    scene: Callable[[float], Document]
    figure: Figure
    bound: float
    criterion: str
    start: float
    end: float
    duration: float = 5.0
    unit: str = ""
    whole: bool = False
    over_time: bool = False
    tolerance: float = 1.25
    beyond: str | None = None


def watch(level: Level, world: World, duration: float, *, every_step: bool = False) -> Run:
    """Run a world, sample it now and then, and return the samples.

    Raises
    ------
    SimulationError
        If the run had to stop.
    """
    steps = count_steps(world, duration)
    stride = 1 if every_step else max(1, steps // LOOKS)
    first, start = world.snapshot, process_time()
    seen = [first, *(world.advance(stride) for _ in range(steps // stride))]
    seconds = (process_time() - start) / world.t
    return Run(level, world, Snapshot.stack(seen), seconds)


def figure_of(figure: Figure, run: Callable[[], Run]) -> tuple[float, Run | None, str]:
    """Return the figure of a run, infinite if it had to stop, and why it stopped."""
    try:
        with np.errstate(all="ignore"):
            seen = run()
            value = figure(seen)
    except SimulationError as error:
        return inf, None, str(error)
    return (value if np.isfinite(value) else inf), seen, ""


def make(document: Document) -> Level:
    """Return a level from what its file would say."""
    return parse(json.dumps(document))
