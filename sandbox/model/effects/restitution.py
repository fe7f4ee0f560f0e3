"""Bodies that bounce."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import MOST_PAIRS
from sandbox.model.effects.contract import Effect
from sandbox.model.effects.pair import Pair
from sandbox.model.expressions import Fraction


class RestitutionPair(Pair):
    """The coefficient of one pair of bodies, instead of the product of the two bodies' own."""

    coefficient: Fraction


class Restitution(Model):
    """Bodies bounce: the speed of separation over that of approach, the product of a pair's."""

    effect: ClassVar[Effect] = Effect(
        name="restitution",
        acts="scene",
        smooth=False,
        coefficient=Fraction,
        trial={"coefficient": 1},
    )

    pairs: Annotated[tuple[RestitutionPair, ...], Field(max_length=MOST_PAIRS)] = ()
    """pairs of bodies with a coefficient of their own"""
    impacts: Literal["together", "sequence"] = "together"
    """of bodies that touch: pymunk solves them `together`; hard bodies collide in `sequence`, the
    fastest approach first"""
