"""What is known against a level before it runs: that its steps are too long for it."""

from math import inf

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.rules import corners
from sandbox.physics.build import make_scene
from sandbox.physics.errors import SimulationError


def refusal(level: Level) -> SimulationError | None:
    """Return why a level cannot run at its rate, with the defaults or at the ends of its ranges.

    None if it can; of several reasons the one that asks for the highest rate. Asked is what springs
    and drags need. What only the first step shows, such as joints that contradict each other, is
    not known yet. A level that asks for an accuracy has no rate.
    """
    if level.stepping.accuracy is not None:
        return None
    found = [(values, error) for values in corners(level) if (error := _refused(level, values))]
    return _told(level, *max(found, key=lambda one: _needed(one[1]))) if found else None


def _refused(level: Level, values: Values) -> SimulationError | None:
    try:
        make_scene(level, values, level.stepping)
    except SimulationError as error:
        return error
    return None


def _needed(error: SimulationError) -> float:
    return error.rate or inf


def _told(level: Level, values: Values, error: SimulationError) -> SimulationError:
    """Return an error with its place, and with those parameters that it takes."""
    for name, default in level.defaults.items():
        tamer = {**values, name: default}
        same = _refused(level, tamer)
        if same and _needed(same) >= _needed(error):
            values, error = tamer, same
    changed = {name: value for name, value in values.items() if value != level.defaults[name]}
    if changed:
        error = error.when(", ".join(f"{name} = {value:g}" for name, value in changed.items()))
    error.refuse(level)
    return error
