"""Faults of a level found before it runs: steps that are too long, bodies that overlap."""

from math import inf

import numpy as np

from sandbox.model.contained_expressions import expressions
from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level
from sandbox.model.rules.level_validation import FEWEST, MAX_CORNERS, corners
from sandbox.model.scheme_requirements import bounds_the_rate
from sandbox.physics.scene.make_scene import make_scene
from sandbox.physics.state.simulation_errors import BreakdownError, JointFailure, SimulationError

MOST_PARTS = 10_000
"""The most bodies and joints that are built to check the rate, and to find what causes a refusal:
about half a second each."""

SECONDS = 0.5
"""s of processor time for trying a rate: whoever checks a level does not wait for its run."""

IN_MOTION = frozenset(
    {
        "mass", "moment", "velocity", "angular_velocity", "gravity", "friction", "static_friction",
        "restitution",
    }
)  # fmt: skip
"""Fields that matter only once bodies move: no surface at the start, no bound on the rate."""


def refusal(level: Level, *, advised: bool = False) -> SimulationError | None:
    """Return why a level cannot run at its rate, with the defaults or at the ends of its ranges.

    None if it can; of several reasons, the one that needs the highest rate, or that no rate can
    mend. The checks are the rates that springs and drags need, overlaps at the start, and joints
    that are redundant there. Faults that only the first step reveals are not found. A level that
    asks for an accuracy may have any rate.

    If `advised`, and a higher rate should help, that rate is tried.
    """
    parts = len(level.bodies) + len(level.joints)
    most = min(max(MOST_PARTS // parts, FEWEST), MAX_CORNERS)
    ends = corners(level, _concerned(level), most)
    asked = ((values, _refused(level, values)) for values in ends)
    found = [(values, error) for values, error in asked if error]
    if not found:
        return None
    values, error = max(found, key=lambda one: _needed(one[1]))
    values, error = _placed(level, values, error, most)
    if advised and error.rate is not None:
        from sandbox.physics.advising.remedy_trials import with_advice

        error = with_advice(error, level, values, level.stepping, seconds=SECONDS)
    return error


def _concerned(level: Level) -> frozenset[str]:
    """Return the parameters that can affect whether a level is refused."""
    if not level.parameters:
        return frozenset()
    said = (vars(part).items() for part in (level.effects, *level.bodies.values()))
    still = not bounds_the_rate(level)
    parts = [value for items in said for name, value in items if not (still and name in IN_MOTION)]
    made_of = (*parts, level.joints, level.stepping)
    return frozenset[str]().union(*(e.names for part in made_of for _, e in expressions(part)))


def _refused(level: Level, values: Values) -> SimulationError | None:
    stepping = level.stepping
    if stepping.accuracy is not None:
        stepping = stepping.at(HIGHEST_RATE)
    try:
        with np.errstate(all="ignore"):  # non-finite values are reported by name
            scene = make_scene(level, values, stepping)
            if scene.joints.together:
                scene.joints.together.check()
    except SimulationError as error:
        return error
    except JointFailure as error:
        return SimulationError(error.joint, 0.0, error.reason)
    except Exception as error:  # noqa: BLE001 (any error is reported)
        return BreakdownError(error, 0.0)
    return None


def _needed(error: SimulationError) -> float:
    return error.rate or inf


def _placed(
    level: Level, values: Values, error: SimulationError, most: int
) -> tuple[Values, SimulationError]:
    """Return an error with its place, and the parameters that cause it, as few as possible.

    They are sought by halves, as most do not matter; at most `most` times.
    """
    pending = [[name for name, value in values.items() if value != level.defaults[name]]]
    for _ in range(most):
        names = pending.pop() if pending else []
        if not names:
            break
        tamer = {**values, **{name: level.defaults[name] for name in names}}
        same = _refused(level, tamer)
        if same and _needed(same) >= _needed(error):
            values, error = tamer, same
        elif len(names) > 1:
            pending += [names[len(names) // 2 :], names[: len(names) // 2]]
    changed = {name: value for name, value in values.items() if value != level.defaults[name]}
    if changed:
        error = error.when(", ".join(f"{name} = {value:g}" for name, value in changed.items()))
    error.refuse(level)
    return values, error
