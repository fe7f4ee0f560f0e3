"""Attraction of bodies to each other."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Strength, Width
from sandbox.model.reference_fields import ActedOnBodies


class Gravitation(Model):
    """Bodies attract each other: |F| = G m1 m2 r / s³, U = −G m1 m2 / s, s² = r² + softening²."""

    effect: ClassVar[Effect] = Effect(
        name="gravitation",
        book="potential",
        depends_on=("position",),
        is_internal=True,
        is_singular=True,
        softening="softening",
        strength=("constant",),
        trial={"constant": 1},
    )

    constant: Strength
    """m³/(kg s²), G; negative to repel"""
    softening: Width = Width(0)
    """m, the Plummer softening length, which bounds the force at short distances; 0 for Newton's
    law"""
    bodies: Annotated[ActedOnBodies, Field(min_length=2)] | None = None
    """the bodies that attract each other; all dynamic bodies if left out"""
