"""Given torques."""

from typing import ClassVar

from sandbox.model.base import Model, Name
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import TorqueOfTurning
from sandbox.model.reference_fields import ActedOn, BodyName


class Torque(Model):
    """A torque on a body, τ(θ, ω, t): a drive, a motor with limited torque, a friction brake."""

    effect: ClassVar[Effect] = Effect(
        name="torque",
        book="work",
        depends_on=("angle", "velocity", "time"),
        exerts_torque=True,
        strength=("torque",),
    )

    name: Name | None = None
    """the name by which events switch it on or off"""
    body: ActedOn
    """the body that it acts on"""
    torque: TorqueOfTurning
    """N·m, counter-clockwise, a function of the body's angle theta [rad], its angular velocity
    omega [rad/s] and the time t: for example `max(-2, min(2, 50*(3 - omega)))` for a motor that
    gives 3 rad/s with at most 2 N·m"""
    against: BodyName | None = None
    """the reference body, on which the opposite torque acts, and relative to which theta and omega
    are measured; the plane if left out"""
