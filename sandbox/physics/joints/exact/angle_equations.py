"""Equations with the angles of bodies: fixed angles, gears, and strings wound on wheels."""

from cmath import exp, phase
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import atan2, fsum, pi, sqrt, tau
from typing import TypeVar

import numpy as np

from sandbox.model.translatable_message import Message
from sandbox.physics.joints.exact.constraint_interface import Change, Coordinates, Share
from sandbox.physics.joints.exact.distance_equations import Row
from sandbox.physics.state.joint_anchors import Anchor
from sandbox.physics.state.simulation_errors import JointFailure

PLANE = -1
"""The index of the plane itself, which is the last of the bodies."""


@dataclass(frozen=True, slots=True)
class AngleEquation:
    """Keeps the angle of a body b relative to a: ±(θ_b − n θ_a − (1 − n) θ_c) [rad].

    n is the ratio of a gear, else 1; c is the arm that carries the gear.
    """

    joint: str
    a: int
    b: int
    length: float
    changing: Change | None = None
    pulls_only: bool = False
    sense: int = 1
    ratio: float = 1.0
    carrier: int = PLANE

    def evaluate(self, pose: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return the angle, and its gradient."""
        shares = (
            Share(self.b, 0j, float(self.sense)),
            Share(self.a, 0j, -self.sense * self.ratio),
            Share(self.carrier, 0j, -self.sense * (1 - self.ratio)),
        )[: 3 if self.ratio != 1 else 2]
        return fsum(share.angle * float(pose.angle[share.body]) for share in shares), shares


@dataclass(frozen=True, slots=True)
class RackEquation:
    """A bar that moves as a wheel turns: u · (r − r_wheel) − R θ is kept [m].

    u is the fixed direction of the bar; the teeth push along it, at the wheel's rim.
    """

    joint: str
    end: Anchor
    wheel: int
    radius: float
    direction: complex
    length: float = 0.0
    changing: None = None
    pulls_only: bool = False

    def evaluate(self, pose: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return the displacement of the bar beyond the wheel's rotation, and its gradient."""
        body = number(self.end)
        arm = self.end.point * exp(1j * pose.angle[body])
        apart = complex(pose.position[body] + arm - pose.position[self.wheel])
        along = (self.direction.conjugate() * apart).real
        return along - self.radius * float(pose.angle[self.wheel]), (
            Share(body, self.direction, (self.direction.conjugate() * 1j * arm).real),
            Share(self.wheel, -self.direction, -self.radius),
        )


@dataclass(frozen=True, slots=True)
class SlotEquation:
    """A point slides along a straight slot of a body: n · (r − r_slot) is kept at 0 [m].

    n is the normal to the right of the slot, given along the axes of its body, with which it turns.
    So the tension is the force on the point to the left, as that of a rail is.
    """

    joint: str
    end: Anchor
    slot: Anchor
    normal: complex
    length: float = 0.0
    changing: None = None
    pulls_only: bool = False

    def evaluate(self, pose: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return how far the point is beside the slot, and its gradient."""
        body, frame = number(self.end), number(self.slot)
        normal = self.normal * exp(1j * pose.angle[frame])
        arm = self.end.point * exp(1j * pose.angle[body])
        apart = complex(pose.position[body] + arm - pose.position[frame])
        beside = (normal.conjugate() * apart - self.normal.conjugate() * self.slot.point).real
        return beside, (
            Share(body, normal, (normal.conjugate() * 1j * arm).real),
            Share(frame, -normal, ((1j * normal).conjugate() * apart).real),
        )


@dataclass(slots=True)
class WindingEquation:
    """A string wound on a wheel: its length s ± R (φ − θ), free and wound, is kept [m].

    s = √(d² − R²) is the free length, θ the wheel's angle, and φ the angle at which the string
    leaves the wheel; the sign is + if the wheel turns counter-clockwise to unwind the string. φ is
    continuous from one look to the next, over any number of turns. The gradient is the direction of
    the free string.
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

    def evaluate(self, pose: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return the length, free and wound, and its gradient.

        Raises `JointFailure` if the end of the string is inside the wheel.
        """
        body = number(self.end)
        arm = self.end.point * exp(1j * pose.angle[body])
        apart = complex(pose.position[body] + arm - pose.position[self.wheel])
        square = abs(apart) ** 2 - self.radius**2
        if square <= 0:
            raise JointFailure(
                self.joint, Message("the end of '{joint}' has run into its wheel", joint=self.joint)
            )
        free = sqrt(square)
        contact = phase(apart) - self.sense * atan2(free, self.radius)
        self._contact = contact + tau * float(np.rint((self._contact - contact) / tau))
        wound = self.radius * self.sense * (self._contact - float(pose.angle[self.wheel]))
        along = exp(1j * (contact + self.sense * pi / 2))
        return free + wound, (
            Share(body, along, (along.conjugate() * 1j * arm).real),
            Share(self.wheel, -along, -self.sense * self.radius),
        )


Gearing = TypeVar("Gearing", AngleEquation, RackEquation)


def pin(name: str, a: Anchor, b: Anchor) -> list[Row]:
    """Return the equations that keep two points together."""
    return [Row(name, [(a, b)], 0.0, along=direction) for direction in (1 + 0j, 1j)]


def where(a: Anchor, b: Anchor, start: Coordinates) -> complex:
    """Return the position of the point b in the axes of the body of a [m]."""
    first, second = number(a), number(b)
    point = start.position[second] + b.point * exp(1j * start.angle[second])
    return complex((point - start.position[first]) * exp(-1j * start.angle[first]))


def starting(equation: Gearing, start: Coordinates) -> Gearing:
    """Return the equation that keeps the value at the start."""
    return replace(equation, length=equation.evaluate(start)[0])


def angle_stops(name: str, a: Anchor, b: Anchor, least: float, most: float) -> list[AngleEquation]:
    """Return the equations that keep the angle of b relative to a between two bounds [rad]."""
    bodies = number(a), number(b)
    return [
        AngleEquation(name, *bodies, sense * limit, pulls_only=True, sense=sense)
        for sense, limit in ((1, most), (-1, least))
    ]


def stops(name: str, a: Anchor, b: Anchor, way: complex, limits: tuple[float, float]) -> list[Row]:
    """Return the equations that keep the distance of a from b along a direction in bounds [m]."""
    along, (least, most) = way / abs(way), limits
    return [
        Row(name, [(b, a)], most, pulls_only=True, along=along),
        Row(name, [(a, b)], -least, pulls_only=True, along=along),
    ]


def turn(
    name: str,
    a: Anchor,
    b: Anchor,
    start: Coordinates,
    changing: Change | None = None,
) -> AngleEquation:
    """Return the equation that keeps the angle of b relative to a, plus a given change in time."""
    first, second = number(a), number(b)
    angle = float(start.angle[second] - start.angle[first])
    return AngleEquation(name, first, second, angle, changing)


def winding(
    name: str, end: Anchor, wheel: Anchor, radius: float, sense: int, start: Coordinates
) -> WindingEquation:
    """Return the equation that keeps the length of a wound string at the start."""
    assert wheel.body is not None
    wound = WindingEquation(name, end, wheel.body, radius, sense)
    wound.length = wound.evaluate(start)[0]
    return wound


def number(anchor: Anchor) -> int:
    """Return the index of an anchor's body."""
    return PLANE if anchor.body is None else anchor.body
