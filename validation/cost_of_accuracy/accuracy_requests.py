"""Requests for an accuracy: the results, and their cost compared with that of the sweep."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from math import inf, nan

from sandbox.model.errors import SandboxError
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.requested_accuracy import calibrate
from sandbox.physics.measuring.recording import needed
from sandbox.physics.measuring.step_timing import brief_costs
from sandbox.physics.run import build, simulate
from validation.cost_of_accuracy.run_error import Yardstick

EXPENSIVE = 3.0
"""The highest cost of a setting, as a multiple of the sweep's cheapest sufficient one."""

LONGEST = 5.0
"""The longest run that is checked [s]."""


@dataclass(frozen=True, slots=True)
class Request:
    """A request for an accuracy."""

    level: str
    target: float
    """The level, and the requested accuracy."""
    stepping: Stepping | None
    """The setting that was found; None if there is none."""
    estimated: float
    delivered: float
    """The estimated error, and the error relative to the closed form."""
    cost: float = nan
    cheapest: float = inf
    """The computing time per second of the scene [s], and that of the cheapest setting in the sweep
    that is as accurate; infinite if there is none."""
    said: str = ""
    """The reason why there is no setting."""

    @property
    def honoured(self) -> bool:
        """Whether it was delivered, at a cost that is not much higher than necessary."""
        return self.delivered <= self.target and not self.cost > EXPENSIVE * self.cheapest

    @property
    def beyond(self) -> bool:
        """Whether no setting reaches it, neither in the sweep nor by calibration."""
        return self.stepping is None and self.cheapest == inf


def ask(
    name: str, level: Level, stick: Yardstick, targets: Iterable[float], budget: float
) -> Iterator[Request]:
    """Request accuracies, and compare the results with the closed forms.

    Levels without a closed form are skipped: there is no independent reference for the digits.
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
    """Return the computing time per second of the scene with each stepping [s], timed in turn."""
    steps = brief_costs(*(partial(build, level, stepping=stepping) for stepping in steppings))
    return [step * stepping.rate for step, stepping in zip(steps, steppings, strict=True)]
