"""The forces of a rotating frame."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Coordinate, Spin


class Centrifugal(Model):
    """The plane rotates about a vertical axis: F = m ω² (x − x0), U = −m ω² (x − x0)² / 2."""

    effect: ClassVar[Effect] = Effect(
        name="centrifugal",
        book="potential",
        depends_on=("position",),
        strength=("rate",),
        force_name="centrifugal force",
    )

    rate: Spin
    """rad/s, ω, the angular velocity of the plane"""
    axis: Coordinate = Coordinate(0)
    """m, x0, the x of the axis, which lies in the plane"""
