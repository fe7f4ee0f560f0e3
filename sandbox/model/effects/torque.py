"""Given torques."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.bounds import TorqueOfTurning
from sandbox.model.effects.contract import Effect
from sandbox.model.naming import Name
from sandbox.model.reference_fields import ActedOn, BodyName


class Torque(Model):
    """A torque on a body, τ(θ, ω, t): a drive, a motor with a largest torque, a friction brake."""

    effect: ClassVar[Effect] = Effect(
        name="torque",
        book="work",
        sees=("angle", "velocity", "time"),
        twists=True,
        strength=("torque",),
    )

    name: Name | None = None
    """what events call it that switch it on or off"""
    body: ActedOn
    """what it acts on"""
    torque: TorqueOfTurning
    """N·m, counter-clockwise, over the angle theta [rad] of the body, its angular velocity omega
    [rad/s] and the time t; of a motor for 3 rad/s that gives 2 N·m at the most, for example,
    `max(-2, min(2, 50*(3 - omega)))`"""
    against: BodyName | None = None
    """the body that feels it the other way round, from which theta and omega are counted then; the
    plane if left out"""
