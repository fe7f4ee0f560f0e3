"""The sandbox for programs and notebooks: load or make a level, run it, and grade it."""

import json
from collections.abc import Iterable, Mapping
from os import PathLike, fspath
from typing import Any

import numpy as np

from sandbox.model import level_catalog
from sandbox.model.json_document import refuse
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import choose, parse
from sandbox.model.loading import load as load_file
from sandbox.physics import run
from sandbox.physics.measuring.grading import grade as grade
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.stepping.world import World

Settings = Mapping[str, float]
"""Values of parameters by name; parameters that are left out keep the level's defaults."""


def load(level: str | PathLike[str]) -> Level:
    """Return a level by its name, such as `newton/atwood`, or by the path of its file.

    Raises
    ------
    LevelError
        If there is no such level, or it has mistakes: all of them, with their places.
    """
    return load_file(level_catalog.find(fspath(level)))


def make(document: Mapping[str, Any]) -> Level:
    """Return a level that a program has put together, in the form of a level's JSON.

    Raises
    ------
    LevelError
        If it has mistakes: all of them, with their lines in `json.dumps(document, indent=1)`.
    """
    source = "the level"
    try:
        text = json.dumps(document, indent=1, default=_plain)
    except (TypeError, ValueError, RecursionError) as error:
        refuse(source, "cannot be written as JSON: {error}", error=str(error))
    return parse(text, source)


def build(
    level: Level, settings: Settings | None = None, stepping: Stepping | None = None
) -> World:
    """Return the world of a level at its start, to be advanced step by step.

    Parameters
    ----------
    level
        What to build.
    settings
        Parameters that have other values than the level's own.
    stepping
        How time advances; as the level says if left out.

    Raises
    ------
    SandboxError
        If a parameter cannot have that value, or the world cannot start.
    """
    return run.build(level, choose(level, settings or {}), stepping)


def simulate(
    level: Level,
    settings: Settings | None = None,
    *,
    duration: float | None = None,
    record: Iterable[str] | None = None,
    stepping: Stepping | None = None,
) -> Trace:
    """Run a level and return what was recorded.

    Parameters
    ----------
    level
        What to run.
    settings
        Parameters that have other values than the level's own.
    duration
        How long [s]; as the level says if left out.
    record
        Names of quantities, such as `ball.position.x`; if left out, those of the level's checks.
    stepping
        How time advances; as the level says if left out.

    Raises
    ------
    SandboxError
        If a parameter cannot have that value, there is no such quantity, or the run had to stop.
    """
    return run.simulate(level, choose(level, settings or {}), duration, record, stepping)


def _plain(value: object) -> object:
    """Return a number or an array of NumPy as JSON has it."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    raise TypeError(f"{value!r} is a {type(value).__name__}")
