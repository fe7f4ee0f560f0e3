"""What pushes a body that loses or gains matter: m dv/dt = F + u dm/dt.

u is the velocity of what leaves or comes relative to the body (Meshchersky's equation).
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.forces.law import Book
from sandbox.physics.forces.variable_mass import Flow
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Thrust:
    """A rocket's: F = u dm/dt, with the exhaust's u along the body's axes and dm/dt < 0."""

    effect: ClassVar[str] = "thrust"
    book: ClassVar[Book] = "work"
    needs_velocity: ClassVar[bool] = False

    flow: Flow
    exhaust: XY  # m/s, relative to the body, along its axes
    step: float  # s

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add u dm/dt."""
        body, (x, y) = self.flow.body, self.exhaust
        rate = self.flow.mean_rate(motion.t, self.step)
        angle = motion.angle[..., body]
        c, s = np.cos(angle), np.sin(angle)
        wrench[..., body, 0] += rate * (c * x - s * y)
        wrench[..., body, 1] += rate * (s * x + c * y)

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: what leaves takes its energy along."""
        return np.zeros(motion.position.shape[:-1])


@dataclass(frozen=True, slots=True)
class Accretion:
    """A body gathers what moves at a velocity of its own: F = (w − v) dm/dt."""

    effect: ClassVar[str] = "accretion"
    book: ClassVar[Book] = "work"
    needs_velocity: ClassVar[bool] = True

    flow: Flow
    velocity: XY  # m/s, w
    step: float  # s

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add (w − v) dm/dt."""
        body = self.flow.body
        rate = self.flow.mean_rate(motion.t, self.step)
        wrench[..., body, :2] += rate[..., None] * (self.velocity - motion.velocity[..., body, :])

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero: what comes brings none."""
        return np.zeros(motion.position.shape[:-1])
