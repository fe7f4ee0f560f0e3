"""A field of force."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field as Constrained

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import ForceInField
from sandbox.model.reference_fields import ActedOnBodies


class Field(Model):
    """A force field F(x, y, vx, vy, t), such as a wind; it acts on centres of mass."""

    effect: ClassVar[Effect] = Effect(
        name="field", book="work", depends_on=("position", "velocity", "time"), strength=("force",)
    )

    force: tuple[ForceInField, ForceInField]
    """[x, y] in N, a function of a body's position x, y [m], its velocity vx, vy [m/s] and the time
    t"""
    per: Literal["body", "mass"] = "body"
    """`body` if the force is in N, `mass` if it is in N/kg, like gravity"""
    bodies: Annotated[ActedOnBodies, Constrained(min_length=1)] | None = None
    """the bodies that it acts on; all dynamic bodies if left out"""
