"""The joints that connect bodies; see `contract` for the declaration of a kind.

All but the spring are exact: they hold to rounding at every step under any load, unless a level
asks for pymunk's own joints. A spring is a force.
"""

from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal, TypeGuard, get_args

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Expression
from sandbox.model.functions_of_one_variable import Curve
from sandbox.model.joints.contract import ENDS as ENDS
from sandbox.model.joints.contract import FIXED, BodyEnd, Kind, kinds
from sandbox.model.joints.contract import End as End
from sandbox.model.joints.contract import Held as Held
from sandbox.model.joints.gears import Gear as Gear
from sandbox.model.joints.gears import Rack as Rack
from sandbox.model.joints.stops import AngleStop as AngleStop
from sandbox.model.joints.stops import Stop as Stop
from sandbox.model.json_positions import Path
from sandbox.model.number_bounds import (
    Damping,
    Extent,
    LengthOverTime,
    Load,
    SpinOverTime,
    SpringLaw,
    Stiffness,
    Width,
)
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Point

ELASTIC = Effect(name="spring", book="potential", depends_on=("position", "angle"))
"""The declaration of a spring without a damper, as a force."""


class Rod(Model):
    """A light, rigid rod, which keeps its ends at a given distance."""

    kind: ClassVar[Kind] = Kind(swings=True, force_name="rod force")

    type: Literal["rod"]
    ends: tuple[End, End]
    """the bodies or points that it connects; each end turns freely"""
    length: LengthOverTime | None = None
    """m, a function of the parameters and the time t; the initial distance if left out"""
    exact: bool = True
    """whether it is solved exactly, to rounding; if not, by pymunk's own joint"""
    breaks_at: Load | None = None
    """N, the force, tension or compression, at which it breaks; never if left out"""


class Rope(Model):
    """A light, inextensible rope: it pulls and never pushes."""

    kind: ClassVar[Kind] = Kind(goes_slack=True, swings=True, force_name="tension")

    type: Literal["rope"]
    ends: tuple[End, End]
    """the bodies or points that it connects"""
    length: Extent | None = None
    """m; the initial distance if left out, slack at first if longer"""
    exact: bool = True
    """whether it is solved exactly, to rounding; if not, by pymunk's own joint"""
    breaks_at: Load | None = None
    """N, the tension at which it breaks; never if left out"""


class Pulley(Model):
    """A light, inextensible string over frictionless pegs; it pulls and never pushes.

    It may run over several pegs. A peg that is a body, or a point of one, is a movable pulley.
    """

    kind: ClassVar[Kind] = Kind(goes_slack=True, swings=True, force_name="tension")

    type: Literal["pulley"]
    ends: tuple[End, End]
    """the bodies or points that it connects"""
    over: Annotated[tuple[End, ...], Field(min_length=1, max_length=20)]
    """the pegs that it runs over, in order from the first end to the second"""
    length: Extent | None = None
    """m; the initial length of its path if left out, slack at first if longer"""
    breaks_at: Load | None = None
    """N, the tension at which it breaks; never if left out"""


class Pivot(Model):
    """A frictionless pin through two bodies, or through a body and the plane."""

    kind: ClassVar[Kind] = Kind(points_meet=True)

    type: Literal["pivot"]
    ends: tuple[End, End]
    """the bodies or points that it connects; they coincide at the start"""
    exact: bool = True
    """whether it is solved exactly, to rounding; if not, by pymunk's own joint"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Rail(Model):
    """A smooth, straight rail: its force is normal to it."""

    kind: ClassVar[Kind] = Kind(points_meet=True)

    type: Literal["rail"]
    ends: tuple[End, End]
    """the body or point that slides along it, and the one through which it passes"""
    direction: Point
    """[x, y], the direction of the rail, of any length; it does not turn"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Slot(Model):
    """A smooth, straight slot in a body, or a rail on it, which turns with that body."""

    kind: ClassVar[Kind] = Kind(exerts_torque=True, points_meet=True)

    type: Literal["slot"]
    ends: tuple[End, BodyEnd]
    """the body or point that slides in it, and the body with the slot, at a point of the slot"""
    direction: Point
    """[x, y], the direction of the slot along the axes of its body, of any length"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Weld(Model):
    """A rigid connection of two bodies, or of a body and the plane."""

    kind: ClassVar[Kind] = Kind(exerts_torque=True, quantities=FIXED)

    type: Literal["weld"]
    ends: tuple[End, End]
    """the bodies or points that it connects; its tension and torque are those at the second"""
    exact: bool = True
    """whether it is solved exactly, to rounding; if not, by pymunk's own joint"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Motor(Model):
    """A driven pin: it turns its second body relative to its first, or to the plane."""

    kind: ClassVar[Kind] = Kind(drives=True, exerts_torque=True, points_meet=True, quantities=FIXED)

    type: Literal["motor"]
    ends: tuple[End, End]
    """the bodies or points that it connects; they coincide at the start"""
    rate: SpinOverTime
    """rad/s, the relative angular velocity, counter-clockwise, a function of the parameters and the
    time t; the torque is unlimited"""
    exact: bool = True
    """whether it is solved exactly, to rounding; if not, by pymunk's own joint"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Winding(Model):
    """A light, inextensible string wound on a wheel; it does not slip, and never pushes."""

    kind: ClassVar[Kind] = Kind(
        goes_slack=True, exerts_torque=True, swings=True, points_meet=True, force_name="tension"
    )

    type: Literal["winding"]
    ends: tuple[End, BodyName]
    """the body or point that it is tied to, outside the wheel, and the wheel"""
    radius: Extent
    """m, the radius on which it is wound, about the wheel's centre of mass"""
    unwinds: Literal["clockwise", "counterclockwise"]
    """the direction in which the wheel turns as the string unwinds"""
    breaks_at: Load | None = None
    """N, the tension at which it breaks; never if left out"""


