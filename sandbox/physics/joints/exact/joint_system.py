"""The system of all exact joints of a scene, over the coordinates of its bodies."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Batch, Booleans
from sandbox.physics.joints.exact.banded import FEWEST, Banded
from sandbox.physics.joints.exact.constraints import (
    Coordinates,
    Equation,
    Rows,
    inertia_of,
    kinetic_energy,
    order,
    planes,
)
from sandbox.physics.joints.exact.distances import Reaches, Row
from sandbox.physics.joints.exact.equations import Equations


class JointSystem:
    """All exact joints of a scene; n bodies, m equations C(q) = 0 over q = (x, y, θ).

    Sums of lengths, the rows, are looked at together; the other equations one by one.

    Parameters
    ----------
    rows, others
        The equations, whose points of the plane are counted from the origin.
    batch
        Reads and writes the bodies.
    inverse_mass, inverse_moment
        (n,), 0 of what nothing moves or turns [1/kg, 1/(kg m²)].
    origin
        From where places are counted [m].

    Attributes
    ----------
    inverse
        (3 N,), one over the mass or moment of each coordinate, the plane's last.
    equations
        The tables of all equations.
    length
        (m,), what each keeps, but for what changes with time [m, rad].
    bodies
        Those that each equation is about; the plane is the last of all, or −1.
    origin
        From where places are counted [m].
    alike
        (m,), the first of the equations of its joint, or of those of them that keep an angle: each
        its own. What a pin keeps it keeps along two axes.
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
        # one body more: the plane itself, which nothing moves
        self._inverse_moment = np.append(inverse_moment, 0.0)
        self.inverse = np.concatenate(
            (np.repeat(inverse_mass, 2), (0.0, 0.0), self._inverse_moment)
        )
        self._inertia = inertia_of(self.inverse)
        self._mass = float(self._inertia.sum())  # and moments: for what is rounding
        self.order = order(len(inverse_mass))
        start = 3 * len(self._inverse_moment)
        self._of_state = np.concatenate((self.order, self.order + start), axis=1).ravel()
        self.length = np.array([equation.length for equation in (*rows, *others)])
        self._lay_out(rows, others)

    def _lay_out(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Make the tables of all equations."""
        self.equations = equations = Equations(rows, others, self._inverse_moment)
        self._joints, self.alike = equations.names, equations.alike
        self._pulls_only = equations.pulls_only
        self._unilateral = bool(self._pulls_only.any())
        self.__dict__.pop("band", None)  # it was that of the equations before
        self._last: tuple[bytes, Rows] | None = None  # the last look for wrenches, and where
        self.bodies = equations.bodies(self.place())

    @cached_property
    def band(self) -> Banded | None:
        """The equations as a band, where there are many and each meets but a few."""
        count = len(self._joints)
        if count < FEWEST or self.equations.others or self._unilateral:
            return None
        band = Banded(self.reaches, count, self.inverse)
        return band if band.pays else None

    @property
    def reaches(self) -> Reaches:
        """The pieces whose lengths add up."""
        return self.equations.reaches

    @property
    def names(self) -> Sequence[str]:
        """The joint that each equation is of: (m,)."""
        return self._joints

    @property
    def pulls_only(self) -> Booleans:
        """Which rows can only pull: (m,)."""
        return self._pulls_only

    @property
    def changes(self) -> Booleans:
        """Which rows are of a length that changes with time: (m,)."""
        return self.equations.changes

    def place(self) -> Coordinates:
        """Return where everything is."""
        return self.coordinates()[0]

    def at(self, place: Array) -> Coordinates:
        """Return a place, (n, 3), as the equations have it: counted from the origin."""
        found = coordinates_of(place)
        found.plane[:-1] -= self.origin
        return found

    def coordinates(self) -> tuple[Coordinates, Coordinates]:
        """Return where everything is and how it moves, the plane itself last."""
        values = np.zeros((2, len(self.inverse)))
        values.reshape(-1)[self._of_state] = self.batch.state().reshape(-1)
        if self.origin:
            planes(values[0])[:-1] -= self.origin
        return Coordinates(values[0]), Coordinates(values[1])

    def look(self, place: Coordinates) -> Rows:
        """Return what the rows add up to somewhere, and their Jacobian there."""
        return self.equations.look(place)

    def lengths(self, t: float) -> Array:
        """Return what each equation keeps at a time [s]: (m,) [m, rad]."""
        return self.equations.lengths(self.length, t)

    def jacobian(self, place: Array | None = None) -> Array:
        """Return how the rows change with the places and angles of the bodies: (m, n, 3).

        Where they are, or if they were at a place: (n, 3). Whoever asks leaves the run as it is.
        """
        here = self.equations.glance(self.place() if place is None else self.at(place))
        return here.jacobian[:, self.order]

    def stiff(self, place: Array | None = None) -> Array:
        """Return the Jacobian of what can push as well as pull, as below: (m, n, 3)."""
        return self.jacobian(place)[~self._pulls_only]

    def wrenches(self, tension: Array, place: Coordinates) -> Array:
        """Return what forces along the rows (m,) are to the bodies somewhere: (n, 3) [N, N m]."""
        return -(tension @ self._looked(place).jacobian)[self.order]

    def _looked(self, place: Coordinates) -> Rows:
        """Return what `look` does; where it was asked for last, no look is needed."""
        if self.equations.others:  # they take note of each look
            return self.look(place)
        where = place.values.tobytes()
        if self._last is None or self._last[0] != where:
            self._last = where, self.look(place)
        return self._last[1]

    def kinetic(self, motion: Array) -> float:
        """Return the kinetic energy of velocities (3 N,) [J]."""
        return float(kinetic_energy(self._inertia, motion))

    def parting(self) -> tuple[str, float]:
        """Return the joint that is furthest from what it keeps, and by how much [m, rad]."""
        place, _ = self.coordinates()
        off = self.equations.glance(place).total - self.length
        off = np.where(self._pulls_only, np.maximum(off, 0.0), np.abs(off))
        off[self.changes] = 0.0  # what they keep now is not known any more
        if not len(off):
            return "", 0.0
        worst = int(off.argmax())
        return self._joints[worst], float(off[worst])

    def is_driven(self, motion: Array) -> bool:
        """Whether lengths change, or a kinematic body moves by velocities: (3 N,)."""
        return bool(self.equations.changing) or bool(motion[self.inverse == 0].any())


def coordinates_of(rows: Array) -> Coordinates:
    """Return places or velocities (n, 3) as equations have them, the plane itself last."""
    values = np.zeros(3 * len(rows) + 3)
    values[order(len(rows))] = rows
    return Coordinates(values)
