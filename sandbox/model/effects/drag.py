"""Drag through a fluid at rest."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Damping, Resistance
from sandbox.model.reference_fields import ActedOnBodies


class Drag(Model):
    """Drag in a fluid at rest: F = −(linear + quadratic |v|) v."""

    effect: ClassVar[Effect] = Effect(
        name="drag",
        book="loss",
        depends_on=("velocity",),
        needs=("linear", "quadratic"),
        trial={"linear": 0.1},
    )

    linear: Damping = Damping(0)
    """kg/s, the coefficient of linear (Stokes) drag, for slow motion"""
    quadratic: Resistance = Resistance(0)
    """kg/m, the coefficient of quadratic drag, for fast motion"""
    bodies: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the bodies that it acts on; all dynamic bodies if left out"""
