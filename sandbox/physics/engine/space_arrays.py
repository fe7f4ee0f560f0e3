"""All bodies and contacts of a space, read and written as arrays.

pymunk has its own order, with a row more for its static body: rows are mapped by ids of bodies. The
arrays are made once. No body may be added to the space once there is a `Batch` for it.
"""

from collections.abc import Sequence
from math import sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk.batch import BodyFields, Buffer, get_space_bodies

from sandbox.model.expressions import Array
from sandbox.physics.engine.private_handles import Table

if TYPE_CHECKING:
    from sandbox.physics.engine.arbiters import Arbiters
    from sandbox.physics.engine.pairs_of_bodies import Pair

_VELOCITY = BodyFields.VELOCITY | BodyFields.ANGULAR_VELOCITY
_FORCE = BodyFields.FORCE | BodyFields.TORQUE
_STATE = BodyFields.POSITION | BodyFields.ANGLE | _VELOCITY

Integers = NDArray[np.intp]
Booleans = NDArray[np.bool_]


class Contacts(NamedTuple):
    """The pairs of bodies in contact in the last step; k pairs, in the order of the bodies."""

    bodies: Integers
    """(k, 2), the bodies' indices."""
    first: Booleans
    """(k,), whether the pair did not touch in the step before."""
    direction: Array
    """(k, 2), the unit normal, from the first body to the second."""
    normal: Array
    friction: Array
    """(k,), the sizes of the normal and the tangential impulse [N s]."""
    touches: Integers
    """(k,), the number of contact points, one or two."""
    points: Array
    """(k, 2, 2), the contact points; the second has no meaning if there is only one [m]."""
    impulse: Array
    """(k, 2), the impulse on the second body; that on the first is opposite [N s]."""
    depths: Array
    """(k, 2), the overlaps at the contact points [m]."""

    @property
    def depth(self) -> Array:
        """The larger overlap of each pair: (k,) [m]."""
        first: Array = self.depths[:, 0]
        two = self.touches > 1
        return np.where(two, np.maximum(first, self.depths[:, 1]), first) if two.any() else first

    def followed_by(self, others: "Contacts") -> "Contacts":
        """Return these contacts, followed by others."""
        if not len(self.bodies):
            return others
        return Contacts._make(map(np.concatenate, zip(self, others, strict=True)))

    def on_surfaces(self, points: Array) -> Array:
        """Return contact points, (k, 2), moved to the surfaces of the two bodies: (k, 2, 2) [m].

        The bodies overlap, and friction acts on each at its own surface.
        """
        overlap = self.direction * (self.depth / 2)[:, None]
        return points[:, None] + np.stack((overlap, -overlap), axis=1)

    def scaled(self, factor: float) -> "Contacts":
        """Return the contacts with their impulses multiplied by a factor."""
        return self._replace(
            normal=self.normal * factor,
            friction=self.friction * factor,
            impulse=self.impulse * factor,
        )

    def in_order(self) -> "Contacts":
        """Return the contacts in an order that depends on their values alone.

        pymunk's order depends on memory addresses, and the rounding of sums on the order.
        """
        x, y = self.points[:, 0].T
        keys = (x, y, self.friction, self.normal, self.bodies[:, 1], self.bodies[:, 0])
        order = np.lexsort(keys)
        return Contacts._make(field[order] for field in self)

    def without_first(self, count: int) -> "Contacts":
        """Return the contacts after the first `count`."""
        return Contacts._make(field[count:] for field in self) if count else self


NO_CONTACTS = Contacts(
    np.empty((0, 2), dtype=np.intp),
    np.empty(0, dtype=bool),
    np.empty((0, 2)),
    np.empty(0),
    np.empty(0),
    np.empty(0, dtype=np.intp),
    np.empty((0, 2, 2)),
    np.empty((0, 2)),
    np.empty((0, 2)),
)


def in_place(rows: Integers) -> slice | Integers:
    """Return rows as a slice if they are consecutive, since slices are views, not copies."""
    first = int(rows[0]) if len(rows) else 0
    follow = np.array_equal(rows, np.arange(first, first + len(rows)))
    return slice(first, first + len(rows)) if follow else rows


class Batch:
    """Reads and writes the n bodies of a space, in the order given."""

    def __init__(self, space: pymunk.Space, bodies: Sequence[pymunk.Body]) -> None:
        self._space, self._bodies = space, bodies
        _ = space.static_body  # pymunk gives it an id only when it is first accessed
        buffer = Buffer()
        get_space_bodies(space, BodyFields.BODY_ID, buffer)
        ids = np.frombuffer(buffer.int_buf(), dtype=np.uintp).tolist()
        rows = {body_id: row for row, body_id in enumerate(ids)}
        ids_given = np.array([body.id for body in bodies], dtype=np.uintp)
        self._order = np.argsort(ids_given)
        self._ids = ids_given[self._order]
        self._rows = np.array([rows[body.id] for body in bodies], dtype=np.intp)
        self._slots = in_place(self._rows)
        self._state = Table(space, _STATE, len(ids), 6)
        self._velocity = Table(space, _VELOCITY, len(ids), 3)
        self._force = Table(space, _FORCE, len(ids), 3)
        self._arbiters: Arbiters | None = None
        self.solved_by_pymunk = True  # or its impulses at contacts mean nothing, and are 0 here
        self._last_contacts = NO_CONTACTS

    def pair(self, a: int | None, b: int | None) -> "Pair":
        """Return access to two bodies only; None is the plane itself."""
        from sandbox.physics.engine.pairs_of_bodies import pair_of

        one, other = (self._space.static_body if i is None else self._bodies[i] for i in (a, b))
        return pair_of(one, other)

    def state(self) -> Array:
        """Return x, y, angle, vx, vy, angular velocity: (n, 6) [m, rad, m/s, rad/s]."""
        return self._state.read().take(self._rows, axis=0)

    def velocity(self) -> Array:
        """Return vx, vy, angular velocity: (n, 3) [m/s, rad/s]."""
        return self._velocity.read().take(self._rows, axis=0)

    def extent(self) -> float:
        """Return an upper bound of all coordinates and velocities [m, rad, m/s, rad/s]."""
        values = self._state.read().ravel()
        return sqrt(np.vdot(values, values))

    def set_velocity(self, velocity: Array) -> None:
        """Write vx, vy, angular velocity: (n, 3) [m/s, rad/s]."""
        self._write(self._velocity, velocity)

    def set_state(self, state: Array) -> None:
        """Write x, y, angle, vx, vy, angular velocity: (n, 6) [m, rad, m/s, rad/s]."""
        self._write(self._state, state)

    def set_force(self, force: Array) -> None:
        """Write the forces and torques of the next kick: (n, 3) [N, N m]."""
        self._write(self._force, force)

    def _write(self, table: Table, values: Array) -> None:
        table.values[self._slots] = values
        table.write()

    def contacts(self) -> Contacts:
        """Return the contacts, with the impulses of the last step; not to be written to."""
        arbiters = self._arbiters = self._arbiters or self._make_arbiters()
        if arbiters.has_changed():  # there are several calls in a step
            fields, pairs = arbiters.read(), arbiters.pairs
            found = Contacts._make(fields) if fields else NO_CONTACTS
            self._last_contacts = found if pairs and pairs.is_unique else found.in_order()
        return self._last_contacts

    def _make_arbiters(self) -> "Arbiters":
        """Return the reader of contacts, which is imported only when needed."""
        from sandbox.physics.engine.arbiters import Arbiters

        return Arbiters(self._space, self._ids, self._order, has_impulses=self.solved_by_pymunk)
