"""Runs as CSV files that say how to repeat them."""

import platform
import shlex
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import pymunk

from sandbox.garbage_collection_pause import uncollected
from sandbox.model.errors import brief
from sandbox.model.level import Level
from sandbox.model.loading import digest
from sandbox.model.quantities import column_heading
from sandbox.physics.measuring.recording import Trace
from sandbox.version import __version__


class Change(NamedTuple):
    """The difference between the level of a run and the level in its source."""

    original: Level
    description: str
    """such as `without drag`"""
    options: tuple[str, ...]
    """the command-line options that make the change"""


@uncollected()
def to_csv(
    trace: Trace,
    source: str,
    names: Iterable[str] | None = None,
    *,
    disturbed: bool = False,
    change: Change | None = None,
) -> str:
    """Return a run as CSV: comments that say how to repeat it, a header, and a line per instant.

    Every number has enough digits to restore its exact bits. The source is the name or the file of
    its level, `change` how the level of the run differs from it. Without names, all recorded
    quantities are written. A run that a hand has `disturbed` cannot be repeated.
    """
    chosen = trace.columns if names is None else names
    columns = [name for name in dict.fromkeys(chosen) if name != "t"]
    header = ["t [s]", *(column_heading(name, trace.units[name]) for name in columns)]
    rows = zip(*(values.tolist() for values in _arrays(trace, columns)), strict=True)
    lines = [
        *(f"# {key}: {brief(text, len(text))}" for key, text in _provenance(trace, source, change)),
        f"# {_again(trace, source, columns, change, disturbed=disturbed)}",
        ",".join(header),
        *(",".join(map(repr, row)) for row in rows),
    ]
    return "\n".join(lines) + "\n"


def _arrays(trace: Trace, columns: list[str]) -> Iterator[np.ndarray]:
    yield trace.t
    for name in columns:
        yield trace.columns[name]


def _provenance(trace: Trace, source: str, change: Change | None) -> Iterator[tuple[str, str]]:
    level, stepping = trace.level, trace.stepping
    yield "level", source
    yield "title", level.title
    yield "hash", digest(change.original if change else level)
    if change:
        yield "change", change.description
    yield "parameters", ", ".join(_parameters(trace)) or "none"
    yield "rate", f"{stepping.rate!r} Hz"
    yield "iterations", str(stepping.iterations)
    yield "scheme", stepping.scheme
    if stepping.solver:
        yield "solver", stepping.solver
    yield "effects", ", ".join(level.effects.declared) or "none"
    if trace.closing:
        yield "energy", trace.closing.text
    yield "versions", ", ".join(f"{name} {version}" for name, version in _versions())
    yield "platform", f"{platform.system()} {platform.machine()}"


def _parameters(trace: Trace) -> Iterator[str]:
    for name, parameter in trace.level.parameters.items():
        yield f"{name} = {float(trace.values[name])!r} {parameter.unit}".rstrip()


def _versions() -> Iterator[tuple[str, str]]:
    yield "python", platform.python_version()
    yield "pymunk", pymunk.version
    yield "numpy", np.__version__
    yield "sandbox", __version__


def _again(
    trace: Trace, source: str, columns: list[str], change: Change | None, *, disturbed: bool
) -> str:
    """Return the command that reproduces the file, or the reason why there is none."""
    level, stepping = trace.level, trace.stepping
    if disturbed:
        return "not repeatable: it was touched on the way"
    command = ["python", "-m", "sandbox", "simulate", source, *(change.options if change else ())]
    for name, value in trace.values.items():
        if value != level.defaults[name]:
            command += ["--set", f"{name}={float(value)!r}"]
    command += ["--duration", repr(float(trace.t[-1])), "--rate", repr(stepping.rate)]
    command += ["--scheme", stepping.scheme, "--iterations", str(stepping.iterations)]
    if stepping.solver:
        command += ["--solver", stepping.solver]
    for name in columns:
        command += ["--record", name]
    text = shlex.join([*command, "--output", "FILE.csv"])
    return f"again: {brief(text, len(text))}"
