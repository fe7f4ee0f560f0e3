"""A potential; the force is its negative gradient."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import EnergyInField
from sandbox.model.reference_fields import ActedOnBodies


class Potential(Model):
    """A potential energy U(x, y): F = −∇U, with the exact gradient."""

    effect: ClassVar[Effect] = Effect(
        name="potential",
        book="potential",
        account="field",
        depends_on=("position",),
        strength=("energy",),
    )

    energy: EnergyInField
    """J, U, a function of a body's position x, y [m]"""
    per: Literal["body", "mass"] = "body"
    """`body` if the energy is in J, `mass` if it is in J/kg, like g y for gravity"""
    bodies: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the bodies that it acts on; all dynamic bodies if left out"""
