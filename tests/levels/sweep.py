"""The parameter values with which levels are swept, and about how long that takes."""

from collections.abc import Callable, Iterable
from itertools import islice

import pytest

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.rules.level_validation import corners
from validation.case import textbook

MOST = 100
"""How many corners of a level are swept at the most."""


def swept(level: Level) -> list[Values]:
    """Return the corners of a level's parameters, the defaults first."""
    return list(islice(corners(level), MOST))


def steps(level: Level, values: Iterable[Values]) -> float:
    """Return the total number of steps of its runs."""
    return sum(level.duration(chosen) for chosen in values) * level.stepping.rate


def marked(name: str, count: Callable[[Level], float], *, quick: bool = True) -> object:
    """Return a level's name as a test parameter, marked as sweep if its steps take long."""
    marks = [pytest.mark.steps(count(textbook(name)))]
    return pytest.param(name, marks=marks if quick else [*marks, pytest.mark.sweep])
