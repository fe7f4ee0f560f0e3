"""A body of a level: its shape, its mass, how it moves, and how it meets others."""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import (
    Angle,
    AngleOverTime,
    Coefficient,
    Coordinate,
    LengthOverTime,
    Mass,
    Moment,
    Speed,
    Spin,
)
from sandbox.model.expressions import Fraction
from sandbox.model.naming import Name
from sandbox.model.shapes import Point, Shape, Velocity

MAX_BODIES = 20_000
"""The most bodies in a level: ten thousand run in real time at 60 Hz."""

MAX_POINTS = 100
"""The most named points of a body."""


Hand = Literal["left", "right"]


class Motion(Model):
    """How a kinematic body moves, whatever meets it: formulas of the time t, 0 at the start."""

    displacement: tuple[LengthOverTime, LengthOverTime] = (LengthOverTime(0), LengthOverTime(0))
    """[x, y] in m, from where it starts"""
    turn: AngleOverTime = AngleOverTime(0)
    """rad, counter-clockwise, from the angle at which it starts"""


class Body(Model):
    """Something that moves, or that others move against."""

    type: Literal["dynamic", "kinematic", "static"] = "dynamic"
    """whether forces move it, it moves as the level says, or it stands still"""
    shape: Shape
    """its outline, along its own axes"""
    mass: Mass | None = None
    """kg; dynamic bodies have one, others do not"""
    moment: Moment | None = None
    """kg m², about the centre of mass; that of the uniform shape if left out"""
    position: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, y up, at the start; of a dynamic body the position of its centre of mass"""
    angle: Angle = Angle(0)
    """rad, counter-clockwise, at the start; from degrees with `"30*deg"`"""
    velocity: Velocity = (Speed(0), Speed(0))
    """[x, y] in m/s, at the start"""
    angular_velocity: Spin = Spin(0)
    """rad/s, counter-clockwise, at the start"""
    motion: Motion | None = None
    """how a kinematic body moves, if not at a constant velocity"""
    friction: Coefficient | None = None
    """coefficient; a pair's is the product of its bodies' own"""
    static_friction: Coefficient | None = None
    """coefficient while it sticks, not less than `friction`; the same as that if left out"""
    restitution: Fraction | None = None
    """coefficient; a pair's is the product of its bodies' own"""
    sensor: bool = False
    """whether it is an area that others pass through; it tells how deep they are in it"""
    one_way: Hand | None = None
    """the side to which alone the line lets others through, as one goes along it from its start to
    its end; there it holds them. An arc runs counter-clockwise, so its left is inside"""
    points: Annotated[Mapping[Name, Point], Field(max_length=MAX_POINTS)] = {}
    """points of it whose position and velocity can be measured, such as `stick.tip.velocity`;
    [x, y] in m, from its position, along its own axes"""
    color: Annotated[str, Field(pattern=r"^#[0-9a-fA-F]{6}$")] | None = None
    """as it is drawn, such as "#4cc9f0"; chosen from a palette if left out"""
    hidden: bool = False
    """whether it is left out of pictures; it takes part in everything else"""
    layer: Annotated[int, Field(ge=-100, le=100)] = 0
    """what has a higher one is drawn over what has a lower one; bodies that never move lie behind
    all that do, unless theirs is above 0"""
