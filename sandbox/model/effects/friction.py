"""Friction between bodies that touch."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contact import Pair
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import MOST_PAIRS, Coefficient
from sandbox.model.reference_fields import ActedOnBodies


class FrictionPair(Pair):
    """The coefficients of one pair of bodies, instead of the products of the bodies' own."""

    coefficient: Coefficient
    """the coefficient of friction"""
    static: Coefficient | None = None
    """the coefficient of static friction; the same as `coefficient` if left out"""


class Friction(Model):
    """Coulomb friction; a pair's coefficient is the product of its bodies' own."""

    effect: ClassVar[Effect] = Effect(
        name="friction",
        acts="scene",
        smooth=False,
        book="loss",
        coefficient=Coefficient,
        trial={"coefficient": 0.5},
    )

    pairs: Annotated[tuple[FrictionPair, ...], Field(max_length=MOST_PAIRS)] = ()
    """the pairs of bodies with coefficients of their own"""
    located: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the dynamic bodies whose slipping ends at its exact time within a step; that of other bodies
    ends with the next kick"""
