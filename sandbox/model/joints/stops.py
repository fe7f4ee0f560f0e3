"""Stops: motion is free between two limits, and goes no further."""

from typing import ClassVar, Literal

from sandbox.model.base import Model
from sandbox.model.bounds import Angle, Travel
from sandbox.model.expressions import Fraction
from sandbox.model.joints.contract import Kind
from sandbox.model.joints.ends import End
from sandbox.model.shapes import Point


class Stop(Model):
    """Stops on a straight way: what runs into one stays there as long as it presses, or bounces.

    It pushes along the way and holds nothing across it, as a rail does.
    """

    kind: ClassVar[Kind] = Kind(goes_slack=True, points_meet=True, pull="push of the stop")

    type: Literal["stop"]
    ends: tuple[End, End]
    """what is stopped, and what it is counted from"""
    direction: Point
    """[x, y], along which it is counted, of any length; it does not turn"""
    range: tuple[Travel, Travel]
    """[from, to] in m, how far along the first end may be from the second"""
    restitution: Fraction | None = None
    """the speed with which it is left, of that with which it is run into; it takes all if left
    out"""


class AngleStop(Model):
    """Stops of an angle, as of a knee, a door or a ratchet."""

    kind: ClassVar[Kind] = Kind(
        goes_slack=True, turns=True, points_meet=True, quantities={"torque": "N·m"}
    )

    type: Literal["angle_stop"]
    ends: tuple[End, End]
    """what the angle is counted from, a body or the plane, and the body that is stopped"""
    range: tuple[Angle, Angle]
    """[from, to] in rad, between which the angle of the second is, less that of the first"""
    restitution: Fraction | None = None
    """the rate with which it is left, of that with which it is turned into; it takes all if left
    out"""
