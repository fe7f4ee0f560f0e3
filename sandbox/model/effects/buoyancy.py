"""Buoyancy in a liquid at rest."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Coordinate, Density, Pull
from sandbox.model.reference_fields import ActedOnBodies


class Buoyancy(Model):
    """Buoyancy in a liquid at rest: F = −ρ A g, at the centroid of the submerged area A."""

    effect: ClassVar[Effect] = Effect(
        name="buoyancy",
        book="potential",
        depends_on=("position", "angle"),
        smooth=False,
        strength=("density",),
        exerts_torque=True,
        trial={"density": 20, "gravity": 9.81},  # twice that of drawn bodies, which float
    )

    density: Density
    """kg/m², ρ, mass per area of the plane: the liquid's density times the depth of the scene"""
    gravity: Pull
    """m/s², g, the gravitational acceleration of the liquid, along −y"""
    surface: Coordinate = Coordinate(0)
    """m, the y of the liquid's surface, which does not rise as bodies displace liquid"""
    bodies: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the bodies that float or sink in it: discs, boxes or polygons; all dynamic bodies if left
    out"""
