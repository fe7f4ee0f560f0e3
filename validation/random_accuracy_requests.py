"""`python -m validation requests`: random requests for an accuracy, and their outcomes.

The setting that is found is checked against a run with a much smaller step, and against cheaper
settings.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import count
from math import floor, inf, isnan, log2, nan
from pathlib import Path
from random import Random

import typer

from sandbox.model import level_catalog
from sandbox.model.expressions import Values
from sandbox.model.level import HIGHEST_RATE, Level, Stepping
from sandbox.model.loading import load
from sandbox.physics.accuracy.compared_runs import Watched, record, scaled, watched
from sandbox.physics.accuracy.counted_step_cost import counted_cost
from sandbox.physics.accuracy.exceptions import AccuracyError
from sandbox.physics.accuracy.requested_accuracy import Setting, calibrate
from sandbox.physics.accuracy.step_refinement import largest_relative_difference, lowest_rate
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.scene.usable_schemes import usable
from sandbox.physics.state.simulation_errors import SimulationError
from validation import output

TARGETS = (1e-3, 1e-6, 1e-9)

FINER = 8
"""The rate of the reference run, as a multiple of the setting's; half of that if too slow."""

LONGEST = 20.0
"""The longest reference run, by its counted work [s]."""

EXPENSIVE = 3.0
"""The highest cost of a setting, as a multiple of the cheapest in the sweep."""

BETTER = 2.0
"""The highest ratio of the true error to the reported one."""

ROUNDING = 1e-12
"""The difference below which errors count as equal."""

BELOW = 2.0
"""The lowest rate at which the program offers a scheme is at most this multiple of the lowest in
the sweep."""


@dataclass(frozen=True, slots=True)
class Trial:
    """A request, and its outcome."""

    seed: int
    level: str
    values: Values
    target: float
    """The request and its seed."""
    answer: str
    """The setting in words, or the reason why there is none."""
    refused: bool = False
    """Whether the accuracy was refused as out of reach."""
    estimated: float = nan
    delivered: float = nan
    """The reported error and the measured one; NaN if there is none."""
    cheaper: str = ""
    """A setting of the sweep as accurate, at less than a third of the work; empty if none."""

    @property
    def looked_at(self) -> bool:
        """Whether there was time to verify the result."""
        return not isnan(self.delivered)

    @property
    def kept(self) -> bool:
        """Whether it is as accurate as requested."""
        return self.delivered <= self.target

    @property
    def honest(self) -> bool:
        """Whether the reported error is not too small."""
        return self.delivered <= max(BETTER * self.estimated, ROUNDING)


def trial(seed: int) -> Trial:
    """Draw a level, its parameters and an accuracy, request it, and verify the result."""
    random = Random(seed)
    name = random.choice(level_catalog.textbook())
    level = load(level_catalog.find(name))
    values = {n: random.uniform(p.min, p.max) for n, p in level.parameters.items()}
    target = random.choice(TARGETS)
    try:
        setting = calibrate(level, values, target)
    except (AccuracyError, SimulationError) as error:
        return Trial(seed, name, values, target, str(error), refused=True)
    delivered, cheaper = nan, ""
    with suppress(SimulationError):
        delivered, cheaper = looked_at(level, values, setting)
    text = str(setting)
    return Trial(
        seed, name, values, target, text,
        estimated=setting.chosen.error, delivered=delivered, cheaper=cheaper,
    )  # fmt: skip


def looked_at(level: Level, values: Values, setting: Setting) -> tuple[float, str]:
    """Return the error of a setting, NaN if verifying it takes too long, and a cheaper setting.

    The cheaper one is in words; empty if there is none. Raises `SimulationError` if a run stops.
    """
    chosen = setting.chosen.stepping
    finer = _finer(level, values, chosen)
    if finer is None:
        return nan, ""
    wanted: Sequence[Watched] = watched(level, values)
    if "chaotic" in setting.judged_by:
        wanted = (Watched("system.energy"),)
    best = record(level, values, finer, wanted, observation_rate=max(chosen.rate, 240.0))
    wanted = scaled(wanted, best)
    run = record(level, values, chosen, wanted, observation_rate=inf)
    half = finer.model_copy(update={"rate": finer.rate / 2})
    other = record(level, values, half, wanted, observation_rate=max(chosen.rate, 240.0))
    delivered = max(_off(run, (best, other), item) for item in wanted)
    return delivered, _cheaper(level, values, setting, wanted, best)


