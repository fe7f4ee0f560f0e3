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
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from validation.stability.run_measures import Run
from validation.stability.scene_parts import Document

Figure = Callable[[Run], float]
"""A function that reads a number off a run."""

LOOKS = 600
"""The least number of observations of a run, if it has so many steps."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HardCase:
    """A scene, and the bound that its figure must keep."""

    name: str
    """The claim, in a few words."""
    family: str = ""
    """The module that it comes from; set by `all_cases`."""
    group: str
    """A: should be exact; B: should converge; C: should stand; D: beyond pymunk's own solver."""
    level: str
    """The name of the level, such as `hard/stack-of-15`."""
    criterion: str
    """The meaning of the figure, and the origin of the bound."""
    bound: float
    """The bound of the figure."""
    figure: Figure | None = None
    """The figure of a run."""
    duration: float | None = None
    quick: float | None = None
    """The length of the run, and of a quick run [s]; None for the level's own."""
    rate: float | None = None
    """The rate [Hz]; None for the level's own."""
    parameters: Mapping[str, float] = field(default_factory=dict)
    """The parameters that differ from the level's defaults."""
    scene: Document | None = None
    """A variation of the level, if that is run instead of the level itself."""
    order: float | None = None
    """The least power of the step with which the figure must fall; None if it claims none."""
    every_step: bool = False
    """Whether every step is observed, instead of some hundreds."""
    special: Callable[[Level, float], float] | None = None
    """A function of level and duration that returns the figure, if one run is not enough."""
    beyond: str | None = None
    """Why it is out of reach, if it is; then it is shown, but is not a failure."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Frontier:
    """The difficulty up to which a scene stays within its bound."""

    name: str
    family: str = ""
    """As for a case."""
    axis: str
    """The quantity that makes it harder."""
    scene: Callable[[float], Document]
    """The level at a given difficulty; its cost is the budget for pymunk as well."""
    figure: Figure
    bound: float
    criterion: str
    """As for a case."""
    start: float
    end: float
    """The least difficulty, and the one at which the search ends."""
    duration: float = 5.0
    """The length of a run [s]."""
    unit: str = ""
    """The unit of that quantity."""
    whole: bool = False
    """Whether the difficulty is a whole number."""
    over_time: bool = False
    """Whether the difficulty is the time that the bound holds; `end` is then the duration."""
    tolerance: float = 1.25
    """The factor by which the frontier may recede."""
    beyond: str | None = None
    """Why it is nearer than that of pymunk, if it is."""


def watch(level: Level, world: World, duration: float, *, every_step: bool = False) -> Run:
    """Run a world, and return samples; raise `SimulationError` if the run had to stop."""
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
