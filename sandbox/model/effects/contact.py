"""Bodies that touch."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import MOST_PAIRS, Width
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Fraction
from sandbox.model.reference_fields import ActedOnBodies, BodyNames


class Contact(Model):
    """Bodies are impenetrable. Without it shapes are drawn, but never touch."""

    effect: ClassVar[Effect] = Effect(
        name="contact", acts="scene", smooth=False, book="loss", account="impacts", trial={}
    )

    correction: Fraction | None = None
    """the share of an overlap that each step takes back; if left out 0.2, but 0 where the level
    declares restitution, for pushing bodies apart adds to the energy of their bounces; by the
    direct solver 0.5 of bodies that press on each other, and nothing of those that bounce"""
    slop: Width | None = None
    """m, the overlap that is left alone; if left out 1e-6 m, and for piles half a hundredth of the
    narrowest body that moves"""
    piles: bool = False
    """whether bodies lie on each other in piles, which overlaps that are taken back to the last
    would stir, so that they never come to rest"""
    located: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the dynamic bodies whose impacts are located in time, within the step; those of the others
    are found at the next step, or missed where a body passes through another in between. The direct
    solver locates all impacts by itself"""
    solver: Literal["iterative", "direct"] | None = None
    """how the forces between bodies that touch are found: by sweeps of pymunk's solver
    (`iterative`), or all at once and together with the exact joints (`direct`), which takes longer
    where many touch; if left out `direct` where the level has exact joints, or bodies that stick
    and impacts that are located"""
    apart: Annotated[
        tuple[Annotated[BodyNames, Field(min_length=2)], ...], Field(max_length=MOST_PAIRS)
    ] = ()
    """groups of bodies of which none meets another of its group; a pair is a group of two"""
    jointed: bool = True
    """whether bodies that a joint holds together meet each other"""
    overlaps: bool = False
    """whether bodies may overlap at the start; if not, those that do are a mistake"""
