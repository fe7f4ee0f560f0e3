"""Buoyancy in a liquid at rest."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import Coordinate, Density, Pull
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import ActedOnBodies


class Buoyancy(Model):
    """A liquid at rest carries what displaces it: F = −ρ A g, at the centre of the area A."""

    effect: ClassVar[Effect] = Effect(
        name="buoyancy",
        book="potential",
        sees=("position", "angle"),
        smooth=False,
        strength=("density",),
        twists=True,
        trial={"density": 20, "gravity": 9.81},  # twice that of drawn bodies, which float
    )

    density: Density
    """kg/m², ρ, for each square metre of the plane: a density times the depth of the scene"""
    gravity: Pull
    """m/s², g, with which the liquid presses down, along −y"""
    surface: Coordinate = Coordinate(0)
    """m, the y of its surface, which does not rise by what is displaced"""
    bodies: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """those that it carries, discs, boxes or polygons; all dynamic ones if left out"""
