"""Given forces."""

from typing import ClassVar, Literal

from sandbox.model.base import Model, Name
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Coordinate, ForceOverTime
from sandbox.model.reference_fields import ActedOn
from sandbox.model.shapes import Point


class Force(Model):
    """An applied force on a body, constant or a function of time."""

    effect: ClassVar[Effect] = Effect(
        name="force",
        book="potential",
        drives=lambda force: force.has_no_potential,
        depends_on=("angle", "time"),
        strength=("force",),
        force_name="applied force",
    )

    name: Name | None = None
    """the name by which events switch it on or off"""
    body: ActedOn
    """the body that it acts on"""
    force: tuple[ForceOverTime, ForceOverTime]
    """[x, y] in N, a function of the parameters and the time t"""
    at: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the point of application, relative to the centre of mass, in the body's frame"""
    frame: Literal["world", "body"] = "world"
    """the frame of the force: `body` for a force that turns with the body, like a thruster's"""

    @property
    def has_no_potential(self) -> bool:
        """Whether it depends on time, or turns with its body, so that it does work."""
        return self.frame == "body" or any("t" in component.names for component in self.force)
