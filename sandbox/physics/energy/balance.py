"""The balance of energy and momentum at a step, read from the ledger."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.quantities import Quantity

COMPONENTS = {"x": 0, "y": 1}


@dataclass(frozen=True, slots=True)
class Balance:
    """The books at a step, as they stand in the middle of the drift that follows it."""

    kinetic: float
    """The kinetic energy of all bodies [J]."""
    potential: Mapping[str, float]
    """The potential energy, by the law that stores it [J]."""
    work: Mapping[str, float]
    loss: Mapping[str, float]
    """The energy put in, and the energy lost, by cause, since the books were opened [J]."""
    unexplained: float
    """The further change of the energy [J]."""
    impulse: Mapping[str, Array]
    """The impulse from outside since then, by cause: along x and y, and the angular one about the
    origin, (3,) each [N s, N m s]."""
    unexplained_impulse: Array
    """(3,), the further change of the momentum."""
    overlaps: float
    """The part of the unexplained energy due to the correction of overlaps [J]."""

    @property
    def energy(self) -> float:
        """The kinetic and potential energy [J]."""
        return self.kinetic + sum(self.potential.values())

    def value(self, quantity: Quantity) -> float:
        """Return a quantity of the ledger; for a vector without a component, its magnitude."""
        kind, _, name = quantity.attribute.partition(".")
        match kind:
            case "work":
                return self.work[name]
            case "loss":
                return self.loss[name]
            case "unexplained_energy":
                return self.unexplained
        impulse = self.impulse[name] if name else self.unexplained_impulse
        if kind in ("angular_impulse", "unexplained_angular_momentum"):
            return float(impulse[2])
        if quantity.component:
            return float(impulse[COMPONENTS[quantity.component]])
        return float(np.hypot(impulse[0], impulse[1]))
