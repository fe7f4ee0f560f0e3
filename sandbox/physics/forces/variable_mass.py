"""Bodies whose mass changes as they lose or gain matter."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Integers

Share = Callable[[Array], Array | float]
"""The masses of n bodies at a time, or at many, relative to the start: (..., n), or 1. Moments of
inertia change with the mass: matter leaves or comes evenly over the body."""


def steady(_t: Array) -> float:
    """Return 1: no mass ever changes."""
    return 1.0


@dataclass(frozen=True, slots=True)
class Flow:
    """A steady flow of matter to a body, which begins with the run."""

    body: int
    rate: float  # kg/s, negative where the body loses it
    until: float = inf  # s
    effect: str = ""  # what lets it flow

    def gained(self, t: Array) -> Array:
        """Return the matter gained up to a time [kg], as if it had flowed before the start, too."""
        gained: Array = self.rate * np.minimum(t, self.until)
        return gained

    def mean_rate(self, t: Array, step: float) -> Array:
        """Return the mean rate over the kick around a time [kg/s]; it may end within."""
        return (self.gained(t + step / 2) - self.gained(t - step / 2)) / step


@dataclass(frozen=True, slots=True)
class MassFlows:
    """All flows of a scene, and how they change the masses of its n bodies; see `Share`."""

    flows: Sequence[Flow]
    mass: Array  # (n,) kg, at the start
    bodies: Integers = field(init=False)  # those whose mass changes

    def __post_init__(self) -> None:
        """See whose mass changes."""
        object.__setattr__(self, "bodies", np.unique([flow.body for flow in self.flows]))

    def __call__(self, t: Array) -> Array:
        """Return the masses over those at the start: (..., n)."""
        share = np.ones((*np.shape(t), len(self.mass)))
        for flow in self.flows:
            share[..., flow.body] += flow.gained(t) / self.mass[flow.body]
        return share

    def carriers(self) -> dict[str, list[int]]:
        """Return the bodies that lose or gain matter, by effect."""
        found: dict[str, list[int]] = {}
        for flow in self.flows:
            bodies = found.setdefault(flow.effect, [])
            if flow.body not in bodies:
                bodies.append(flow.body)
        return found
