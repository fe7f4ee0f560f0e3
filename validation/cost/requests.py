"""Requests for an accuracy: what is delivered, and at what cost beside the whole sweep's."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from math import inf, nan

from sandbox.model.errors import SandboxError
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.calibration import calibrate
from sandbox.physics.measuring.recording import needed
from sandbox.physics.measuring.step_timing import brief_costs
from sandbox.physics.run import build, simulate
from validation.cost.run_error import Yardstick

EXPENSIVE = 3.0
"""How many times as much as the cheapest setting of the sweep a setting may cost."""

LONGEST = 5.0
"""s, the longest run that is checked."""


@dataclass(frozen=True, slots=True)
class Request:
    """An accuracy that was asked for.

    Attributes
    ----------
    level, target
        The requested accuracy.
    stepping
        The setting that was found; None if it was said that there is none.
    estimated, delivered
        The error that was promised, and the one against the closed form.
    cost, cheapest
        What a second of simulated time costs [s], and what it costs with the cheapest setting of
        the sweep; infinite if no setting there comes so close.
    said
        Why there is no setting, if there is none.
    """

    level: str
    target: float
    stepping: Stepping | None
    estimated: float
    delivered: float
    cost: float = nan
    cheapest: float = inf
    said: str = ""

    @property
    def honoured(self) -> bool:
        """Whether it was delivered, at a cost that is not much higher than it need be."""
        return self.delivered <= self.target and not self.cost > EXPENSIVE * self.cheapest

    @property
    def beyond(self) -> bool:
        """Whether no setting reaches it, neither one of the sweep nor one that was found."""
        return self.stepping is None and self.cheapest == inf


def ask(
    name: str, level: Level, stick: Yardstick, targets: Iterable[float], budget: float
) -> Iterator[Request]:
    """Request accuracies, and compare the results with the closed forms.

    A level without one is not asked: nothing else knows the digits that are wanted.
    """
    for target in targets if stick.by_formula else ():
        try:
            chosen = calibrate(level, target=target, budget=budget).chosen
        except SandboxError as error:
            yield Request(name, target, None, nan, nan, said=str(error))
            continue
        if chosen.cost * level.duration(level.defaults) > LONGEST:
            yield Request(name, target, chosen.stepping, chosen.error, nan, said="too slow to run")
            continue
        trace = simulate(level, record=needed(level), stepping=chosen.stepping)
        delivered = stick.formula_error(trace)
        yield Request(name, target, chosen.stepping, chosen.error, delivered)


def costs(level: Level, *steppings: Stepping) -> list[float]:
    """Return what a second of simulated time costs [s] with some settings, timed in turn."""
    steps = brief_costs(*(partial(build, level, stepping=stepping) for stepping in steppings))
    return [step * stepping.rate for step, stepping in zip(steps, steppings, strict=True)]
