"""What a reader wants to know first: a few figures out of many."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from statistics import median
from typing import Protocol, TypeVar

from sandbox.model.catalog import find
from sandbox.model.errors import SandboxError
from sandbox.model.loading import load
from validation.case import Outcome
from validation.cost.requests import DEAR, Request
from validation.cost.summary import ROUNDING, Headline, headline, order
from validation.cost.sweep import NAIVE, OURS, Sweep
from validation.effects.costs import LevelCost
from validation.stability import report as stability
from validation.stability.run import Outcome as Hard

TITLES = {"newton": "Newton's laws", "lagrange": "Lagrangian mechanics"}
"""Of chapters that are not called as their folders are."""

CLOSEST = 5
"""How many cases are shown that come closest to their bounds."""


T = TypeVar("T")

Row = tuple[Sweep, Headline, float | None]
"""A sweep, its headline, and the order of ours."""


@dataclass(frozen=True, slots=True)
class Claim:
    """What is claimed of a quantity, and how it came out for certain parameters."""

    name: str
    level: str
    quantity: str
    because: str
    rows: tuple[tuple[str, Outcome], ...]


@dataclass(frozen=True, slots=True)
class Chapter:
    """The claims of a chapter."""

    title: str
    claims: tuple[Claim, ...]

    @property
    def outcomes(self) -> list[Outcome]:
        """Of all its claims."""
        return [outcome for claim in self.claims for _, outcome in claim.rows]

    @property
    def held(self) -> int:
        """How many hold."""
        return sum(outcome.passed for outcome in self.outcomes)


@dataclass(frozen=True, slots=True)
class Cases:
    """All cases.

    Attributes
    ----------
    chapters
        They, chapter by chapter.
    failed
        Those that do not hold.
    closest
        Those whose errors are the largest parts of their bounds.
    exact
        How many are off by rounding alone.
    least_order
        The least order of those that claim one.
    naive_missed
        How many of the bounds pymunk misses at the same rate, used as it comes.
    """

    chapters: tuple[Chapter, ...]
    failed: tuple[Outcome, ...]
    closest: tuple[Outcome, ...]
    exact: int
    ordered: int
    least_order: float
    naive_missed: int
    total: int


def cases(outcomes: Sequence[Outcome]) -> Cases:
    """Return what the cases say."""
    orders = [o.order for o in outcomes if o.order is not None and isfinite(o.order)]
    return Cases(
        chapters=tuple(
            Chapter(title, tuple(_claims(group)))
            for title, group in by_chapter(outcomes, lambda outcome: outcome)
        ),
        failed=tuple(o for o in outcomes if not o.passed),
        closest=tuple(sorted(outcomes, key=share, reverse=True)[:CLOSEST]),
        exact=sum(o.error <= ROUNDING for o in outcomes),
        ordered=len(orders),
        least_order=min(orders, default=float("nan")),
        naive_missed=sum(o.naive_error > o.tolerance for o in outcomes),
        total=len(outcomes),
    )


def share(outcome: Outcome) -> float:
    """Return which part of its bound an error takes up."""
    return outcome.error / outcome.tolerance


def chapter(level: str) -> str:
    """Return the title of the chapter that a level belongs to."""
    folder = level.partition("/")[0]
    return TITLES.get(folder, folder.capitalize())


class OfLevel(Protocol):
    """What is about a level."""

    @property
    def level(self) -> str:
        """Its name."""


def by_chapter(things: Iterable[T], whose: Callable[[T], OfLevel]) -> list[tuple[str, list[T]]]:
    """Return things chapter by chapter, each by the level of what it is about."""
    groups: dict[str, list[T]] = {}
    for thing in things:
        groups.setdefault(chapter(whose(thing).level), []).append(thing)
    return list(groups.items())


def _claims(outcomes: Iterable[Outcome]) -> Iterator[Claim]:
    groups: dict[tuple[str, str, str, str], list[Outcome]] = {}
    for o in outcomes:
        groups.setdefault((o.name, o.level, o.quantity, o.because), []).append(o)
    for which, group in groups.items():
        yield Claim(*which, tuple((chosen(outcome), outcome) for outcome in group))


def chosen(outcome: Outcome) -> str:
    """Return the parameters that differ from the level's own, in words."""
    try:
        usual = load(find(outcome.level)).defaults
    except SandboxError:
        usual = {}
    changed = {n: v for n, v in outcome.parameters.items() if usual.get(n) != v}
    return ", ".join(f"{name} = {value:g}" for name, value in changed.items()) or "as it stands"


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
    price
        What our step takes of pymunk's own, at the same rate: the median.
    """

    rows: tuple[Row, ...]
    silent: tuple[Sweep, ...]
    exact: Group | None
    converging: Group | None
    alike: tuple[str, ...]
    no_closer: tuple[str, ...]
    price: float

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
    prices = [ratio for sweep in sweeps for ratio in _prices(sweep)]
    return Costs(
        rows=tuple(rows),
        silent=tuple(sweep for sweep, best in found if best is None),
        exact=_group([best.closer for _, best in compared if best.error <= ROUNDING]),
        converging=_group([best.closer for _, best in compared if best.error > ROUNDING]),
        alike=tuple(alike),
        no_closer=tuple(level for level, best in compared if best.closer <= 1),
        price=median(prices) if prices else float("nan"),
    )


def _group(ratios: Sequence[float]) -> Group | None:
    return Group(len(ratios), median(ratios), min(ratios)) if ratios else None


def _prices(sweep: Sweep) -> Iterator[float]:
    """Yield what ours takes of pymunk's time at the level's own rate, with the same iterations."""
    naive = {(p.rate, p.iterations): p for p in sweep.points if p.scheme == NAIVE}
    for point in sweep.points:
        other = naive.get((point.rate, point.iterations))
        if point.scheme == OURS and point.rate == sweep.own_rate and other:
            ratio = point.seconds_per_second / other.seconds_per_second
            if isfinite(ratio):
                yield ratio


@dataclass(frozen=True, slots=True)
class Hooks:
    """What levels pay for Python in their steps: the medians."""

    without: int
    ratio_without: float
    having: int
    added: float


def hooks(levels: Sequence[LevelCost]) -> Hooks:
    """Return what levels without hooks, and those that have one, pay beside the bare engine."""
    bare = [cost for cost in levels if not cost.hooks]
    having = [cost for cost in levels if cost.hooks]
    nothing = float("nan")
    return Hooks(
        len(bare),
        median([cost.ratio for cost in bare]) if bare else nothing,
        len(having),
        median([c.step_seconds - c.bare_step_seconds for c in having]) if having else nothing,
    )


@dataclass(frozen=True, slots=True)
class Requests:
    """Accuracies that were asked for, and how they were answered.

    Attributes
    ----------
    asked
        All of them.
    dear
        How many times the cheapest setting one may cost.
    """

    asked: tuple[Request, ...]
    dear: float = DEAR

    @property
    def met(self) -> int:
        """How many are delivered at no more than that."""
        return sum(request.honoured for request in self.asked)

    @property
    def beyond(self) -> int:
        """Of how many it is said that they cannot be had, and the sweep has none either."""
        return sum(request.beyond for request in self.asked)

    @property
    def unmet(self) -> tuple[Request, ...]:
        """The others."""
        return tuple(r for r in self.asked if not (r.honoured or r.beyond))

    @property
    def too_dear(self) -> int:
        """How many are delivered at more than that."""
        return sum(r.delivered <= r.target and not r.honoured for r in self.asked)

    @property
    def price(self) -> float:
        """What one costs over the cheapest setting of the sweep: the median."""
        ratios = [r.price / r.cheapest for r in self.asked if r.honoured and isfinite(r.cheapest)]
        return median(ratios) if ratios else float("nan")

    @property
    def targets(self) -> "list[tuple[float, Requests]]":
        """The same for each accuracy."""
        targets = dict.fromkeys(request.target for request in self.asked)
        return [(t, Requests(tuple(r for r in self.asked if r.target == t))) for t in targets]

    @property
    def chapters(self) -> "list[tuple[str, Requests]]":
        """The same chapter by chapter."""
        groups = by_chapter(self.asked, lambda request: request)
        return [(title, Requests(tuple(group))) for title, group in groups]

    @property
    def levels(self) -> list[tuple[str, list[Request]]]:
        """The requests of each level."""
        groups: dict[str, list[Request]] = {}
        for request in self.asked:
            groups.setdefault(request.level, []).append(request)
        return list(groups.items())


GROUPS = {
    "A": "exact, to rounding",
    "B": "converging",
    "C": "standing, holding together, or keeping their energy",
    "D": "beyond pymunk's own solver",
}
"""What is claimed of the hard cases."""


@dataclass(frozen=True, slots=True)
class HardCases:
    """Scenes that break engines, and how hard they can be made.

    Attributes
    ----------
    cases, frontiers
        Those that must hold, and those that are made harder until they break.
    failed
        What does not hold, and should.
    out_of_reach
        What is known not to hold, and why.
    """

    cases: tuple[Hard, ...]
    frontiers: tuple[Hard, ...]
    failed: tuple[str, ...]
    out_of_reach: tuple[str, ...]

    @property
    def held(self) -> int:
        """How many cases hold."""
        return sum(case.passed for case in self.cases)

    @property
    def further(self) -> int:
        """How many frontiers lie no nearer than pymunk's at the same cost."""
        return sum((f.frontier or 0) >= (f.naive_frontier or 0) for f in self.frontiers)

    @property
    def groups(self) -> list[tuple[str, list[Hard]]]:
        """The cases, by what is claimed of them."""
        found = {name: [c for c in self.cases if c.group == name] for name in GROUPS}
        return [(GROUPS[name], group) for name, group in found.items() if group]


def hard_cases(outcomes: Sequence[Hard]) -> HardCases:
    """Return what the hard cases say."""
    return HardCases(
        cases=tuple(o for o in outcomes if o.frontier is None),
        frontiers=tuple(o for o in outcomes if o.frontier is not None),
        failed=tuple(stability.failures(outcomes)),
        out_of_reach=tuple(stability.out_of_reach(outcomes)),
    )
