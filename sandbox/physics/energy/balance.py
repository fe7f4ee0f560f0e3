"""The balance of energy and momentum at a step, read from the ledger."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.quantities import Quantity

COMPONENTS = {"x": 0, "y": 1}


@dataclass(frozen=True, slots=True)
class Balance:
    """The books at a step, as they stand in the middle of the drift that follows it.

    Attributes
    ----------
    kinetic
        Of all bodies [J].
    potential
        By what stores it [J].
    work, loss
        By what put it in, or took it for good, since the books were opened [J].
    unexplained
        What the energy has grown by beyond that [J].
    impulse
        By what gave it from outside, since then: x, y and, about the origin, angular momentum, (3,)
        each [N s, N m s].
    unexplained_impulse
        What the momentum has grown by beyond that: (3,).
    overlaps
        The part of the unexplained energy that correcting overlaps gave by moving bodies [J].
    """

    kinetic: float
    potential: Mapping[str, float]
    work: Mapping[str, float]
    loss: Mapping[str, float]
    unexplained: float
    impulse: Mapping[str, Array]
    unexplained_impulse: Array
    overlaps: float

    @property
    def energy(self) -> float:
        """Kinetic and potential [J]."""
        return self.kinetic + sum(self.potential.values())

    def value(self, quantity: Quantity) -> float:
        """Return a quantity that the ledger keeps; a vector without a component is its size."""
        kind, _, name = quantity.attribute.partition(".")
        match kind:
            case "work":
                return self.work[name]
            case "loss":
                return self.loss[name]
            case "unexplained_energy":
                return self.unexplained
        given = self.impulse[name] if name else self.unexplained_impulse
        if kind in ("angular_impulse", "unexplained_angular_momentum"):
            return float(given[2])
        if quantity.component:
            return float(given[COMPONENTS[quantity.component]])
        return float(np.hypot(given[0], given[1]))
