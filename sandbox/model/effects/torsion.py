"""Torsion springs."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.bounds import Angle, Twist
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import ActedOn, BodyName


class Torsion(Model):
    """A torsion spring: τ = −k (θ − θ0), U = k (θ − θ0)² / 2; `torque` has what damps it."""

    effect: ClassVar[Effect] = Effect(
        name="torsion",
        book="potential",
        sees=("angle",),
        twists=True,
        strength=("stiffness",),
    )

    body: ActedOn
    """what it turns back"""
    stiffness: Twist
    """N·m/rad, k"""
    angle: Angle = Angle(0)
    """rad, θ0, where it is slack"""
    against: BodyName | None = None
    """the body that feels it the other way round, from which the angle is counted; the plane if
    left out"""
