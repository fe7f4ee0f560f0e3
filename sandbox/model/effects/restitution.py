"""Bodies that bounce."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contact import Pair
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Fraction
from sandbox.model.number_bounds import MOST_PAIRS


class RestitutionPair(Pair):
    """The coefficient of one pair of bodies, instead of the product of the bodies' own."""

    coefficient: Fraction
    """the coefficient of restitution"""


class Restitution(Model):
    """Bounces: separation over approach speed; a pair's ratio is the product of its bodies' own."""

    effect: ClassVar[Effect] = Effect(
        name="restitution",
        acts="scene",
        smooth=False,
        coefficient=Fraction,
        trial={"coefficient": 1},
    )

    pairs: Annotated[tuple[RestitutionPair, ...], Field(max_length=MOST_PAIRS)] = ()
    """the pairs of bodies with coefficients of their own"""
    impacts: Literal["together", "sequence"] = "together"
    """how the simultaneous impacts of bodies in contact are solved: `together`, as in pymunk, or in
    `sequence`, the fastest approach first, as hard bodies collide"""