def _off(run: Trace, finer: Sequence[Trace], item: Watched) -> float:
    """Return the error of a run in a quantity, against the nearer of the finer runs.

    Rounding of forces grows with the rate, so that the finest run may be the one with the error.
    """
    return min(largest_relative_difference(run, trace, [item])[0] for trace in finer)


def _finer(level: Level, values: Values, chosen: Stepping) -> Stepping | None:
    """Return a much finer setting, of higher order if possible; None if it takes too long."""
    for times in (FINER, FINER // 2):
        update: dict[str, object] = {"rate": times * chosen.rate, "scheme": "leapfrog"}
        if "fourth-order" in usable(level):
            update["scheme"] = chosen.scheme if chosen.is_composed else "fourth-order"
        elif level.effects.contact:
            update["iterations"] = min(FINER * chosen.iterations, 1000)
        finer = chosen.model_copy(update=update)
        if finer.rate <= 2 * HIGHEST_RATE and _work(level, values, finer) <= LONGEST:
            return finer
    return None


def _work(level: Level, values: Values, stepping: Stepping) -> float:
    """Return the counted work of a run [s]."""
    return counted_cost(level, values, stepping) * stepping.rate * level.duration(values)


def _cheaper(
    level: Level, values: Values, setting: Setting, wanted: Sequence[Watched], best: Trace
) -> str:
    """Return the setting of the sweep that is as accurate at far less work; empty if none is."""
    chosen = setting.chosen.stepping
    enough = _work(level, values, chosen) / EXPENSIVE
    for scheme in usable(level):
        least = lowest_rate(chosen.model_copy(update={"scheme": scheme})) / BELOW
        lowest = chosen.rate / 2 ** floor(log2(chosen.rate / least))  # they must share instants
        for doublings in count():
            rate = lowest * 2**doublings
            tried = chosen.model_copy(update={"scheme": scheme, "rate": rate})
            if _work(level, values, tried) >= enough:
                break
            with suppress(SimulationError):
                run = record(level, values, tried, wanted, observation_rate=inf)
                if largest_relative_difference(run, best, wanted)[0] <= setting.target:
                    return f"{scheme} at {rate:g} Hz"
    return ""


def measure(count: int, seed: int, json_file: Path | None, jobs: int | None) -> bool:
    """Request accuracies, print the missed ones, and return whether all promises hold.

    The seed is that of the first request. The outcomes go to the JSON file, if any. By default
    there are as many processes as cores. Raises `SandboxError` if the file cannot be written.
    """
    trials = output.spread_in_order(trial, range(seed, seed + count), "Asking", jobs)
    with output.written(output.content(requests=trials), json_file):
        typer.echo(summary(trials))
        output.complain(complaints(trials))
    return all(each.kept and each.honest for each in trials if each.looked_at)


def summary(trials: Sequence[Trial]) -> str:
    """Return a line that says how many accuracies were delivered."""
    seen = [each for each in trials if each.looked_at]
    refused = sum(each.refused for each in trials)
    return (
        f"{len(trials)} accuracies requested: {refused} refused, {len(seen)} compared; "
        f"of these {sum(each.kept for each in seen)} delivered, "
        f"{sum(each.honest for each in seen)} with the stated error, "
        f"{sum(not each.cheaper for each in seen)} at up to three times the least cost"
    )


def complaints(trials: Sequence[Trial]) -> list[str]:
    """Return messages about broken promises."""
    found = []
    for each in trials:
        if each.looked_at and not (each.kept and each.honest and not each.cheaper):
            at = ", ".join(f"{name}={value:.6g}" for name, value in each.values.items())
            instead = f"; cheaper: {each.cheaper}" if each.cheaper else ""
            found.append(
                f"seed {each.seed}: {each.level} ({at}): {each.answer}; delivered "
                f"{each.delivered:.1e}{instead}"
            )
    return found
