"""Belts: surfaces that run."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Velocity


class Belt(Model):
    """A body whose surface runs along it: friction carries along what touches it."""

    effect: ClassVar[Effect] = Effect(
        name="belt", acts="scene", smooth=False, book="work", strength=("velocity",)
    )

    body: BodyName
    """which; static or kinematic"""
    velocity: Velocity
    """[x, y] in m/s of its surface, along the body's axes; only what lies along a side counts"""
