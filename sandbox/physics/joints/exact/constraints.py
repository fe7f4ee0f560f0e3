"""The constraints of exact joints: equations between the coordinates of bodies.

The plane is complex here: a point is x + iy, and dC = Re(conj(J) dz) + K dθ.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.state.anchor import Plane

MAX_ITERATIONS = 25
QUADRATIC = 1e-8
"""m, below which one more of Newton's steps leaves nothing but rounding."""

GROWS = 1.1
"""How many times its kinetic energy a kick may leave with joints, of what it would leave without
them: they give none but for what a step is too long for. Seen are 1.06 where errors are of second
order, and 4 and more where Newton's method has come to another solution."""

PLACES = 4e-16
"""How well places are known, of themselves, where velocities are chosen by them."""


@dataclass(slots=True)  # not frozen: some are made in every step
class Coordinates:
    """Places or velocities of all N bodies, the plane itself last.

    Attributes
    ----------
    values
        (3 N,), x and y of each body, then the angle of each.
    """

    values: Array
    _plane: Plane | None = field(default=None, init=False, repr=False, compare=False)
    _turned: Plane | None = field(default=None, init=False, repr=False, compare=False)

    @classmethod
    def of(cls, plane: Plane, angle: Array) -> "Coordinates":
        """Return those of bodies in the plane and in the angle: (N,) each."""
        return cls(np.concatenate((plane.view(float), angle)))

    @property
    def plane(self) -> Plane:
        """In the plane, of the values themselves: (N,)."""
        if self._plane is None:
            self._plane = planes(self.values)
        return self._plane

    @property
    def angle(self) -> Array:
        """In the angle: (N,)."""
        return angles(self.values)

    @property
    def turned(self) -> Plane:
        """How far bodies are turned, as unit numbers, computed once: (N,)."""
        if self._turned is None:
            self._turned = np.exp(1j * angles(self.values))
        return self._turned


class Rows(NamedTuple):
    """What rows add up to (m,), and their Jacobian in the coordinates (m, 3 N)."""

    total: Array
    jacobian: Array


def planes(values: Array) -> Plane:
    """Return what of coordinates, or of a Jacobian in them, is in the plane: (..., N)."""
    return values[..., : values.shape[-1] // 3 * 2].view(complex)


def angles(values: Array) -> Array:
    """Return what of coordinates, or of a Jacobian in them, is in the angle: (..., N)."""
    return values[..., values.shape[-1] // 3 * 2 :]


def inertia_of(inverse: Array) -> Array:
    """Return mass or moment of each coordinate from one over it, 0 of what nothing moves."""
    moves = inverse > 0
    return np.where(moves, 1 / np.where(moves, inverse, 1.0), 0.0)


def kinetic_energy(inertia: Array, motion: Array) -> Array:
    """Return T = q̇ᵀ M q̇ / 2 of velocities in the coordinates, both (..., 3 N): (...) [J]."""
    return np.asarray(np.vecdot(motion * motion, inertia) / 2)


@cache
def order(count: int) -> NDArray[np.intp]:
    """Return where the coordinates of bodies stand, body by body, without the plane: (n, 3)."""
    body = np.arange(count)
    places = np.stack((2 * body, 2 * body + 1, 2 * (count + 1) + body), axis=1)
    places.setflags(write=False)
    return places


class Share(NamedTuple):
    """How an equation changes with one body's place and angle."""

    body: int
    """its number; −1 is the plane itself"""
    plane: complex
    angle: float


class Condition(Protocol):
    """Something that keeps a value, C(q) = `length`; its unit is a length, or a multiple of one."""

    @property
    def joint(self) -> str:
        """The name of the joint it belongs to."""
        ...

    @property
    def length(self) -> float:
        """The value that it keeps."""
        ...

    @property
    def changing(self) -> Callable[[float], float] | None:
        """What is to be added to that value at a time; None if it stays."""
        ...

    @property
    def pulls_only(self) -> bool:
        """Whether the value may also be smaller, as the length of a rope."""
        ...


class Equation(Condition, Protocol):
    """A condition that knows its own value and jacobian."""

    def look(self, place: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return the value somewhere, and its gradient there."""
        ...
