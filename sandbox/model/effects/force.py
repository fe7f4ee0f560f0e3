"""Given forces."""

from typing import ClassVar, Literal

from sandbox.model.base import Model
from sandbox.model.bounds import Coordinate, ForceOverTime
from sandbox.model.effects.contract import Effect
from sandbox.model.naming import Name
from sandbox.model.reference_fields import ActedOn
from sandbox.model.shapes import Point


class Force(Model):
    """A given force on a body, constant or of time."""

    effect: ClassVar[Effect] = Effect(
        name="force",
        book="potential",
        drives=lambda force: force.has_no_potential,
        sees=("angle", "time"),
        strength=("force",),
        pull="applied force",
    )

    name: Name | None = None
    """what events call it that switch it on or off"""
    body: ActedOn
    """what it acts on"""
    force: tuple[ForceOverTime, ForceOverTime]
    """[x, y] in N, over the parameters and the time t"""
    at: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the point that it acts on, from the centre of mass along the body's axes"""
    frame: Literal["world", "body"] = "world"
    """whose axes [x, y] lie along: `body` for a force that turns with the body, as a thruster's"""

    @property
    def has_no_potential(self) -> bool:
        """Whether it depends on time, or turns with its body, so that it does work."""
        return self.frame == "body" or any("t" in component.names for component in self.force)
