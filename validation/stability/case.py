"""Hard cases and frontiers, and running their scenes."""

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
"""A function that reads a number off a run."""

LOOKS = 600
"""The least number of observations of a run, if it has so many steps."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HardCase:
    """A scene that must hold.

    Attributes
    ----------
    name
        The claim, in a few words.
    family
        The module that it comes from.
    group
        A: should be exact; B: should converge; C: should stand; D: beyond pymunk's own solver.
    level
        The name of the level, such as `hard/stack-of-15`.
    criterion
        The meaning of the figure, and the origin of the bound.
    figure, bound
        The figure of a run, and its bound.
    duration, quick
        The length of the run, and of a quick run [s]; None for the level's own.
    rate
        The rate [Hz]; None for the level's own.
    parameters
        The parameters that differ from the level's defaults.
    scene
        A variation of the level, if that is run instead of the level itself.
    order
        The least power of the step with which the figure must fall; None if it claims none.
    every_step
        Whether every step is observed, instead of some hundreds.
    special
        A function of the level and the duration that returns the figure, if one run is not enough.
    beyond
        Why it is out of reach, if it is; then it is shown, but is not a failure.
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
    """The difficulty up to which a scene stays within its bound.

    Attributes
    ----------
    name, family
        As for a case.
    axis, unit
        The quantity that makes it harder.
    scene
        The level at a given difficulty; the cost of its stepping is the budget for pymunk as well.
    figure, bound, criterion
        As for a case.
    start, end
        The least difficulty, and the one at which the search ends.
    duration
        The length of a run [s].
    whole
        Whether the difficulty is a whole number.
    over_time
        Whether the difficulty is the time until which the bound holds; `end` is then the duration.
    tolerance
        The factor by which the frontier may recede.
    beyond
        Why it is nearer than that of pymunk, if it is.
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
    """Run a world, sample it at intervals, and return the samples.

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
    """Return the figure of a run, the run, and why it stopped; the figure is infinite if it did."""
    try:
        with np.errstate(all="ignore"):
            seen = run()
            value = figure(seen)
    except SimulationError as error:
        return inf, None, str(error)
    return (value if np.isfinite(value) else inf), seen, ""


def make(document: Document) -> Level:
    """Return a level from the content of its file."""
    return parse(json.dumps(document))
