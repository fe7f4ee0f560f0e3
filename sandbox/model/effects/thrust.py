"""Rockets."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.bounds import Flow, Mass
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import ActedOn
from sandbox.model.shapes import Velocity


class Thrust(Model):
    """A rocket: m dv/dt = F + u dm/dt, from the start until its propellant is burnt.

    Its mass falls at the rate, and its moment of inertia with the mass.
    """

    effect: ClassVar[Effect] = Effect(
        name="thrust",
        smooth=False,
        book="work",
        sees=("angle", "time"),
        strength=("exhaust",),
        changes_mass=True,
    )

    body: ActedOn
    """what it drives"""
    exhaust: Velocity
    """[x, y] in m/s, u, the velocity of what leaves relative to the body, along the body's axes"""
    rate: Flow
    """kg/s, how fast it leaves"""
    propellant: Mass
    """kg, how much of the body's mass leaves; less than all"""