class Spring(Model):
    """A light spring with a damper, F = −k x − f(x) − c dx/dt, with x = l − l0.

    It stores U = k x² / 2 + ∫ f dx. The nonlinear force f is optional.
    """

    kind: ClassVar[Kind] = Kind(force=ELASTIC, force_name="spring force")

    type: Literal["spring"]
    ends: tuple[End, End]
    """the bodies or points that it connects"""
    stiffness: Stiffness
    """N/m, k; 0 if `law` is its only force"""
    law: SpringLaw | None = None
    """N, f, a tension in addition to k x, a function of the stretch x [m]: for example
    `300*x**3`"""
    length: Width | None = None
    """m, l0, the natural length; the initial distance if left out"""
    damping: Damping = Damping(0)
    """kg/s, c, the damping coefficient"""
    pushes_only: bool = False
    """whether it only pushes, and lets go beyond its natural length l0, like a bumper"""
    breaks_at: Load | None = None
    """N, the force, tension or compression, at which it breaks; never if left out"""


class Wire(Model):
    """A rigid wire that a body slides along as a bead, without friction.

    A wire whose ends meet is closed. A bead that reaches an open end ends the run.
    """

    kind: ClassVar[Kind] = Kind(quantities={"tension": "N", "push": "N"}, force_name="normal force")

    type: Literal["wire"]
    bead: End
    """the body, or the point of a body, that slides along it"""
    curve: tuple[Curve, Curve]
    """[x, y] in m of its points, functions of the parameters and s"""
    s: tuple[Expression, Expression]
    """[from, to], the range of s"""


Own = Rod | Rope | Pivot | Weld | Motor
"""The joints that exist in pymunk as well."""

OneSided = Rope | Winding | Stop | AngleStop
"""The joints that act only where they are taut or reached."""

Joint = Annotated[
    Rod
    | Rope
    | Pulley
    | Pivot
    | Rail
    | Slot
    | Stop
    | AngleStop
    | Weld
    | Motor
    | Gear
    | Rack
    | Winding
    | Wire
    | Spring,
    Field(discriminator="type"),
]


KINDS: Mapping[str, Kind] = kinds(get_args(get_args(Joint)[0]))
"""The declaration of every kind of joint, by its type."""


def is_exact(joint: Joint) -> bool:
    """Whether a joint is solved exactly: neither a force nor one of pymunk's own joints."""
    return joint.kind.force is None and getattr(joint, "exact", True)


def is_solved_by_pymunk(joint: Joint) -> TypeGuard[Own]:
    """Whether a joint is one of pymunk's own, and no equation of ours."""
    return isinstance(joint, Own) and not joint.exact


def ends_of(joint: Joint) -> Iterator[tuple[Path, End]]:
    """Yield the points that a joint holds or runs through, each with its path in the joint."""
    if isinstance(joint, Wire):
        yield ("bead",), joint.bead
        return
    yield ("ends", 0), joint.ends[0]
    for index, peg in enumerate(joint.over if isinstance(joint, Pulley) else ()):
        yield ("over", index), peg
    yield ("ends", 1), joint.ends[1]


def points(joint: Joint) -> tuple[End, ...]:
    """Return the points that a joint holds or runs through, from its first end to its second."""
    return tuple(end for _, end in ends_of(joint))


def body_of(end: End) -> str | None:
    """Return the body of an end; None for a fixed point."""
    if isinstance(end, str):
        return end
    return None if isinstance(end, tuple) else end.body


def bodies_of(joint: Joint) -> Iterator[str]:
    """Yield the bodies that a joint holds."""
    yield from (body for end in points(joint) if (body := body_of(end)) is not None)
    if isinstance(joint, Gear) and joint.carrier is not None:
        yield joint.carrier
