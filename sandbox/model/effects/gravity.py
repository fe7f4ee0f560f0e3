"""Uniform gravity."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.shapes import Fall


class Gravity(Model):
    """Uniform gravity on every dynamic body: F = m g, U = −m g · r."""

    effect: ClassVar[Effect] = Effect(
        name="gravity",
        acts="pymunk",
        book="potential",
        strength=("acceleration",),
        trial={"acceleration": [0, -9.81]},
        force_name="weight",
    )

    acceleration: Fall
    """[x, y] in m/s², g; downwards, y is negative: `[0, -9.81]`"""
