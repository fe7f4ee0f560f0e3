"""A uniform magnetic field, and the charges that it turns."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import MOST_FORCES, Strength
from sandbox.model.reference_fields import ActedOn


class Charge(Model):
    """The charge of a body; several charges of the same body add up."""

    body: ActedOn
    """the charged body"""
    charge: Strength
    """C, negative for electrons"""


class Magnetic(Model):
    """A uniform magnetic field normal to the plane, F = q v × B; it does no work."""

    effect: ClassVar[Effect] = Effect(
        name="magnetic", depends_on=("velocity",), strength=("field",), force_name="magnetic force"
    )

    field: Strength
    """T, positive out of the plane, negative into it; positive charges circle clockwise in a
    positive field"""
    charges: Annotated[tuple[Charge, ...], Field(min_length=1, max_length=MOST_FORCES)]
    """the charges that it acts on"""
