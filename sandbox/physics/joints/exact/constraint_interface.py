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
from sandbox.physics.state.joint_anchors import Complexes

MAX_ITERATIONS = 25
QUADRATIC = 1e-8
"""m, the residual below which one more Newton step leaves only rounding."""

GROWS = 1.1
"""The largest kinetic energy after a kick with joints, over that without them. Joints do no work,
except by the errors of long steps. Measured ratios are up to 1.06 for errors of second order, and
4 and more where Newton's method found another solution."""

POSITION_ROUNDING = 4e-16
"""The relative rounding error of positions, where velocities are computed from them."""


@dataclass(slots=True)  # not frozen: some are made in every step
class Coordinates:
    """Positions or velocities of all N bodies, the plane itself last."""

    values: Array
    """(3 N,), x and y of each body, then the angle of each."""
    _position: Complexes | None = field(default=None, init=False, repr=False, compare=False)
    _rotation: Complexes | None = field(default=None, init=False, repr=False, compare=False)

    @classmethod
    def of(cls, position: Complexes, angle: Array) -> "Coordinates":
        """Return the coordinates from complex positions and angles: (N,) each."""
        return cls(np.concatenate((position.view(float), angle)))

    @property
    def position(self) -> Complexes:
        """The complex positions, a view of the values: (N,)."""
        if self._position is None:
            self._position = translations(self.values)
        return self._position

    @property
    def angle(self) -> Array:
        """The angles, a view of the values: (N,)."""
        return angles(self.values)

    @property
    def rotation(self) -> Complexes:
        """The rotations of the bodies, exp(iθ), computed once: (N,)."""
        if self._rotation is None:
            self._rotation = np.exp(1j * angles(self.values))
        return self._rotation


class Rows(NamedTuple):
    """The values of rows (m,), and their Jacobian in the coordinates (m, 3 N)."""

    total: Array
    jacobian: Array


def translations(values: Array) -> Complexes:
    """Return the part of coordinates or of a Jacobian for the positions, complex: (..., N)."""
    return values[..., : values.shape[-1] // 3 * 2].view(complex)


def angles(values: Array) -> Array:
    """Return the part of coordinates or of a Jacobian for the angles: (..., N)."""
    return values[..., values.shape[-1] // 3 * 2 :]


def inertia_of(inverse: Array) -> Array:
    """Return the mass or moment of each coordinate from its inverse, 0 if it cannot move."""
    moves = inverse > 0
    return np.where(moves, 1 / np.where(moves, inverse, 1.0), 0.0)


def kinetic_energy(inertia: Array, motion: Array) -> Array:
    """Return T = q̇ᵀ M q̇ / 2 from the inertia M and velocities q̇, both (..., 3 N): (...) [J]."""
    return np.asarray(np.vecdot(motion * motion, inertia) / 2)


def blur(pose: Array, drift: float) -> float:
    """Return the rounding error of velocities that follow from positions after a drift [m/s]."""
    sizes = np.abs(pose)
    return POSITION_ROUNDING * sizes.item(sizes.argmax()) / abs(drift)


@cache
def coordinate_indices(count: int) -> NDArray[np.intp]:
    """Return the indices of the coordinates of each body, without the plane: (n, 3)."""
    body = np.arange(count)
    indices = np.stack((2 * body, 2 * body + 1, 2 * (count + 1) + body), axis=1)
    indices.setflags(write=False)
    return indices


class Share(NamedTuple):
    """The derivatives of an equation by one body's position and angle."""

    body: int
    """the index of the body; −1 is the plane itself"""
    plane: complex
    angle: float


class Change(NamedTuple):
    """A change of a value to keep, as functions of time [s]."""

    by: Callable[[float], float]  # m, rad
    rate: Callable[[float], float]  # m/s, rad/s


class Condition(Protocol):
    """A constraint C(q) = `length`, where C is a length, a multiple of one, or an angle."""

    @property
    def joint(self) -> str:
        """The name of its joint."""
        ...

    @property
    def length(self) -> float:
        """The value to keep."""
        ...

    @property
    def changing(self) -> Change | None:
        """The change of that value in time; None if it is constant."""
        ...

    @property
    def pulls_only(self) -> bool:
        """Whether the value is an upper bound, like the length of a rope."""
        ...


class Equation(Condition, Protocol):
    """A condition that computes its own value and gradient."""

    def evaluate(self, pose: Coordinates) -> tuple[float, Sequence[Share]]:
        """Return the value at given positions, and its gradient."""
        ...
