"""A potential; the force is its negative gradient."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import EnergyInField
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import ActedOnBodies


class Potential(Model):
    """A potential energy U(x, y): F = −∇U, with the exact gradient."""

    effect: ClassVar[Effect] = Effect(
        name="potential",
        book="potential",
        account="field",
        sees=("position",),
        strength=("energy",),
    )

    energy: EnergyInField
    """J, U over the place x, y [m] of a body"""
    per: Literal["body", "mass"] = "body"
    """what it acts on: with `mass` it is in J/kg, as gravity's g y is"""
    bodies: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """those that it acts on; all dynamic bodies if left out"""
