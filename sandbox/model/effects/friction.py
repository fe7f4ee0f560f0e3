"""Friction between bodies that touch."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import MOST_PAIRS, Coefficient
from sandbox.model.effects.contract import Effect
from sandbox.model.effects.pair import Pair
from sandbox.model.reference_fields import ActedOnBodies


class FrictionPair(Pair):
    """The coefficient of one pair of bodies, instead of the product of the two bodies' own."""

    coefficient: Coefficient
    static: Coefficient | None = None
    """of surfaces that stick, until they slip; the same as when they slip if left out"""


class Friction(Model):
    """Coulomb friction between bodies in contact; the coefficient of a pair is the product."""

    effect: ClassVar[Effect] = Effect(
        name="friction",
        acts="scene",
        smooth=False,
        book="loss",
        coefficient=Coefficient,
        trial={"coefficient": 0.5},
    )

    pairs: Annotated[tuple[FrictionPair, ...], Field(max_length=MOST_PAIRS)] = ()
    """pairs of bodies with a coefficient of their own"""
    located: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the dynamic bodies whose slipping ends at its own time, located within the step; that of the
    others ends with the next kick"""
