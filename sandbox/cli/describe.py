"""`describe`: the scene in words."""

from collections.abc import Sequence
from math import isfinite

import numpy as np
import typer

from sandbox.app.observing.scene_in_words import describe as words
from sandbox.cli import argument_parsing
from sandbox.model.loading import choose
from sandbox.physics.measuring.grading import grade
from sandbox.physics.measuring.recording import Recorder, count_steps, needed
from sandbox.physics.run import build


def describe(argument: str, pairs: Sequence[str], at: float, *, with_forces: bool) -> None:
    """Print the scene of a level at a time [s], for a terminal or a screen reader."""
    settings = argument_parsing.settings(pairs)
    if not (isfinite(at) and at >= 0):
        raise argument_parsing.UsageError(f"--at {at:g}: must be a finite time, at least 0")
    _, level = argument_parsing.open_level(argument)
    world = build(level, choose(level, settings))
    if at:
        argument_parsing.payable(at, world.stepping, "--at")
    with np.errstate(all="ignore"):  # values that are not finite are named
        recorder = Recorder(world, needed(level))
        for _ in range(count_steps(world, at)):
            world.advance()
            recorder.note()
    results = grade(recorder.trace.until(level.duration(world.values)))
    for line in words(world, results, with_forces=with_forces):
        typer.echo(line)
