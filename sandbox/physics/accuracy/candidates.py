"""What the ladders of a level have to offer: settings, their errors and their prices."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import floor

from sandbox.model.level import HIGHEST_RATE, Stepping
from sandbox.physics.accuracy.refinement import SLOWEST, Ladder, rounded

REAL_TIME = 0.5
"""s of computing for a second of the scene; the rest is for drawing it."""

CAUTION = 0.7
"""The share of the accuracy that a setting may use up by what is only expected of it."""


@dataclass(frozen=True, slots=True)
class Offer:
    """What can be had: a setting, its estimated error, and its price.

    Attributes
    ----------
    stepping
        The setting.
    error
        The largest of the run, as a check's: relative, absolute where zero is expected.
    price
        What a second of the scene takes to compute [s].
    """

    stepping: Stepping
    error: float
    price: float

    def __str__(self) -> str:
        s = self.stepping
        price = f"{self.price * 1e3:.3g} ms of computing for a second of the scene"
        return f"{s.scheme} at {s.rate:g} Hz, estimated error {self.error:.1e}, {price}"


@dataclass(frozen=True, slots=True)
class Offers:
    """What can be had of the schemes that were tried.

    Attributes
    ----------
    ladders
        Their runs; first the one that the others are held against.
    steps
        What a step of each takes to compute [s].
    """

    ladders: Sequence[Ladder]
    steps: Sequence[float]

    @property
    def fine(self) -> Stepping:
        """A setting that comes close to the best run, at half its price."""
        return self.ladders[0].traces[-2].stepping

    def best(self, target: float) -> tuple[bool, Offer]:
        """Return the cheapest setting that reaches a target, and whether it was seen to do so.

        Where none does, it is the most accurate.
        """

        def rank(offer: tuple[bool, Offer]) -> tuple[float, float]:
            return max(offer[1].error, target), offer[1].price

        pairs = zip(self.ladders, self.steps, strict=True)
        return min((_offer(step, ladder, target) for ladder, step in pairs), key=rank)

    def in_real_time(self) -> Offer | None:
        """Return the most accurate setting that runs in real time."""
        pairs = zip(self.ladders, self.steps, strict=True)
        found = (offer for ladder, step in pairs for offer in _affordable(step, ladder))
        return min(found, key=lambda offer: offer.error, default=None)


def _offer(step: float, ladder: Ladder, target: float) -> tuple[bool, Offer]:
    """Return a ladder's cheapest setting, or its best, at a price a step [s]."""
    last = ladder.traces[-1].stepping
    if good := ladder.cheapest(target):
        trace, error = good
        return True, Offer(trace.stepping, error, step * trace.stepping.rate)
    rate = rounded(max(ladder.rate_for(target * CAUTION), SLOWEST))
    if rate <= HIGHEST_RATE:
        return False, Offer(last.at(rate), ladder.error_at(rate), step * rate)
    runs = zip(ladder.traces, ladder.errors, strict=True)
    trace, error = min(runs, key=lambda run: run[1])
    return True, Offer(trace.stepping, error, step * trace.stepping.rate)


def _affordable(step: float, ladder: Ladder) -> Iterator[Offer]:
    """Yield a ladder's settings that run in real time, at a price a step [s]."""
    fastest = REAL_TIME / max(step, REAL_TIME / HIGHEST_RATE)
    for trace, error in zip(ladder.traces, ladder.errors, strict=True):
        if SLOWEST <= trace.stepping.rate <= fastest:
            yield Offer(trace.stepping, error, step * trace.stepping.rate)
    last = ladder.traces[-1].stepping
    if fastest > last.rate:
        rate = float(floor(fastest))
        setting = last.model_copy(update={"rate": rate})
        yield Offer(setting, ladder.error_at(rate), step * rate)
