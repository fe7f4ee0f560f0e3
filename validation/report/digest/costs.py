"""The cost of accuracy compared with stock pymunk, over all levels."""

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
    """The cost of accuracy, over all levels."""

    rows: tuple[Row, ...]
    """Every sweep that allows a comparison, with its headline and order."""
    silent: tuple[Sweep, ...]
    """The sweeps that do not."""
    exact: Group | None
    converging: Group | None
    """The gains in accuracy over pymunk in the same time, for levels where our error is rounding
    and for the others; None if there are no such levels."""
    alike: tuple[str, ...]
    """The levels on which pymunk's error is rounding as well: there is nothing to compare."""
    no_closer: tuple[str, ...]
    """The other levels on which pymunk is as accurate, or more so."""
    step_ratio: float
    """The median ratio of our step's time to pymunk's, at the same rate."""

    @property
    def chapters(self) -> list[tuple[str, list[Row]]]:
        """The rows, chapter by chapter."""
        return by_chapter(self.rows, lambda row: row[0])


def costs(sweeps: Sequence[Sweep]) -> Costs:
    """Return the digest of the sweeps."""
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
    """Yield the ratios of our time to pymunk's, at the level's own rate and equal iterations."""
    naive = {(p.rate, p.iterations): p for p in sweep.points if p.scheme == NAIVE}
    for point in sweep.points:
        other = naive.get((point.rate, point.iterations))
        if point.scheme == OURS and point.rate == sweep.own_rate and other:
            ratio = point.seconds_per_second / other.seconds_per_second
            if isfinite(ratio):
                yield ratio
