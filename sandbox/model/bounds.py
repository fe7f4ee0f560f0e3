"""Bounds for the numbers of a level, by what they measure.

They are declared only here: the model refuses values beyond them, with the value, the bound and the
reason, and the schema passes them on to editors. They are wider than mechanics needs, from the mass
of an electron to a thousand suns, but narrow enough that the products in a run, up to fourth powers
of lengths times masses, stay within the range of a float. Whether a rate is high enough for a scene
is checked elsewhere.
"""

from typing import Annotated

from pydantic import Field

from sandbox.model.expressions import Expression, NonNegative, Positive
from sandbox.model.formulas import Formula, Function

MOST_FORCES = 2000
"""The most forces, belts, rockets or centres of attraction of a level, each."""

MOST_PAIRS = 20_000
"""The most pairs of bodies that an effect may name."""

LARGEST_PARAMETER = 1e100
"""The largest bound of a parameter, whatever its sign."""

Finite = Annotated[float, Field(allow_inf_nan=False, ge=-LARGEST_PARAMETER, le=LARGEST_PARAMETER)]
"""A number of a parameter."""


class Mass(Positive):
    """A mass."""

    __slots__ = ()
    least, most, unit = 1e-35, 1e35, "kg"


class Moment(Positive):
    """A moment of inertia."""

    __slots__ = ()
    least, most, unit = 1e-65, 1e65, "kg m²"


class Coordinate(Expression):
    """Where something is, along an axis."""

    __slots__ = ()
    most, unit = 1e15, "m"


class Travel(Expression):
    """How far something is along a way, or back."""

    __slots__ = ()
    most, unit = 1e15, "m"


class Extent(Positive):
    """How large something is."""

    __slots__ = ()
    least, most, unit = 1e-15, 1e15, "m"


class Width(NonNegative):
    """How thick something is, if it is."""

    __slots__ = ()
    most, unit = 1e15, "m"


class Angle(Expression):
    """An angle."""

    __slots__ = ()
    most, unit = 1e9, "rad"


class Speed(Expression):
    """A velocity along an axis."""

    __slots__ = ()
    most, unit = 1e12, "m/s"


class Spin(Expression):
    """An angular velocity."""

    __slots__ = ()
    most, unit = 1e12, "rad/s"


class Acceleration(Expression):
    """An acceleration along an axis."""

    __slots__ = ()
    most, unit = 1e15, "m/s²"


class Coefficient(NonNegative):
    """A coefficient of friction."""

    __slots__ = ()
    most = 1e6


class Stiffness(NonNegative):
    """How hard a spring pulls for its stretch."""

    __slots__ = ()
    most, unit = 1e30, "N/m"


class Damping(NonNegative):
    """How hard something is held back for its speed."""

    __slots__ = ()
    most, unit = 1e30, "kg/s"


class Resistance(NonNegative):
    """How hard something is held back for the square of its speed."""

    __slots__ = ()
    most, unit = 1e30, "kg/m"


class Strength(Expression):
    """How strongly something attracts, in the unit that its law needs."""

    __slots__ = ()
    most = 1e40


class Ratio(Expression):
    """How many times as far one thing turns as another."""

    __slots__ = ()
    most = 1e6


class Power(Expression):
    """The power of a distance."""

    __slots__ = ()
    most = 10.0


class Density(NonNegative):
    """A mass for an area of the plane."""

    __slots__ = ()
    most, unit = 1e30, "kg/m²"


class Load(Positive):
    """A force that something bears."""

    __slots__ = ()
    least, most, unit = 1e-35, 1e40, "N"


class Pull(NonNegative):
    """An acceleration downwards."""

    __slots__ = ()
    most, unit = 1e15, "m/s²"


class Flow(Positive):
    """A mass for a time."""

    __slots__ = ()
    least, most, unit = 1e-35, 1e35, "kg/s"


class Duration(Positive):
    """How long something lasts."""

    __slots__ = ()
    least, most, unit = 1e-12, 1e12, "s"


class ForceOverTime(Formula):
    """A force along an axis, over the time."""

    __slots__ = ()
    most, unit = 1e40, "N"


class LengthOverTime(Formula):
    """A length over the time."""

    __slots__ = ()
    most, unit = 1e15, "m"


class AngleOverTime(Formula):
    """An angle over the time."""

    __slots__ = ()
    most, unit = 1e9, "rad"


class SpinOverTime(Formula):
    """An angular velocity over the time."""

    __slots__ = ()
    most, unit = 1e12, "rad/s"


class ForceInField(Function):
    """A force along an axis, over where a body is, how it moves, and the time."""

    __slots__ = ()
    most, unit = 1e40, "N"
    variables = ("x", "y", "vx", "vy", "t")


class EnergyInField(Function):
    """A potential energy, over where a body is."""

    __slots__ = ()
    most, unit = 1e60, "J"
    variables = ("x", "y")


class TorqueOfTurning(Function):
    """A torque, over how a body is turned, how fast it turns, and the time."""

    __slots__ = ()
    most, unit = 1e40, "N·m"
    variables = ("theta", "omega", "t")


class Twist(NonNegative):
    """How hard a torsion spring turns back for its angle."""

    __slots__ = ()
    most, unit = 1e30, "N·m/rad"


class SpringLaw(Function):
    """The force with which a spring pulls, over how far it is stretched."""

    __slots__ = ()
    most, unit = 1e40, "N"
    variables = ("x",)
