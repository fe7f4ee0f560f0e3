"""Rockets."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Flow, Mass
from sandbox.model.reference_fields import ActedOn
from sandbox.model.shapes import Velocity


class Thrust(Model):
    """A rocket: m dv/dt = F + u dm/dt, from the start until its propellant is burnt.

    Its mass falls at the given rate, and its moment of inertia in proportion.
    """

    effect: ClassVar[Effect] = Effect(
        name="thrust",
        smooth=False,
        book="work",
        depends_on=("angle", "time"),
        strength=("exhaust",),
        changes_mass=True,
    )

    body: ActedOn
    """the body that it drives"""
    exhaust: Velocity
    """[x, y] in m/s, u, the exhaust velocity relative to the body, in its frame"""
    rate: Flow
    """kg/s, the rate at which propellant is burnt"""
    propellant: Mass
    """kg, the part of the body's mass that is burnt; less than all of it"""
