"""How many digits of a run's numbers can be trusted, and until when."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil, floor, isfinite, log10

from sandbox.physics.accuracy.compared_runs import LITTLE, Watched, departure, item_scale
from sandbox.physics.accuracy.event_timing_errors import hidden_error
from sandbox.physics.accuracy.richardson_extrapolation import extrapolated
from sandbox.physics.measuring.recording import Trace

SEEN = 1e-2
"""The relative error of a quantity from which it is visible in a graph."""

MOST_DIGITS = 8
"""The most digits that a column of numbers has room for."""

USUAL_DIGITS = 5
"""The digits of a number whose error is unknown."""


@dataclass(frozen=True, slots=True)
class Trust:
    """How far a quantity of the run can be trusted."""

    quantity: str
    """The name of the quantity."""
    size: float
    off: float
    """The largest value and the largest numerical error, in the quantity's unit."""
    until: float | None
    """When halving the step makes a visible difference in a graph [s]; None if it never does."""
    order: float | None = None
    """The power of the step with which the error falls; None if it shows none, as rounding does."""

    @property
    def next_digit(self) -> float | None:
        """The work for a tenth of the error, as a multiple of the run's; None if not known."""
        return 10 ** (1 / self.order) if self.order and self.off else None

    @property
    def digits(self) -> int:
        """The number of its digits that hold throughout."""
        return certain_digits(self.size, self.off)


def certain_digits(value: float, error: float) -> int:
    """Return how many significant digits of a value are certain, given its error.

    The error is at most half a unit of the last of these digits; no digit is certain in a value
    that is not larger than its error.

    >>> surviving(3.14159, 2e-4), surviving(3.14159, 9e-4), surviving(0.02, 0.1)
    (4, 3, 0)
    """
    if not value or error <= 0 or not isfinite(value) or not isfinite(error):
        return USUAL_DIGITS
    if error >= abs(value):
        return 0
    return min(max(floor(log10(abs(value))) - ceil(log10(2 * error)) + 1, 1), MOST_DIGITS)


def trust_of(traces: Sequence[Trace], items: Iterable[Watched]) -> Iterator[Trust]:
    """Yield how far quantities of the last run but one can be trusted.

    Each run has half the step of the one before.
    """
    run, finer = traces[-2:]
    for item in items:
        if found := extrapolated(traces, item):
            largest, unit = item_scale(finer, item), found.unit
            unseen = hidden_error(finer, [item]).error * unit
            until = departure(run, finer, item, SEEN)
            # an impact is late by a step
            order = found.order if found.absolute[-2] >= unseen else 1.0
            yield Trust(item.quantity, largest, max(found.absolute[-2], unseen), until, order)


def least_known(found: Iterable[Trust]) -> Trust | None:
    """Return the position that can be trusted least, ignoring those that hardly leave zero."""
    positions = [trust for trust in found if ".position." in trust.quantity]
    largest = max((position.size for position in positions), default=0.0)
    moving = [position for position in positions if position.size > LITTLE * largest]
    return max(moving, key=lambda place: place.off / place.size, default=None)
