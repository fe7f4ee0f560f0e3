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
from sandbox.model.functions_of_one_variable import Formula, Function

MOST_FORCES = 2000
"""The most forces, belts, rockets or centres of attraction of a level, each."""

MOST_PAIRS = 20_000
"""The most pairs of bodies that an effect may name."""

LARGEST_PARAMETER = 1e100
"""The largest bound of a parameter, whatever its sign."""

Finite = Annotated[float, Field(allow_inf_nan=False, ge=-LARGEST_PARAMETER, le=LARGEST_PARAMETER)]
"""A number of a parameter."""


class Mass(Positive, least=1e-35, most=1e35, unit="kg"):
    """A mass."""


class Moment(Positive, least=1e-65, most=1e65, unit="kg m²"):
    """A moment of inertia."""


class Coordinate(Expression, most=1e15, unit="m"):
    """Where something is, along an axis."""


class Travel(Expression, most=1e15, unit="m"):
    """How far something is along a way, or back."""


class Extent(Positive, least=1e-15, most=1e15, unit="m"):
    """How large something is."""


class Width(NonNegative, most=1e15, unit="m"):
    """How thick something is, if it is."""


class Angle(Expression, most=1e9, unit="rad"):
    """An angle."""


class Speed(Expression, most=1e12, unit="m/s"):
    """A velocity along an axis."""


class Spin(Expression, most=1e12, unit="rad/s"):
    """An angular velocity."""


class Acceleration(Expression, most=1e15, unit="m/s²"):
    """An acceleration along an axis."""


class Coefficient(NonNegative, most=1e6):
    """A coefficient of friction."""


class Stiffness(NonNegative, most=1e30, unit="N/m"):
    """How hard a spring pulls for its stretch."""


class Damping(NonNegative, most=1e30, unit="kg/s"):
    """How hard something is held back for its speed."""


class Resistance(NonNegative, most=1e30, unit="kg/m"):
    """How hard something is held back for the square of its speed."""


class Strength(Expression, most=1e40):
    """How strongly something attracts, in the unit that its law needs."""


class Ratio(Expression, most=1e6):
    """How many times as far one thing turns as another."""


class Power(Expression, most=10.0):
    """The power of a distance."""


class Density(NonNegative, most=1e30, unit="kg/m²"):
    """A mass for an area of the plane."""


class Load(Positive, least=1e-35, most=1e40, unit="N"):
    """A force that something bears."""


class Pull(NonNegative, most=1e15, unit="m/s²"):
    """An acceleration downwards."""


class Flow(Positive, least=1e-35, most=1e35, unit="kg/s"):
    """A mass for a time."""


class Duration(Positive, least=1e-12, most=1e12, unit="s"):
    """How long something lasts."""


class ForceOverTime(Formula, most=1e40, unit="N"):
    """A force along an axis, as a function of time."""


class LengthOverTime(Formula, most=1e15, unit="m"):
    """A length as a function of time."""


class AngleOverTime(Formula, most=1e9, unit="rad"):
    """An angle as a function of time."""


class SpinOverTime(Formula, most=1e12, unit="rad/s"):
    """An angular velocity as a function of time."""


class ForceInField(Function, most=1e40, unit="N", variables=("x", "y", "vx", "vy", "t")):
    """A force along an axis, as a function of position, velocity and time."""


class EnergyInField(Function, most=1e60, unit="J", variables=("x", "y")):
    """A potential energy, as a function of position."""


class TorqueOfTurning(Function, most=1e40, unit="N·m", variables=("theta", "omega", "t")):
    """A torque, as a function of a body's angle, its angular velocity and time."""


class Twist(NonNegative, most=1e30, unit="N·m/rad"):
    """How hard a torsion spring turns back for its angle."""


class SpringLaw(Function, most=1e40, unit="N", variables=("x",)):
    """The force with which a spring pulls, over how far it is stretched."""
