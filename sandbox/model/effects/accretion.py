"""Bodies that gather matter."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import Flow, Speed
from sandbox.model.reference_fields import ActedOn
from sandbox.model.shapes import Velocity


class Accretion(Model):
    """A body that gathers matter from the start: m dv/dt = F + (w − v) dm/dt.

    Its mass grows at the given rate, and its moment of inertia in proportion.
    """

    effect: ClassVar[Effect] = Effect(
        name="accretion",
        smooth=False,
        book="work",
        depends_on=("velocity", "time"),
        changes_mass=True,
        force_name="push of what comes",
    )

    body: ActedOn
    """the body that gathers matter"""
    rate: Flow
    """kg/s, the rate at which its mass grows"""
    velocity: Velocity = (Speed(0), Speed(0))
    """[x, y] in m/s, w, the velocity of the matter"""
