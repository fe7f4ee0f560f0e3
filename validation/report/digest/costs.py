"""The cost of accuracy compared with stock pymunk, of requests for it, and of Python in a step."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from statistics import median

from validation.cost_of_accuracy.accuracy_requests import EXPENSIVE, Request
from validation.cost_of_accuracy.report import ROUNDING, Headline, headline, order
from validation.cost_of_accuracy.scheme_and_rate_sweep import NAIVE, OURS, Sweep
from validation.effect_costs.comparison_with_bare_engine import LevelCost
from validation.report.digest.grouping_by_chapter import by_chapter


@dataclass(frozen=True, slots=True)
class Requests:
    """Requests for an accuracy, and their results."""

    asked: tuple[Request, ...]
    """All of them."""
    expensive: float = EXPENSIVE
    """The highest cost allowed, as a multiple of that of the cheapest setting."""

    @property
    def met(self) -> int:
        """The number of requests that are met at no higher cost than that."""
        return sum(request.honoured for request in self.asked)

    @property
    def beyond(self) -> int:
        """The number of requests that are refused, and that the sweep does not reach either."""
        return sum(request.beyond for request in self.asked)

    @property
    def unmet(self) -> tuple[Request, ...]:
        """The other requests."""
        return tuple(r for r in self.asked if not (r.honoured or r.beyond))

    @property
    def too_expensive(self) -> int:
        """The number of requests that are met at a higher cost."""
        return sum(r.delivered <= r.target and not r.honoured for r in self.asked)

    @property
    def cost_ratio(self) -> float:
        """The median ratio of a request's cost to that of the cheapest setting in the sweep."""
        ratios = [r.cost / r.cheapest for r in self.asked if r.honoured and isfinite(r.cheapest)]
        return median(ratios) if ratios else float("nan")

    @property
    def targets(self) -> "list[tuple[float, Requests]]":
        """The requests, grouped by accuracy."""
        targets = dict.fromkeys(request.target for request in self.asked)
        return [(t, Requests(tuple(r for r in self.asked if r.target == t))) for t in targets]

    @property
    def chapters(self) -> "list[tuple[str, Requests]]":
        """The requests, grouped by chapter."""
        groups = by_chapter(self.asked, lambda request: request)
        return [(title, Requests(tuple(group))) for title, group in groups]

    @property
    def levels(self) -> list[tuple[str, list[Request]]]:
        """The requests of each level."""
        groups: dict[str, list[Request]] = {}
        for request in self.asked:
            groups.setdefault(request.level, []).append(request)
        return list(groups.items())


@dataclass(frozen=True, slots=True)
class Hooks:
    """The median costs of Python in the steps of levels."""

    without: int
    ratio_without: float
    having: int
    added: float


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


def hooks(levels: Sequence[LevelCost]) -> Hooks:
    """Return the costs for levels without hooks, and with one, relative to the bare engine."""
    bare = [cost for cost in levels if not cost.hooks]
    having = [cost for cost in levels if cost.hooks]
    nothing = float("nan")
    return Hooks(
        len(bare),
        median([cost.ratio for cost in bare]) if bare else nothing,
        len(having),
        median([c.step_seconds - c.bare_step_seconds for c in having]) if having else nothing,
    )
