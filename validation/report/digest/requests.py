"""The answers to requests for an accuracy."""

from dataclasses import dataclass
from math import isfinite
from statistics import median

from validation.cost.requests import EXPENSIVE, Request
from validation.report.digest.chapters import by_chapter


@dataclass(frozen=True, slots=True)
class Requests:
    """Accuracies that were asked for, and how they were answered.

    Attributes
    ----------
    asked
        All of them.
    expensive
        How many times the cheapest setting one may cost.
    """

    asked: tuple[Request, ...]
    expensive: float = EXPENSIVE

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
    def too_expensive(self) -> int:
        """How many are delivered at more than that."""
        return sum(r.delivered <= r.target and not r.honoured for r in self.asked)

    @property
    def cost_ratio(self) -> float:
        """What one costs over the cheapest setting of the sweep: the median."""
        ratios = [r.cost / r.cheapest for r in self.asked if r.honoured and isfinite(r.cheapest)]
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
