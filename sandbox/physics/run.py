"""Building and running a level at the setting that it asks for, and timing its steps.

A level may ask for an accuracy instead of a rate. The search for a setting steps worlds itself, so
this module imports it, not the reverse.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from sandbox.model.contact_solver_choice import may_be_direct
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.compared_runs import at_least_lasting
from sandbox.physics.energy.balance_check import Closer
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, may_lean, needed
from sandbox.physics.measuring.step_timing import step_costs
from sandbox.physics.state.simulation_errors import BreakdownError
from sandbox.physics.stepping.make_world import make_world
from sandbox.physics.stepping.time_limit import TimeLimit
from sandbox.physics.stepping.world import World

MOST_UNSETTLED = 100
"""The most pairs in contact that are solved directly because sweeps did not settle them."""


def build(level: Level, values: Values | None = None, stepping: Stepping | None = None) -> World:
    """Make the world of a level, with its default parameters and its own stepping if left out.

    If the stepping only gives an accuracy, the setting is searched for, or taken from the cache. It
    may also leave open how contacts are solved. Then they are solved directly if sweeps of pymunk's
    solver do not settle the bodies that rest at the start, such as a tall stack.

    Raises `AccuracyError` if an accuracy is asked for that cannot be had, `SimulationError` if the
    world cannot even start, and `SchemeError` if the scheme is not for such a level.
    """
    values = level.defaults if values is None else values
    chosen = _resolved(level, values, stepping or level.stepping)
    with TimeLimit().within_steps():
        world = make_world(level, values, chosen)
        if chosen.solver or not may_lean(world) or not may_be_direct(level):
            return world
        if len(world.contacts.bodies) > MOST_UNSETTLED:
            return world
        try:
            return make_world(level, values, chosen.model_copy(update={"solver": "direct"}))
        except SandboxError:  # the direct solver finds no forces, as for a wedge: keep the sweeps
            return world


def simulate(
    level: Level,
    values: Values | None = None,
    duration: float | None = None,
    record: Iterable[str] | None = None,
    stepping: Stepping | None = None,
    *,
    books: bool = False,
    until: Callable[[World], bool] | None = None,
) -> Trace:
    """Run a level and record quantities, by default those that its checks need.

    The run ends with the first step that is not before its duration [s], or when `until` is true of
    the world after a step. `books` keeps the energy books of the run, which costs about 0.1 ms per
    step. Raises `QuantityError` if the level has no such quantity, and `SimulationError` if the run
    had to stop.
    """
    values = level.defaults if values is None else values
    record = None if record is None else list(record)
    asked = at_least_lasting(level, values, duration)
    world = build(level, values, _resolved(asked, values, stepping or level.stepping, record or ()))
    try:
        with np.errstate(all="ignore"):  # a value that is not finite is named in an error
            recorder = Recorder(world, needed(level) if record is None else record)
            closer = Closer(world) if books else None
            _record(world, count_steps(world, duration), recorder, closer, until)
            return replace(recorder.trace, closing=closer.closing if closer else None)
    except SandboxError:
        raise
    except Exception as error:
        raise BreakdownError(error, world.t) from error


def _resolved(
    level: Level, values: Values, stepping: Stepping, also: Sequence[str] = ()
) -> Stepping:
    """As `calibration_cache.resolved`; the search is imported only if an accuracy is asked for."""
    if stepping.accuracy is None:
        return stepping
    from sandbox.physics.accuracy.calibration_cache import resolved

    return resolved(level, values, stepping, also)


def _record(
    world: World,
    steps: int,
    recorder: Recorder,
    closer: Closer | None,
    until: Callable[[World], bool] | None,
) -> None:
    """Take and note steps, until there are as many as wanted or `until` returns true."""
    patience = TimeLimit()
    if until is None:
        recorder.require(steps + 1)
    with patience.within_steps():
        for taken in range(steps):
            patience.advance(world)
            recorder.require(taken + 2)
            recorder.note()
            if closer:
                closer.note()
            if until and until(world):
                break


def costs(
    levels: Iterable[Level], values: Values, stepping: Stepping | None = None
) -> tuple[float, ...]:
    """Return what a step of each of some levels costs [s], measured in turn.

    Raises `SimulationError` if one of them has to stop.
    """
    return step_costs(*(partial(build, level, values, stepping) for level in levels))
