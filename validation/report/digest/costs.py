"""The cost of accuracy beside stock pymunk, over all levels."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from statistics import median

from validation.cost.summary import ROUNDING, Headline, headline, order
from validation.cost.sweep import NAIVE, OURS, Sweep
from validation.report.digest.chapters import by_chapter

Row = tuple[Sweep, Headline, float | None]
"""A sweep, its headline, and the order of the sandbox's scheme."""


@dataclass(frozen=True, slots=True)
class Group:
    """Levels that compare with pymunk in the same way."""

    count: int
    median: float
    least: float


@dataclass(frozen=True, slots=True)
class Costs:
    """What accuracy costs, over all levels.

    Attributes
    ----------
    rows
        Every sweep that shows a comparison, with its headline and order.
    silent
        The sweeps that show none.
    exact, converging
        How much closer than pymunk in the same time, where our error is rounding and where it is
        not; None if there are no such levels.
    alike
        The levels on which pymunk, too, is off by rounding alone, and nothing is to be compared.
    no_closer
        The others on which pymunk does as well, or better.
    step_ratio
        What our step takes of pymunk's own, at the same rate: the median.
    """

    rows: tuple[Row, ...]
    silent: tuple[Sweep, ...]
    exact: Group | None
    converging: Group | None
    alike: tuple[str, ...]
    no_closer: tuple[str, ...]
    step_ratio: float

    @property
    def chapters(self) -> list[tuple[str, list[Row]]]:
        """The rows, chapter by chapter."""
        return by_chapter(self.rows, lambda row: row[0])


def costs(sweeps: Sequence[Sweep]) -> Costs:
    """Return what the sweeps say."""
    found = [(sweep, headline(sweep)) for sweep in sweeps]
    rows = [(sweep, best, order(sweep.points, OURS)) for sweep, best in found if best]
    alike = [s.level for s, best, _ in rows if max(best.error, best.naive_error) <= ROUNDING]
    compared = [(sweep.level, best) for sweep, best, _ in rows if sweep.level not in alike]
    ratios = [ratio for sweep in sweeps for ratio in _step_ratios(sweep)]
    return Costs(
        rows=tuple(rows),
        silent=tuple(sweep for sweep, best in found if best is None),
        exact=_group([best.closer for _, best in compared if best.error <= ROUNDING]),
        converging=_group([best.closer for _, best in compared if best.error > ROUNDING]),
        alike=tuple(alike),
        no_closer=tuple(level for level, best in compared if best.closer <= 1),
        step_ratio=median(ratios) if ratios else float("nan"),
    )


def _group(ratios: Sequence[float]) -> Group | None:
    return Group(len(ratios), median(ratios), min(ratios)) if ratios else None


def _step_ratios(sweep: Sweep) -> Iterator[float]:
    """Yield what ours takes of pymunk's time at the level's own rate, with the same iterations."""
    naive = {(p.rate, p.iterations): p for p in sweep.points if p.scheme == NAIVE}
    for point in sweep.points:
        other = naive.get((point.rate, point.iterations))
        if point.scheme == OURS and point.rate == sweep.own_rate and other:
            ratio = point.seconds_per_second / other.seconds_per_second
            if isfinite(ratio):
                yield ratio
