"""The parts of a report: the measurements of other commands, in the form of their JSON files."""

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from math import inf, nan
from pathlib import Path
from typing import Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.file_reading import UnreadableError, read_named
from validation import case_suite, output
from validation.case import Case, Outcome
from validation.case_loading import read
from validation.cases import PHENOMENA, all_cases
from validation.cost_of_accuracy import command as cost
from validation.cost_of_accuracy.accuracy_requests import Request
from validation.cost_of_accuracy.scheme_and_rate_sweep import Sweep
from validation.effect_costs import command as effects
from validation.effect_costs.comparison_with_bare_engine import EffectCost, LevelCost
from validation.effect_costs.cost_growth import Growth
from validation.stability import command as stability
from validation.stability.run_all_cases import Outcome as Hard
from validation.stability.run_all_cases import run

SAMPLE = (
    "kinematics/projectile",
    "newton/atwood",
    "newton/incline-with-friction",
    "energy/kepler-ellipse",
    "momentum/bouncing-ball",
    "lagrange/simple-pendulum",
    "lagrange/double-pendulum",
)
"""The levels for which a quick report shows the cost of accuracy."""

LARGEST = 100_000_000
"""The largest file that is read [bytes]."""

HARD = (
    "a cradle of five, 1 in, gap 0 m",
    "a pendulum of 90° for 60 s",
    "a stack of 15 boxes, 20 s",
    "40 links, the ball 672 times a link",
    "a bullet of 10 widths a step",
    "a cradle that touches",
)
"""The hard cases and the frontier of a quick report."""

OPTIONAL = {
    "order", "stepping", "until",
    "beyond", "axis", "unit", "frontier", "naive_frontier", "previous", "rate", "naive_rate",
}  # fmt: skip
"""Figures that may be missing; any other that is missing is infinite or NaN."""

T = TypeVar("T")

Content = Mapping[str, Any]
"""The JSON content that a command writes."""


@dataclass(frozen=True, slots=True)
class Part:
    """The measurement of a command."""

    command: str
    """The name of the part, and of its file."""
    measure: Callable[[bool], Content]
    """A function that measures, quickly or not, and returns the command's content."""


def _cases(quick: bool) -> Content:
    found = case_suite.outcomes(quick_cases() if quick else list(all_cases()))
    return output.content(cases=found)


def quick_cases() -> list[Case]:
    """Return the first case of every phenomenon."""
    return [read(phenomenon)[0] for phenomenon in PHENOMENA]


def _cost(quick: bool) -> Content:
    return cost.content(cost.sweep_all(SAMPLE if quick else level_catalog.textbook(), quick=quick))


def _effects(quick: bool) -> Content:
    return effects.content(*effects.measured(quick=quick))


def _stability(quick: bool) -> Content:
    found = [run(name, quick=True) for name in HARD] if quick else stability.measured(quick=False)
    return output.content(cases=found)


PARTS = (
    Part("run", _cases),
    Part("cost", _cost),
    Part("stability", _stability),
    Part("effects", _effects),
)


def collect(part: Part, source: Path | None, *, quick: bool) -> Content:
    """Return a part from its file in a folder, or measure it if there is no such file.

    Raises `SandboxError` if it cannot be read or measured.
    """
    file = source / f"{part.command}.json" if source else None
    if file is None or not os.path.lexists(file):
        return part.measure(quick)
    try:
        content = json.loads(read_named(file, LARGEST))
    except UnreadableError as error:
        raise SandboxError("{file}: {reason}", file=file, reason=error.message) from error
    except (ValueError, RecursionError) as error:
        raise SandboxError("cannot read {file}: {error}", file=file, error=str(error)) from error
    if not isinstance(content, dict):
        raise SandboxError(
            "{file} is not what `validation {command} --json` writes",
            file=file,
            command=part.command,
        )
    return content


def environment(content: Content) -> dict[str, str]:
    """Return what was measured with; raise `SandboxError` if the content has another form."""
    return _validated(TypeAdapter(dict[str, str]), content.get("environment"))


def outcomes(content: Content) -> list[Outcome]:
    """Return the cases of `run`; raise as `environment` does."""
    rows = [_filled(row, error=inf, naive_error=inf) for row in _rows(content, "cases")]
    return _validated(TypeAdapter(list[Outcome]), rows)


def sweeps(content: Content) -> list[Sweep]:
    """Return the levels of `validation cost`; raise as `environment` does."""
    rows = [
        {
            **row,
            "points": [_point(point) for point in _rows(row, "points")],
            "trusted": [_filled(trust, size=inf, off=inf) for trust in _rows(row, "trusted")],
        }
        for row in _rows(content, "levels")
    ]
    return _validated(TypeAdapter(list[Sweep]), rows)


def requests(content: Content) -> list[Request]:
    """Return the requests of `validation cost`; raise as `environment` does."""
    known = {field.name for field in fields(Request)}
    rows = [
        _filled({name: value for name, value in row.items() if name in known}, cheapest=inf)
        for row in _rows(content, "requests")
    ]
    return _validated(TypeAdapter(list[Request]), rows)


def hard_cases(content: Content) -> list[Hard]:
    """Return the outcomes of `validation stability`; raise as `environment` does."""
    rows = [_filled(row, figure=inf) for row in _rows(content, "cases")]
    return _validated(TypeAdapter(list[Hard]), rows)


def level_costs(content: Content) -> list[LevelCost]:
    """Return the levels of `validation effects`; raise as `environment` does."""
    return _validated(TypeAdapter(list[LevelCost]), _rows(content, "levels"))


def effect_costs(content: Content) -> list[EffectCost]:
    """Return the effects of `validation effects`; raise as `environment` does."""
    return _validated(TypeAdapter(list[EffectCost]), _rows(content, "costs"))


def growths(content: Content) -> list[Growth]:
    """Return the crowds of `validation effects`; raise as `environment` does."""
    return _validated(TypeAdapter(list[Growth]), _rows(content, "growth"))


def _rows(content: Content, key: str) -> list[dict[str, Any]]:
    return _validated(TypeAdapter(list[dict[str, Any]]), content.get(key))


def _validated(adapter: TypeAdapter[T], rows: object) -> T:
    try:
        return adapter.validate_python(rows)
    except ValidationError as error:
        where = ".".join(map(str, error.errors()[0]["loc"]))
        reason = f"{where}: {error.errors()[0]['msg']}".removeprefix(": ")
        raise SandboxError(
            "figures in another form than this version writes: {reason}", reason=reason
        ) from error


def _filled(row: Mapping[str, Any], **lost: float) -> dict[str, Any]:
    """Return a row with the figures that JSON cannot represent: infinite ones, and NaN."""
    return {
        name: lost.get(name, nan) if value is None and name not in OPTIONAL else value
        for name, value in row.items()
    }


def _point(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return a point of a sweep; a missing error is infinite, or NaN if the run failed."""
    failure = row.get("failure")
    return {**_filled(row, error=nan if failure else inf), "failure": failure}
