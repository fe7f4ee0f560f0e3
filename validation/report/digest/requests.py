"""The answers to requests for an accuracy."""

from dataclasses import dataclass
from math import isfinite
from statistics import median

from validation.cost.requests import EXPENSIVE, Request
from validation.report.digest.chapters import by_chapter


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
