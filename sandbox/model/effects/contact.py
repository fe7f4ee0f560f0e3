"""Bodies that touch."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Fraction
from sandbox.model.number_bounds import MOST_PAIRS, Width
from sandbox.model.reference_fields import ActedOnBodies, BodyNames, Couple


class Pair(Model):
    """A pair of bodies that can touch."""

    bodies: Couple
    """the names of the bodies, in any order"""


class Contact(Model):
    """Bodies are impenetrable. Without this effect, they pass through each other."""

    effect: ClassVar[Effect] = Effect(
        name="contact", acts="scene", smooth=False, book="loss", account="impacts", trial={}
    )

    correction: Fraction | None = None
    """the share of an overlap that each step removes; if left out, 0.2, or 0 if the level declares
    `restitution`, since pushing bodies apart adds energy to their bounces. For the direct solver,
    0.5 if left out; it corrects only contacts that last, not bounces"""
    slop: Width | None = None
    """m, the overlap that is not corrected; if left out, 1e-6 m, or with `piles` 0.005 times the
    width of the narrowest dynamic body; 1e-7 m for the direct solver"""
    piles: bool = False
    """whether bodies lie in piles; the iterative solver then leaves a larger overlap (see `slop`),
    since removing all of it would keep stirring the piles"""
    located: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the dynamic bodies whose impacts are located at their exact time within a step; with the
    iterative solver, other impacts are found at the next step, or missed if a body passes through
    another within a step. The direct solver locates all impacts by itself"""
    solver: Literal["iterative", "direct"] | None = None
    """how contact forces are found: `iterative`, by sweeps of pymunk's solver, or `direct`, all at
    once together with the exact joints, which takes longer for many contacts; if left out, `direct`
    if the level has exact joints, or springs and at most 20 moving bodies, or 3 to 50 moving
    bodies, or two and a force or masses that differ more than threefold (unless impacts are located
    or in sequence, or bodies may overlap), or bodies that stick and impacts that are located, or if
    sweeps do not settle what rests at the start"""
    apart: Annotated[
        tuple[Annotated[BodyNames, Field(min_length=2)], ...], Field(max_length=MOST_PAIRS)
    ] = ()
    """groups of bodies that do not collide within their group; a pair is a group of two"""
    jointed: bool = True
    """whether bodies that are connected by a joint collide with each other"""
    overlaps: bool = False
    """whether bodies may overlap at the start; if not, an overlap is a mistake"""
