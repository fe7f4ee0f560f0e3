"""Gears and racks: the motion of one body fixes that of another."""

from typing import ClassVar, Literal

from sandbox.model.base import Model
from sandbox.model.bounds import Extent, Load, Ratio
from sandbox.model.joints.contract import Kind
from sandbox.model.joints.ends import End
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Point


class Gear(Model):
    """Two wheels with teeth, or a chain around both: the second turns as the first one does.

    It holds their angles alone; what holds the wheels is up to pins.
    """

    kind: ClassVar[Kind] = Kind(turns=True, points_meet=True, quantities={"torque": "N·m"})

    type: Literal["gear"]
    ends: tuple[BodyName, BodyName]
    """the wheels; its torque is that on the second"""
    ratio: Ratio
    """how far the second turns while the first turns by one; negative if the other way round, as
    wheels that mesh from outside: `-10/40` where 10 teeth drive 40"""
    carrier: BodyName | None = None
    """what both turn against, as the arm of a planetary gear; the plane if left out"""


class Rack(Model):
    """A straight bar with teeth, and the wheel that meshes with it: it moves by r θ."""

    kind: ClassVar[Kind] = Kind(turns=True, points_meet=True, pull="force of the teeth")

    type: Literal["rack"]
    ends: tuple[End, BodyName]
    """the bar, or a point of it, and the wheel; its tension is the force between the teeth"""
    radius: Extent
    """m, of the wheel"""
    direction: Point
    """[x, y], of any length: the way of the bar, seen from the wheel, as that turns
    counter-clockwise; it does not turn"""
    breaks_at: Load | None = None
    """N, the force between the teeth at which it breaks; never if left out"""
