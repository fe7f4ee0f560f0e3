"""Belts: surfaces that run."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Velocity


class Belt(Model):
    """A moving surface of a body, as of a conveyor belt: friction drags along what touches it."""

    effect: ClassVar[Effect] = Effect(
        name="belt", acts="scene", smooth=False, book="work", strength=("velocity",)
    )

    body: BodyName
    """the body, static or kinematic"""
    velocity: Velocity
    """[x, y] in m/s, the velocity of its surface in the body's frame; only the component along a
    side counts"""
