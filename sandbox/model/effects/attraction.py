"""Attraction to fixed centres."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Coordinate, Power, Strength
from sandbox.model.shapes import Point


class Attraction(Model):
    """Attraction to a fixed centre: |F| = mu m / r^p; by default Newton's law, U = −mu m / r."""

    effect: ClassVar[Effect] = Effect(
        name="attraction",
        book="potential",
        depends_on=("position",),
        strength=("mu",),
        trial={"mu": 1},
    )

    mu: Strength
    """m³/s² (with an exponent p: m^(p + 1)/s²), the strength of the centre; negative to repel"""
    center: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the position of the centre"""
    power: Power = Power(2)
    """p, the exponent: 3 for a force that falls off as 1/r³, −1 for one proportional to r"""
