"""The outcome of the hard cases, and their frontiers."""

from collections.abc import Sequence
from dataclasses import dataclass

from validation.stability import report as stability
from validation.stability.run_all_cases import Outcome as Hard

GROUPS = {
    "A": "exact, to rounding",
    "B": "converging",
    "C": "standing, holding together, or keeping their energy",
    "D": "beyond pymunk's own solver",
}
"""The claims of the groups of hard cases."""


@dataclass(frozen=True, slots=True)
class HardCases:
    """Scenes that break engines, and the difficulties up to which they hold."""

    cases: tuple[Hard, ...]
    frontiers: tuple[Hard, ...]
    """The cases that must hold, and the scenes that are made harder until they break."""
    failed: tuple[str, ...]
    """The unexpected failures."""
    out_of_reach: tuple[str, ...]
    """The known failures, with the reasons."""

    @property
    def held(self) -> int:
        """The number of cases that hold."""
        return sum(case.passed for case in self.cases)

    @property
    def further(self) -> int:
        """The number of frontiers no nearer than pymunk's at the same cost."""
        return sum((f.frontier or 0) >= (f.naive_frontier or 0) for f in self.frontiers)

    @property
    def groups(self) -> list[tuple[str, list[Hard]]]:
        """The cases, grouped by claim."""
        found = {name: [c for c in self.cases if c.group == name] for name in GROUPS}
        return [(GROUPS[name], group) for name, group in found.items() if group]


def hard_cases(outcomes: Sequence[Hard]) -> HardCases:
    """Return the digest of the hard cases."""
    return HardCases(
        cases=tuple(o for o in outcomes if o.frontier is None),
        frontiers=tuple(o for o in outcomes if o.frontier is not None),
        failed=tuple(stability.failures(outcomes)),
        out_of_reach=tuple(stability.out_of_reach(outcomes)),
    )
