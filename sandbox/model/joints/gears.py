"""Gears and racks: the motion of one body fixes that of another."""

from typing import ClassVar, Literal

from sandbox.model.base import Model
from sandbox.model.joints.contract import End, Kind
from sandbox.model.number_bounds import Extent, Load, Ratio
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Point


class Gear(Model):
    """A pair of gears, or two wheels with a chain: they turn at a fixed ratio.

    It couples only the angles; pins have to hold the wheels.
    """

    kind: ClassVar[Kind] = Kind(exerts_torque=True, points_meet=True, quantities={"torque": "N·m"})

    type: Literal["gear"]
    ends: tuple[BodyName, BodyName]
    """the wheels; the gear's torque is that on the second"""
    ratio: Ratio
    """the angle of the second wheel over that of the first; negative for opposite directions, as of
    wheels that mesh externally: `-10/40` if 10 teeth drive 40"""
    carrier: BodyName | None = None
    """the body relative to which both turn, such as the arm of a planetary gear; the plane if left
    out"""


class Rack(Model):
    """A rack and the wheel that meshes with it: the rack moves by r θ."""

    kind: ClassVar[Kind] = Kind(
        exerts_torque=True, points_meet=True, force_name="force of the teeth"
    )

    type: Literal["rack"]
    ends: tuple[End, BodyName]
    """the rack, or a point of it, and the wheel; its tension is the force between the teeth"""
    radius: Extent
    """m, the radius of the wheel"""
    direction: Point
    """[x, y], of any length: the direction in which the rack moves, relative to the wheel, as the
    wheel turns counter-clockwise; this direction is fixed in the plane"""
    breaks_at: Load | None = None
    """N, the force between the teeth at which it breaks; never if left out"""
