"""The outcome of the cases' claims."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import isfinite

from sandbox.model.errors import SandboxError
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from validation.case import Outcome
from validation.cost_of_accuracy.report import ROUNDING
from validation.report.digest.grouping_by_chapter import by_chapter

CLOSEST = 5
"""The number of cases closest to their bounds that are shown."""


@dataclass(frozen=True, slots=True)
class Claim:
    """A claim about a quantity, and its outcomes for several parameters."""

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
        """The outcomes of all its claims."""
        return [outcome for claim in self.claims for _, outcome in claim.rows]

    @property
    def held(self) -> int:
        """The number of outcomes that hold."""
        return sum(outcome.passed for outcome in self.outcomes)


@dataclass(frozen=True, slots=True)
class Cases:
    """All cases."""

    chapters: tuple[Chapter, ...]
    """The cases, chapter by chapter."""
    failed: tuple[Outcome, ...]
    """The cases that do not hold."""
    closest: tuple[Outcome, ...]
    """The cases whose errors are the largest shares of their bounds."""
    exact: int
    """The number of cases with no error but rounding."""
    ordered: int
    least_order: float
    """The least order among the cases that claim one."""
    naive_missed: int
    """The number of bounds that stock pymunk misses at the same rate."""
    total: int


def cases(outcomes: Sequence[Outcome]) -> Cases:
    """Return the digest of the cases."""
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
    """Return an error as a share of its bound."""
    return outcome.error / outcome.tolerance


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
