"""Equations in which bodies turn: an angle that is kept, and a string that is wound on a wheel."""

from cmath import exp, phase
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import atan2, pi, sqrt, tau

import numpy as np

from sandbox.physics.joints.exact.constraints import Coordinates, Equation, Share
from sandbox.physics.joints.exact.distances import Row
from sandbox.physics.state.anchor import Anchor
from sandbox.physics.state.errors import JointFailure

PLANE = -1
"""The number of the plane itself, which is the last of the bodies."""


@dataclass(frozen=True, slots=True)
class Turn:
    """The angle from one body to another is given: θ_b − θ_a [rad]."""

    joint: str
    a: int
    b: int
    length: float
    changing: Callable[[float], float] | None = None
    pulls_only: bool = False

    def look(self, place: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return the angle, and its jacobian."""
        angle = float(place.angle[self.b] - place.angle[self.a])
        return angle, (Share(self.b, 0j, 1.0), Share(self.a, 0j, -1.0))


@dataclass(slots=True)
class Wound:
    """A string that is wound on a wheel: s ± R (φ − θ) is given, free and wound together [m].

    s = √(d² − R²) is free, θ is the wheel's angle, and at φ the string leaves the wheel; the sign
    is + where the wheel turns counter-clockwise to give off string. φ is followed around and around
    from one look to the next. The gradient is the direction of the free string.
    """

    joint: str
    end: Anchor
    wheel: int
    radius: float
    sense: int
    length: float = 0.0
    changing: None = None
    pulls_only: bool = True
    _contact: float = field(default=0.0, init=False)

    def look(self, place: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return how long it is, free and wound, and the gradient of that.

        Raises
        ------
        JointFailure
            If its end is within the wheel.
        """
        body = number(self.end)
        arm = self.end.point * exp(1j * place.angle[body])
        apart = complex(place.plane[body] + arm - place.plane[self.wheel])
        square = abs(apart) ** 2 - self.radius**2
        if square <= 0:
            raise JointFailure(self.joint, f"the end of '{self.joint}' has run into its wheel")
        free = sqrt(square)
        contact = phase(apart) - self.sense * atan2(free, self.radius)
        self._contact = contact + tau * float(np.rint((self._contact - contact) / tau))
        wound = self.radius * self.sense * (self._contact - float(place.angle[self.wheel]))
        along = exp(1j * (contact + self.sense * pi / 2))
        return free + wound, (
            Share(body, along, (along.conjugate() * 1j * arm).real),
            Share(self.wheel, -along, -self.sense * self.radius),
        )


def pin(name: str, a: Anchor, b: Anchor) -> list[Row]:
    """Return the equations that keep two points together."""
    return [Row(name, [(a, b)], 0.0, along=direction) for direction in (1 + 0j, 1j)]


def weld(name: str, a: Anchor, b: Anchor, start: Coordinates) -> tuple[list[Row], list[Equation]]:
    """Return the equations that keep b where it is from a, and at its angle to it."""
    first, second = number(a), number(b)
    point = start.plane[second] + b.point * exp(1j * start.angle[second])
    there = (point - start.plane[first]) * exp(-1j * start.angle[first])
    return pin(name, Anchor(a.body, complex(there)), b), [turn(name, a, b, start)]


def turn(
    name: str,
    a: Anchor,
    b: Anchor,
    start: Coordinates,
    changing: Callable[[float], float] | None = None,
) -> Turn:
    """Return the equation that keeps the angle that b has to a, or adds to it in time."""
    first, second = number(a), number(b)
    angle = float(start.angle[second] - start.angle[first])
    return Turn(name, first, second, angle, changing)


def winding(
    name: str, end: Anchor, wheel: Anchor, radius: float, sense: int, start: Coordinates
) -> Wound:
    """Return the equation of a string that is as long as it is at the start."""
    assert wheel.body is not None
    wound = Wound(name, end, wheel.body, radius, sense)
    wound.length = wound.look(start)[0]
    return wound


def number(anchor: Anchor) -> int:
    """Return the number of the body that an anchor belongs to."""
    return PLANE if anchor.body is None else anchor.body
