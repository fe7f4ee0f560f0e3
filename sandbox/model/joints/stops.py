"""Stops: motion is free between two limits, and goes no further."""

from typing import ClassVar, Literal

from sandbox.model.base import Model
from sandbox.model.expressions import Fraction
from sandbox.model.joints.contract import End, Kind
from sandbox.model.number_bounds import Angle, Travel
from sandbox.model.shapes import Point


class Stop(Model):
    """Two stops along a direction: a body that runs into one is held there, or bounces.

    They push along the direction and, unlike a rail, hold nothing across it.
    """

    kind: ClassVar[Kind] = Kind(goes_slack=True, points_meet=True, force_name="push of the stop")

    type: Literal["stop"]
    ends: tuple[End, End]
    """the body or point that is stopped, and the reference that its travel is measured from"""
    direction: Point
    """[x, y], the direction of the travel, of any length; it does not turn"""
    range: tuple[Travel, Travel]
    """[from, to] in m, the limits of the travel of the first end from the second"""
    restitution: Fraction | None = None
    """the coefficient of restitution; if left out, a stop takes all the speed"""


class AngleStop(Model):
    """Limits of an angle, as of a knee, a door or a ratchet."""

    kind: ClassVar[Kind] = Kind(
        goes_slack=True, exerts_torque=True, points_meet=True, quantities={"torque": "N·m"}
    )

    type: Literal["angle_stop"]
    ends: tuple[End, End]
    """the reference, a body or the plane, and the body whose angle is limited"""
    range: tuple[Angle, Angle]
    """[from, to] in rad, the limits of the second body's angle relative to the first"""
    restitution: Fraction | None = None
    """the coefficient of restitution; if left out, a stop takes all the angular velocity"""
