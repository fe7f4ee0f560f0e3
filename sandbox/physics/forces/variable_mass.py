"""Bodies whose mass changes as they lose or gain matter."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers

MassFraction = Callable[[Array], Array | float]
"""The masses of n bodies at times (...), over those at the start: (..., n), or 1 if constant.
Moments of inertia change in proportion: matter is lost or gained evenly over the body."""


def constant_mass(_t: Array) -> float:
    """Return 1: all masses are constant."""
    return 1.0


@dataclass(frozen=True, slots=True)
class Flow:
    """A steady flow of matter to a body, from the start of the run."""

    body: int
    rate: float  # kg/s, negative if the body loses matter
    until: float = inf  # s
    effect: str = ""  # that causes the flow

    def gained(self, t: Array) -> Array:
        """Return the mass gained from t = 0 to a time [kg], extrapolated to times before 0."""
        return self.rate * np.minimum(t, self.until)

    def mean_rate(self, t: Array, step: float) -> Array:
        """Return the mean rate over the kick around a time [kg/s]; the flow may end within it."""
        return (self.gained(t + step / 2) - self.gained(t - step / 2)) / step


@dataclass(frozen=True, slots=True)
class MassFlows:
    """All flows of a scene, as the masses of its n bodies over time; see `MassFraction`."""

    flows: Sequence[Flow]
    mass: Array  # (n,) kg, at the start
    bodies: Integers = field(init=False)  # the bodies whose masses change

    def __post_init__(self) -> None:
        """Store the bodies whose masses change."""
        object.__setattr__(self, "bodies", np.unique([flow.body for flow in self.flows]))

    def __call__(self, t: Array) -> Array:
        """Return the masses over those at the start: (..., n)."""
        fraction = np.ones((*np.shape(t), len(self.mass)))
        for flow in self.flows:
            fraction[..., flow.body] += flow.gained(t) / self.mass[flow.body]
        return fraction

    def carriers(self) -> dict[str, list[int]]:
        """Return the bodies that lose or gain matter, by effect."""
        bodies_by_effect: dict[str, list[int]] = {}
        for flow in self.flows:
            bodies = bodies_by_effect.setdefault(flow.effect, [])
            if flow.body not in bodies:
                bodies.append(flow.body)
        return bodies_by_effect
