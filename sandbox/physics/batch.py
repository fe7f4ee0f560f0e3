"""All bodies and contacts of a space, read and written as arrays.

pymunk keeps the rows in an order of its own, with one more for its static body, so rows are mapped
by the bodies' ids. The arrays are handed to pymunk once and reused: nothing is allocated in a step,
and no body may join the space once a `Batch` looks at it.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk.batch import (
    ArbiterFields,
    BodyFields,
    Buffer,
    get_space_arbiters,
    get_space_bodies,
    set_space_bodies,
)

from sandbox.model.expressions import Array

_VELOCITY = BodyFields.VELOCITY | BodyFields.ANGULAR_VELOCITY
_FORCE = BodyFields.FORCE | BodyFields.TORQUE
_STATE = BodyFields.POSITION | BodyFields.ANGLE | _VELOCITY
_CONTACT_INTEGERS = (
    ArbiterFields.BODY_A_ID
    | ArbiterFields.BODY_B_ID
    | ArbiterFields.IS_FIRST_CONTACT
    | ArbiterFields.CONTACT_COUNT
)
_CONTACT_FIELDS = (
    _CONTACT_INTEGERS
    | ArbiterFields.TOTAL_IMPULSE
    | ArbiterFields.NORMAL
    | ArbiterFields.POINT_A_1
    | ArbiterFields.POINT_B_1
    | ArbiterFields.POINT_A_2
    | ArbiterFields.POINT_B_2
)

Integers = NDArray[np.intp]
Booleans = NDArray[np.bool_]


class Contacts(NamedTuple):
    """The pairs of bodies in contact in the last step; k pairs, in the order of the bodies.

    Attributes
    ----------
    bodies
        (k, 2), the bodies' indices.
    first
        (k,), whether the pair did not touch in the step before.
    direction
        (k, 2), the unit normal, from the first body to the second.
    normal, friction
        (k,), the size of the impulse along the normal and across it [N s].
    touches
        (k,), at how many points they touch, one or two.
    points
        (k, 2, 2), where those are; the second is nowhere if there is but one [m].
    impulse
        (k, 2), on the second body; the first got the opposite [N s].
    depth
        (k,), by how much they overlap [m].
    """

    bodies: Integers
    first: Booleans
    direction: Array
    normal: Array
    friction: Array
    touches: Integers
    points: Array
    impulse: Array
    depth: Array

    def and_(self, others: "Contacts") -> "Contacts":
        """Return these contacts and others."""
        if not len(self.bodies):
            return others
        return Contacts._make(np.concatenate(both) for both in zip(self, others, strict=True))


NO_CONTACTS = Contacts(
    np.empty((0, 2), dtype=np.intp),
    np.empty(0, dtype=bool),
    np.empty((0, 2)),
    np.empty(0),
    np.empty(0),
    np.empty(0, dtype=np.intp),
    np.empty((0, 2, 2)),
    np.empty((0, 2)),
    np.empty(0),
)


class Batch:
    """Reads and writes the bodies of a space in the order they are given; n bodies."""

    def __init__(self, space: pymunk.Space, bodies: Sequence[pymunk.Body]) -> None:
        self._space = space
        _ = space.static_body  # pymunk gives it an id only once somebody has asked for it
        buffer = Buffer()
        get_space_bodies(space, BodyFields.BODY_ID, buffer)
        ids = np.frombuffer(buffer.int_buf(), dtype=np.uintp).tolist()
        rows = {body_id: row for row, body_id in enumerate(ids)}
        known = np.array([body.id for body in bodies], dtype=np.uintp)
        self._order = np.argsort(known)
        self._ids = known[self._order]
        self._rows = np.array([rows[body.id] for body in bodies], dtype=np.intp)
        self._state, self._state_buffer = _table(len(ids), 6)
        self._velocity, self._velocity_buffer = _table(len(ids), 3)
        self._force, self._force_buffer = _table(len(ids), 3)
        self._contacts = Buffer()

    def state(self) -> Array:
        """Return x, y, angle, vx, vy, angular velocity: (n, 6) [m, rad, m/s, rad/s]."""
        self._state_buffer.clear()
        get_space_bodies(self._space, _STATE, self._state_buffer)
        return self._state[self._rows]

    def velocity(self) -> Array:
        """Return vx, vy, angular velocity: (n, 3) [m/s, rad/s]."""
        self._velocity_buffer.clear()
        get_space_bodies(self._space, _VELOCITY, self._velocity_buffer)
        return self._velocity[self._rows]

    def set_velocity(self, velocity: Array) -> None:
        """Write vx, vy, angular velocity: (n, 3) [m/s, rad/s]."""
        self._velocity[self._rows] = velocity
        set_space_bodies(self._space, _VELOCITY, self._velocity_buffer)

    def set_state(self, state: Array) -> None:
        """Write x, y, angle, vx, vy, angular velocity: (n, 6) [m, rad, m/s, rad/s]."""
        self._state[self._rows] = state
        set_space_bodies(self._space, _STATE, self._state_buffer)

    def set_force(self, force: Array) -> None:
        """Write force and torque that act in the next kick: (n, 3) [N, N m]."""
        self._force[self._rows] = force
        set_space_bodies(self._space, _FORCE, self._force_buffer)

    def contacts(self) -> Contacts:
        """Return who is in contact, with the impulses of the last step."""
        self._contacts.clear()
        get_space_arbiters(self._space, _CONTACT_FIELDS, self._contacts)
        integers = np.frombuffer(self._contacts.int_buf(), dtype=np.uintp).reshape(-1, 4)
        if not len(integers):
            return NO_CONTACTS
        floats = np.frombuffer(self._contacts.float_buf()).reshape(-1, 12)
        live = integers[:, 3] > 0  # pymunk remembers pairs for some steps after they part
        bodies = self._order[np.searchsorted(self._ids, integers[live, :2])]
        impulse, direction = floats[live, :2], floats[live, 2:4]
        on_surfaces = floats[live, 4:].reshape(-1, 2, 2, 2)
        overlap = on_surfaces[:, :, 0] - on_surfaces[:, :, 1]
        depth = np.einsum("kpc,kc->kp", overlap, direction)
        depth = np.where(integers[live, 3] > 1, depth.max(axis=1), depth[:, 0])
        points = (on_surfaces[:, :, 0] + on_surfaces[:, :, 1]) / 2
        along = np.sum(impulse * direction, axis=1)
        impulse = impulse * np.where(along < 0, -1.0, 1.0)[:, None]  # it pushes the second body
        normal = np.abs(along)
        friction = np.abs(impulse[:, 0] * direction[:, 1] - impulse[:, 1] * direction[:, 0])
        # pymunk's order depends on where its objects lie in memory, and sums on the order
        keys = (*points[:, 0].T, friction, normal, bodies[:, 1], bodies[:, 0])
        o = np.lexsort(keys)
        first, touches = integers[live, 2] > 0, integers[live, 3].astype(np.intp)
        return Contacts(
            bodies[o],
            first[o],
            direction[o],
            normal[o],
            friction[o],
            touches[o],
            points[o],
            impulse[o],
            depth[o],
        )


def _table(rows: int, columns: int) -> tuple[Array, Buffer]:
    """Return an array and the buffer through which pymunk reads and writes it."""
    # pymunk reallocates an array that it has filled, and this one is not its own: leave room
    memory = np.zeros(rows * columns + 1)
    buffer = Buffer()
    buffer.set_float_buf(memory)
    return memory[:-1].reshape(rows, columns), buffer
