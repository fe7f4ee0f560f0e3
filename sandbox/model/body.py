"""A body of a level: its shape, its mass, how it moves, and how it meets others."""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from sandbox.model.base import Model, Name
from sandbox.model.expressions import Fraction
from sandbox.model.number_bounds import (
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
from sandbox.model.shapes import Point, Shape, Velocity

MAX_BODIES = 10_000
"""The most bodies in a level: so many are read in a second or two and run in real time at 60 Hz."""

MAX_POINTS = 100
"""The most named points of a body."""


Hand = Literal["left", "right"]


class Motion(Model):
    """A prescribed motion of a kinematic body: functions of the time t that are 0 at the start."""

    displacement: tuple[LengthOverTime, LengthOverTime] = (LengthOverTime(0), LengthOverTime(0))
    """[x, y] in m, relative to the initial position"""
    turn: AngleOverTime = AngleOverTime(0)
    """rad, counter-clockwise, relative to the initial angle"""


class Body(Model):
    """A rigid body."""

    type: Literal["dynamic", "kinematic", "static"] = "dynamic"
    """whether it moves under forces, as the level prescribes, or not at all"""
    shape: Shape
    """its outline, along its own axes"""
    mass: Mass | None = None
    """kg; required for dynamic bodies, not allowed for others"""
    moment: Moment | None = None
    """kg m², the moment of inertia about the centre of mass; that of the uniform shape if left
    out"""
    position: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the initial position, y up; for a dynamic body, that of its centre of mass"""
    angle: Angle = Angle(0)
    """rad, the initial angle, counter-clockwise; `"30*deg"` for degrees"""
    velocity: Velocity = (Speed(0), Speed(0))
    """[x, y] in m/s, the initial velocity"""
    angular_velocity: Spin = Spin(0)
    """rad/s, the initial angular velocity, counter-clockwise"""
    motion: Motion | None = None
    """the prescribed motion of a kinematic body, instead of a constant velocity"""
    friction: Coefficient | None = None
    """the coefficient of friction; a pair's is the product of its bodies' own"""
    static_friction: Coefficient | None = None
    """the coefficient of static friction, at least `friction`; equal to it if left out"""
    restitution: Fraction | None = None
    """the coefficient of restitution; a pair's is the product of its bodies' own"""
    sensor: bool = False
    """whether it is an area that others pass through, which measures how deep they are inside"""
    one_way: Hand | None = None
    """the only side to which a line lets others through, and on which it holds them, seen from its
    start towards its end; an arc runs counter-clockwise, so its left is inside"""
    points: Annotated[Mapping[Name, Point], Field(max_length=MAX_POINTS)] = {}
    """named points whose position and velocity can be measured, as in `stick.tip.velocity`; [x, y]
    in m, relative to its position, in its frame"""
    color: Annotated[str, Field(pattern=r"^#[0-9a-fA-F]{6}$")] | None = None
    """its colour, such as "#4cc9f0"; from a palette if left out"""
    hidden: bool = False
    """whether it is not drawn; it is simulated as usual"""
    layer: Annotated[int, Field(ge=-100, le=100)] = 0
    """the drawing order: higher layers are drawn over lower ones; bodies that never move are behind
    all others, unless their layer is above 0"""
