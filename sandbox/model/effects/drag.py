"""Drag through a fluid at rest."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import Damping, Resistance
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import ActedOnBodies


class Drag(Model):
    """The drag of a fluid at rest: F = −(linear + quadratic |v|) v."""

    effect: ClassVar[Effect] = Effect(
        name="drag",
        book="loss",
        sees=("velocity",),
        needs=("linear", "quadratic"),
        trial={"linear": 0.1},
    )

    linear: Damping = Damping(0)
    """kg/s, Stokes's, of slow motion"""
    quadratic: Resistance = Resistance(0)
    """kg/m, of fast motion"""
    bodies: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """those that it acts on; all dynamic bodies if left out"""
