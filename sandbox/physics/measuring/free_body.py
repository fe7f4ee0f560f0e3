"""A free-body diagram: a body, all forces on it, and its acceleration."""

from dataclasses import dataclass
from math import hypot
from typing import NamedTuple

from sandbox.model.shapes import XY

IMPACT, NORMAL, FRICTION, HAND = "impact", "normal force", "friction", "hand"
"""The names of forces that come neither from an effect nor from a joint."""


class AppliedForce(NamedTuple):
    """A force on a body."""

    name: str
    """Its name: `weight`, `normal force`, `tension`."""
    by: str
    """The body or joint that exerts it; empty if the name implies it."""
    force: XY
    """The components [N]."""
    at: XY
    """The point of application [m]."""
    couple: float = 0.0
    """An additional torque, beside that of the force at its point [N m]."""

    @classmethod
    def of(
        cls, name: str, by: str, force: XY, torque: float, center: XY, arm: XY | None
    ) -> "AppliedForce":
        """Return a force with a given torque about the centre of mass [N m].

        It acts at the end of a lever arm from there [m]; without one, at the point of its line of
        action that is closest to the centre.
        """
        x, y = force
        if arm is None:
            square = x * x + y * y
            arm = (y * torque / square, -x * torque / square) if square else (0.0, 0.0)
        at = center[0] + arm[0], center[1] + arm[1]
        return cls(name, by, force, at, torque - (arm[0] * y - arm[1] * x))

    @property
    def magnitude(self) -> float:
        """Its magnitude [N]."""
        return hypot(*self.force)

    @property
    def title(self) -> str:
        """Its name, and the body or joint that exerts it."""
        return f"{self.name}, {self.by}" if self.by else self.name

    def torque(self, center: XY) -> float:
        """Return its torque about a point [N m]."""
        x, y = self.at[0] - center[0], self.at[1] - center[1]
        return x * self.force[1] - y * self.force[0] + self.couple


@dataclass(frozen=True, slots=True)
class FreeBody:
    """A body and the forces on it at a step; see `free_body_forces` for what they are."""

    body: str
    t: float
    """The time [s]."""
    mass: float
    moment: float
    """Mass and moment of inertia at that time [kg, kg m²]; the moment is 0 if it cannot rotate."""
    center: XY
    """The centre of mass [m]."""
    forces: tuple[AppliedForce, ...]
    """The forces on it, without those that are zero."""
    acceleration: XY
    angular_acceleration: float
    """The accelerations over the same kick as the forces [m/s², rad/s²]."""
    surface_directions: tuple[XY, ...]
    """A unit vector along each surface that presses on it, the hardest first."""
    struck: bool
    """Whether an impact is among the forces."""
    is_completed: bool
    """Whether one force was computed from the others, so that the sum proves nothing."""

    @property
    def net(self) -> XY:
        """The sum of the forces [N]."""
        return (
            sum(acting.force[0] for acting in self.forces),
            sum(acting.force[1] for acting in self.forces),
        )

    @property
    def mass_times_acceleration(self) -> XY:
        """Mass times acceleration [N]."""
        return self.mass * self.acceleration[0], self.mass * self.acceleration[1]

    @property
    def torque(self) -> float:
        """The sum of the torques about the centre of mass [N m]."""
        return sum(acting.torque(self.center) for acting in self.forces)

    @property
    def largest(self) -> float:
        """The magnitude of the largest force [N]."""
        return max((acting.magnitude for acting in self.forces), default=0.0)

    @property
    def imbalance(self) -> float:
        """The magnitude of the sum less mass times acceleration [N]."""
        (x, y), (u, v) = self.net, self.mass_times_acceleration
        return hypot(x - u, y - v)
