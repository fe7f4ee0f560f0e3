"""The joints that connect bodies; see `contract` for the declaration of a kind.

All but the spring are exact: they hold to rounding at every step under any load, unless a level
asks for pymunk's own joints. A spring is a force.
"""

from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal, get_args

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import (
    Damping,
    Extent,
    LengthOverTime,
    Load,
    SpinOverTime,
    SpringLaw,
    Stiffness,
    Width,
)
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Expression
from sandbox.model.formulas import Curve
from sandbox.model.joints.contract import FIXED, Kind, kinds
from sandbox.model.joints.ends import ENDS as ENDS
from sandbox.model.joints.ends import End as End
from sandbox.model.joints.ends import Held as Held
from sandbox.model.joints.gears import Gear as Gear
from sandbox.model.joints.gears import Rack as Rack
from sandbox.model.joints.stops import AngleStop as AngleStop
from sandbox.model.joints.stops import Stop as Stop
from sandbox.model.json_positions import Path
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Point

ELASTIC = Effect(name="spring", book="potential", sees=("position", "angle"))
"""The declaration of a spring without a damper, as a force."""


class Rod(Model):
    """A light, rigid rod: its ends keep their distance."""

    kind: ClassVar[Kind] = Kind(swings=True, pull="rod force")

    type: Literal["rod"]
    ends: tuple[End, End]
    """what it holds together; each turns freely"""
    length: LengthOverTime | None = None
    """m, of the parameters and the time t; the distance at the start if left out"""
    exact: bool = True
    """whether it holds to rounding; pymunk's own joint does not"""
    breaks_at: Load | None = None
    """N, the force at which it breaks, whether it pulls or pushes; never if left out"""


class Rope(Model):
    """A light, inextensible rope: it pulls and never pushes."""

    kind: ClassVar[Kind] = Kind(goes_slack=True, swings=True, pull="tension")

    type: Literal["rope"]
    ends: tuple[End, End]
    """what it ties together"""
    length: Extent | None = None
    """m; the distance at the start if left out, slack at first if longer"""
    exact: bool = True
    """whether it holds to rounding; pymunk's own joint does not"""
    breaks_at: Load | None = None
    """N, the tension at which it breaks; never if left out"""


class Pulley(Model):
    """A light, inextensible string over frictionless pegs; it pulls and never pushes.

    A peg that is a body, or a point of one, is a pulley that moves. It may run over several.
    """

    kind: ClassVar[Kind] = Kind(goes_slack=True, swings=True, pull="tension")

    type: Literal["pulley"]
    ends: tuple[End, End]
    """what it is tied to"""
    over: Annotated[tuple[End, ...], Field(min_length=1, max_length=20)]
    """the pegs it runs over, from the first end to the second"""
    length: Extent | None = None
    """m; the length of its path at the start if left out, slack at first if longer"""
    breaks_at: Load | None = None
    """N, the tension at which it breaks; never if left out"""


class Pivot(Model):
    """A frictionless pin through two bodies, or through a body and the plane."""

    kind: ClassVar[Kind] = Kind(points_meet=True)

    type: Literal["pivot"]
    ends: tuple[End, End]
    """the points that it keeps together"""
    exact: bool = True
    """whether it holds to rounding; pymunk's own joint does not"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Rail(Model):
    """A smooth, straight rail: it pushes across, and never along."""

    kind: ClassVar[Kind] = Kind(points_meet=True)

    type: Literal["rail"]
    ends: tuple[End, End]
    """what runs on it, and what it goes through"""
    direction: Point
    """[x, y], the way it goes, of any length; it does not turn"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Weld(Model):
    """Two bodies keep their places and angles to each other, or one keeps its own in the plane."""

    kind: ClassVar[Kind] = Kind(turns=True, quantities=FIXED)

    type: Literal["weld"]
    ends: tuple[End, End]
    """what it makes one; its tension and its torque are those at the second"""
    exact: bool = True
    """whether it holds to rounding; pymunk's own joint does not"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Motor(Model):
    """A pin that turns: it drives its second body against its first, or against the plane."""

    kind: ClassVar[Kind] = Kind(drives=True, turns=True, points_meet=True, quantities=FIXED)

    type: Literal["motor"]
    ends: tuple[End, End]
    """the points that it keeps together"""
    rate: SpinOverTime
    """rad/s, counter-clockwise, of the parameters and the time t; it takes the torque it needs"""
    exact: bool = True
    """whether it holds to rounding; pymunk's own joint does not"""
    breaks_at: Load | None = None
    """N, the force at which it breaks; never if left out"""


class Winding(Model):
    """A light, inextensible string wound on a wheel; it does not slip, and pulls, never pushes."""

    kind: ClassVar[Kind] = Kind(
        goes_slack=True, turns=True, swings=True, points_meet=True, pull="tension"
    )

    type: Literal["winding"]
    ends: tuple[End, BodyName]
    """what it is tied to, outside the wheel; the body that is the wheel"""
    radius: Extent
    """m, of the circle on which it is wound, about the wheel's centre of mass"""
    unwinds: Literal["clockwise", "counterclockwise"]
    """how the wheel turns when it gives off string"""
    breaks_at: Load | None = None
    """N, the tension at which it breaks; never if left out"""


class Spring(Model):
    """A light spring with a damper, F = −k x − f(x) − c dx/dt, with x = l − l0.

    It stores U = k x² / 2 + ∫ f dx; f is a law of its own, which most have none of.
    """

    kind: ClassVar[Kind] = Kind(force=ELASTIC, pull="spring force")

    type: Literal["spring"]
    ends: tuple[End, End]
    """what it pulls at"""
    stiffness: Stiffness
    """N/m, k; 0 of one that has but a law of its own"""
    law: SpringLaw | None = None
    """N, f, with which it pulls beside k x, over how far it is stretched, x [m]: `300*x**3`, say"""
    length: Width | None = None
    """m, l0, where it is slack; the distance at the start if left out"""
    damping: Damping = Damping(0)
    """kg/s, c"""
    pushes_only: bool = False
    """whether it lets go beyond its length l0, as a bumper that is only touched"""
    breaks_at: Load | None = None
    """N, the force at which it breaks, whether it pulls or pushes; never if left out"""


class Wire(Model):
    """A smooth, rigid wire that a body slides along as a bead, without friction.

    A wire whose ends meet is closed. A bead that comes to an open end ends the run.
    """

    kind: ClassVar[Kind] = Kind(quantities={"tension": "N", "push": "N"}, pull="normal force")

    type: Literal["wire"]
    bead: End
    """the body, or the point of a body, that slides along it"""
    curve: tuple[Curve, Curve]
    """[x, y] in m of its points, over the parameters and s"""
    s: tuple[Expression, Expression]
    """from where to where s runs"""


Own = Rod | Rope | Pivot | Weld | Motor
"""The joints that exist in pymunk as well."""

Joint = Annotated[
    Rod
    | Rope
    | Pulley
    | Pivot
    | Rail
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
    if isinstance(end, Held):
        return end.body
    return end if isinstance(end, str) else None


def bodies_of(joint: Joint) -> Iterator[str]:
    """Yield the bodies that a joint holds."""
    yield from (body for end in points(joint) if (body := body_of(end)) is not None)
    if isinstance(joint, Gear) and joint.carrier is not None:
        yield joint.carrier
