"""The outcome of the impacts of a step."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans


class ImpactOutcome(NamedTuple):
    """The outcome of the impacts of a step; n bodies.

    `struck`, (n,), tells which bodies they reached. `jump`, (n, 3), are the changes of the
    velocities, and `velocity`, (n, 3), the velocities at the step, right after the
    impacts [m/s, rad/s]. `impulse`, (n,), is the sum of the magnitudes of the impulses on each
    body [N s].
    """

    struck: Booleans
    jump: Array
    velocity: Array
    impulse: Array

    @classmethod
    def none(cls, count: int) -> "ImpactOutcome":
        """Return the outcome without impacts, for a number of bodies."""
        none: Array = np.zeros((count, 3))
        none.setflags(write=False)
        return cls(np.zeros(count, dtype=bool), none, none, none[:, 0])
