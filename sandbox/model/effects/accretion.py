"""Bodies that gather matter."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.bounds import Flow, Speed
from sandbox.model.effects.contract import Effect
from sandbox.model.reference_fields import ActedOn
from sandbox.model.shapes import Velocity


class Accretion(Model):
    """A body gathers matter, from the start on: m dv/dt = F + (w − v) dm/dt.

    Its mass grows at the rate, and its moment of inertia with the mass.
    """

    effect: ClassVar[Effect] = Effect(
        name="accretion",
        smooth=False,
        book="work",
        sees=("velocity", "time"),
        changes_mass=True,
        pull="push of what comes",
    )

    body: ActedOn
    """what gathers"""
    rate: Flow
    """kg/s, how fast matter comes"""
    velocity: Velocity = (Speed(0), Speed(0))
    """[x, y] in m/s, w, at which it comes"""
