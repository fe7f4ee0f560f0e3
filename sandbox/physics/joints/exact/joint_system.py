"""The system of all exact joints of a scene, in the coordinates of its bodies."""

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Batch, Booleans
from sandbox.physics.joints.exact.banded_systems import FEWEST, Banded
from sandbox.physics.joints.exact.constraint_interface import (
    Coordinates,
    Equation,
    Rows,
    coordinate_indices,
    inertia_of,
    translations,
)
from sandbox.physics.joints.exact.distance_equations import Reaches, Row
from sandbox.physics.joints.exact.equation_tables import Equations


class KeptLengths(NamedTuple):
    """The values that joints keep at the start and at the end of a drift: (m,) [m, rad]."""

    before: Array
    after: Array
    t: float  # s, at its start


class JointSystem:
    """All exact joints of a scene; n bodies, m equations C(q) = 0 over q = (x, y, θ).

    Sums of lengths, the rows, are evaluated together; the other equations one by one. Points of the
    plane and all positions in the equations are relative to the `origin` [m]. `inverse_mass` and
    `inverse_moment`, (n,), are 0 of bodies that do not move or turn [1/kg, 1/(kg m²)].

    `inverse`, (3 N,), has the inverse mass or moment of inertia of each coordinate, the plane last.
    `equations` holds the tables of all equations, and `length`, (m,), the values to keep, without
    changes in time [m, rad]. `bodies` are those of each equation; the plane is the last of all, or
    −1. `alike`, (m,), is the first equation of the same joint, since a pin has two, one along each
    axis; for an equation that keeps an angle, it is the equation itself.
    """

    def __init__(
        self,
        rows: Sequence[Row],
        others: Sequence[Equation],
        batch: Batch,
        inverse_mass: Array,
        inverse_moment: Array,
        origin: complex = 0j,
    ) -> None:
        self.batch, self.origin = batch, origin
        # one more body: the plane itself, which nothing moves
        self._inverse_moment = np.append(inverse_moment, 0.0)
        self.coordinate_indices = coordinate_indices(len(inverse_mass))
        self.set_inverse(np.column_stack((inverse_mass, inverse_mass, inverse_moment)))
        start = 3 * len(self._inverse_moment)
        self._of_state = np.concatenate(
            (self.coordinate_indices, self.coordinate_indices + start), axis=1
        ).ravel()
        self.length = np.array([equation.length for equation in (*rows, *others)])
        self._lay_out(rows, others)

    def set_inverse(self, inverse: Array) -> None:
        """Set the inverse masses, twice, and moments of the bodies: (n, 3) [1/kg, 1/(kg m²)].

        Those in the equations of joints stay: exact joints hold no bodies of changing mass.
        """
        self.inverse = np.zeros(inverse.size + 3)
        self.inverse[self.coordinate_indices] = inverse
        self._inertia = inertia_of(self.inverse)
        self._mass = float(self._inertia.sum())  # with moments: the scale of rounding errors

    def _lay_out(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Make the tables of all equations."""
        self.equations = equations = Equations(rows, others, self._inverse_moment)
        self._joints, self.alike = equations.names, equations.alike
        self._pulls_only = equations.pulls_only
        self._unilateral = bool(self._pulls_only.any())
        self.__dict__.pop("band", None)  # the band of the previous equations
        self._last: tuple[bytes, Rows] | None = None  # positions and rows of the last wrenches
        self.bodies = equations.bodies(self.pose())

    @cached_property
    def band(self) -> Banded | None:
        """The equations as a band, if there are many and each is coupled to only a few."""
        count = len(self._joints)
        if count < FEWEST or self.equations.others or self._unilateral:
            return None
        band = Banded(self.reaches, count, self.inverse)
        return band if band.is_cheaper else None

    @property
    def reaches(self) -> Reaches:
        """The segments whose lengths are added."""
        return self.equations.reaches

    @property
    def names(self) -> Sequence[str]:
        """The joint of each equation: (m,)."""
        return self._joints

    @property
    def pulls_only(self) -> Booleans:
        """The rows that can only pull: (m,)."""
        return self._pulls_only

    @property
    def changes(self) -> Booleans:
        """The rows whose lengths change with time: (m,)."""
        return self.equations.changes

    def pose(self) -> Coordinates:
        """Return the present positions."""
        return self.coordinates()[0]

    def at(self, pose: Array) -> Coordinates:
        """Return positions, (n, 3), as coordinates relative to the origin."""
        found = coordinates_of(pose)
        found.position[:-1] -= self.origin
        return found

    def coordinates(self) -> tuple[Coordinates, Coordinates]:
        """Return the present positions and velocities, the plane itself last."""
        values = np.zeros((2, len(self.inverse)))
        values.reshape(-1)[self._of_state] = self.batch.state().reshape(-1)
        if self.origin:
            translations(values[0])[:-1] -= self.origin
        return Coordinates(values[0]), Coordinates(values[1])

    def evaluate(self, pose: Coordinates) -> Rows:
        """Return the values of the rows at given positions, and their Jacobian."""
        return self.equations.evaluate(pose)

    def lengths(self, t: float) -> Array:
        """Return the values to keep at a time [s]: (m,) [m, rad]."""
        return self.equations.lengths(self.length, t)

    def kept_lengths(self, start: float, end: float) -> KeptLengths:
        """Return the values to keep at both ends of a drift, given by their times [s]."""
        return KeptLengths(self.lengths(start), self.lengths(end), start)

    def jacobian(self, pose: Array | None = None) -> Array:
        """Return the derivatives of the rows by the bodies' positions and angles: (m, n, 3).

        They are taken at the given positions (n, 3), or the present ones. The run does not change.
        """
        here = self.equations.evaluate_without_memory(
            self.pose() if pose is None else self.at(pose)
        )
        return here.jacobian[:, self.coordinate_indices]

    def two_sided_jacobian(self, pose: Array | None = None) -> Array:
        """Return the rows of `jacobian` that can push as well as pull: (m, n, 3)."""
        return self.jacobian(pose)[~self._pulls_only]

    def wrenches(self, tension: Array, pose: Coordinates) -> Array:
        """Return the forces and torques on bodies of forces along rows (m,): (n, 3) [N, N m]."""
        return -(tension @ self._evaluated(pose).jacobian)[self.coordinate_indices]

    def _evaluated(self, pose: Coordinates) -> Rows:
        """Return the result of `evaluate`, from memory if the positions are the last ones."""
        if self.equations.others:  # each look changes their state
            return self.evaluate(pose)
        where = pose.values.tobytes()
        if self._last is None or self._last[0] != where:
            self._last = where, self.evaluate(pose)
        return self._last[1]

    def kinetic_energy(self, motion: Array) -> float:
        """Return the kinetic energy of velocities (3 N,) [J]."""
        return float((motion * motion).dot(self._inertia)) / 2

    def largest_residual(self) -> tuple[str, float]:
        """Return the joint with the largest residual, and that residual [m, rad]."""
        pose, _ = self.coordinates()
        residuals = self.equations.evaluate_without_memory(pose).total - self.length
        residuals = np.where(self._pulls_only, np.maximum(residuals, 0.0), np.abs(residuals))
        residuals[self.changes] = 0.0  # the values to keep now are not known here
        if not len(residuals):
            return "", 0.0
        worst = int(residuals.argmax())
        return self._joints[worst], float(residuals[worst])

    def is_driven(self, motion: Array) -> bool:
        """Return whether lengths change, or velocities (3 N,) move a kinematic body."""
        return bool(self.equations.changing) or bool(motion[self.inverse == 0].any())


def coordinates_of(rows: Array) -> Coordinates:
    """Return positions or velocities (n, 3) as coordinates, the plane itself last."""
    values = np.zeros(3 * len(rows) + 3)
    values[coordinate_indices(len(rows))] = rows
    return Coordinates(values)
