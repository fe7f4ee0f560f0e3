"""The numerical error of a run, estimated by halving its step twice."""

from collections.abc import Sequence
from dataclasses import dataclass

from sandbox.model.expressions import Values
from sandbox.model.level import Instant, Level, Stepping
from sandbox.physics.accuracy.calibration_cache import resolved
from sandbox.physics.accuracy.compared_runs import Watched, checked, motion, record
from sandbox.physics.accuracy.richardson_extrapolation import extrapolated
from sandbox.physics.measuring.recording import Trace


@dataclass(frozen=True, slots=True)
class Estimate:
    """The numerical error of a run in one quantity.

    Attributes
    ----------
    quantity, at
        The quantity, at an instant or the largest error over the run.
    unit
        The unit of `difference`.
    error
        The error relative to the largest value, as for a check; absolute if that is zero. Infinite
        if the instant occurs in only some of the runs.
    difference
        The error in that unit.
    order
        The power of the step with which it falls; None if it is rounding, or no order shows.
    """

    quantity: str
    at: Instant | None
    unit: str
    error: float
    difference: float
    order: float | None


def estimate(
    level: Level, values: Values | None = None, stepping: Stepping | None = None
) -> tuple[Estimate | None, ...]:
    """Estimate the numerical error of a run, due to its step and its solver.

    It takes three runs, at the rate, twice and four times the rate: seven times the work of one.
    The quantities are those of the checks that apply or, without any, the positions and velocities
    of the bodies. An estimate is None if its instant never occurs. Raises `SimulationError` if a
    run had to stop.
    """
    values = level.defaults if values is None else values
    stepping = resolved(level, values, stepping or level.stepping)
    items = checked(level, values) or tuple(motion(level))
    finer = (stepping.model_copy(update={"rate": stepping.rate * times}) for times in (1, 2, 4))
    traces = [record(level, values, each, items) for each in finer]
    return tuple(_estimate(traces, item) for item in items)


def _estimate(traces: Sequence[Trace], item: Watched) -> Estimate | None:
    errors = extrapolated(traces, item)
    if errors is None:
        return None
    unit = traces[0].units[item.quantity]
    return Estimate(
        item.quantity, item.at, unit, errors.relative[0], errors.absolute[0], errors.order
    )
