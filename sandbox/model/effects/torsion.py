"""Torsion springs."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Angle, Twist
from sandbox.model.reference_fields import ActedOn, BodyName


class Torsion(Model):
    """A torsion spring: τ = −k (θ − θ0), U = k (θ − θ0)² / 2; a `torque` can damp it."""

    effect: ClassVar[Effect] = Effect(
        name="torsion",
        book="potential",
        depends_on=("angle",),
        exerts_torque=True,
        strength=("stiffness",),
    )

    body: ActedOn
    """the body that it acts on"""
    stiffness: Twist
    """N·m/rad, k, the torsional stiffness"""
    angle: Angle = Angle(0)
    """rad, θ0, the rest angle"""
    against: BodyName | None = None
    """the reference body, on which the opposite torque acts, and relative to which the angle is
    measured; the plane if left out"""
