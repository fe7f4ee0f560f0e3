"""The positions and velocities of two bodies, through pymunk's private handles.

See `private_handles`. Only strings, rods and wires between two bodies need this.
"""

from collections.abc import Sequence
from struct import Struct

import pymunk
from pymunk._chipmunk_cffi import lib
from pymunk.batch import BodyFields

from sandbox.physics.engine.private_handles import READ, WRITE, Memory

_READ_BODY, _WRITE_BODY = (
    lib.pmSpaceBodyGetIteratorFuncBatched,
    lib.pmSpaceBodySetIteratorFuncBatched,
)
_FOUR, _EIGHT, _PACK = Struct("4d").unpack, Struct("8d").unpack, Struct("4d").pack_into


def pair_of(a: pymunk.Body, b: pymunk.Body) -> "Pair":
    """Return access to two bodies, once their space has all of its bodies."""
    if never_moves(a) != never_moves(b):
        return PairWithFixed(a, b)
    both = a.body_type == b.body_type == pymunk.Body.DYNAMIC
    return WholeSpace(a, b) if both and a.space and list(a.space.bodies) == [a, b] else Pair(a, b)


def never_moves(body: pymunk.Body) -> bool:
    """Return whether a body is the plane itself, or a point of it."""
    return body.space is None or body is body.space.static_body


class Pair:
    """The positions and velocities of two bodies only."""

    def __init__(self, a: pymunk.Body, b: pymunk.Body) -> None:
        self._bodies = a, b  # or pymunk would free them
        self._a, self._b = a._body, b._body  # noqa: SLF001
        state = Memory(BodyFields.POSITION | BodyFields.VELOCITY, 8)
        velocity = Memory(BodyFields.VELOCITY, 4)
        self._state, self._states = state.call, state.passed
        self._velocity, self._velocities = velocity.call, velocity.passed
        self._values, self._buffer = state.values.data, velocity.values.data

    def read(self) -> Sequence[float]:
        """Return x, y, vx, vy of the first, and then of the second [m, m/s]."""
        self._states[0], call = 0, self._state
        _READ_BODY(self._a, call)
        _READ_BODY(self._b, call)
        return _EIGHT(self._values)

    def set_velocity(self, ax: float, ay: float, bx: float, by: float) -> None:
        """Write the velocities of the first and the second [m/s]."""
        _PACK(self._buffer, 0, ax, ay, bx, by)
        self._velocities[0], call = 0, self._velocity
        _WRITE_BODY(self._a, call)
        _WRITE_BODY(self._b, call)


class WholeSpace(Pair):
    """The only two bodies of a space, in its order: one call takes two thirds of the time of two.

    pymunk visits its static body after them. It stays as it is.
    """

    def __init__(self, a: pymunk.Body, b: pymunk.Body) -> None:
        super().__init__(a, b)
        assert a.space is not None
        self._space = a.space._space  # noqa: SLF001
        state = Memory(BodyFields.POSITION | BodyFields.VELOCITY, 12)
        velocity = Memory(BodyFields.VELOCITY, 6)
        self._state, self._states = state.call, state.passed
        self._velocity, self._velocities = velocity.call, velocity.passed
        self._values, self._buffer = state.values[:8].data, velocity.values.data

    def read(self) -> Sequence[float]:
        """Return x, y, vx, vy of the first, and then of the second [m, m/s]."""
        self._states[0] = 0
        lib.cpSpaceEachBody(self._space, READ, self._state)
        return _EIGHT(self._values)

    def set_velocity(self, ax: float, ay: float, bx: float, by: float) -> None:
        """Write the velocities of the first and the second [m/s]."""
        _PACK(self._buffer, 0, ax, ay, bx, by)
        self._velocities[0] = 0
        lib.cpSpaceEachBody(self._space, WRITE, self._velocity)


class PairWithFixed(Pair):
    """Two bodies, one of which never moves: only the other is read and written."""

    def __init__(self, a: pymunk.Body, b: pymunk.Body) -> None:
        super().__init__(a, b)
        self._is_first, values = never_moves(b), super().read()
        self._moving = self._a if self._is_first else self._b
        self._fixed = tuple(values[4:] if self._is_first else values[:4])
        self._values = self._values[:4]

    def read(self) -> Sequence[float]:
        """Return x, y, vx, vy of the first, and then of the second [m, m/s]."""
        self._states[0] = 0
        _READ_BODY(self._moving, self._state)
        moving = _FOUR(self._values)
        return moving + self._fixed if self._is_first else self._fixed + moving

    def set_velocity(self, ax: float, ay: float, bx: float, by: float) -> None:
        """Write the velocity of the one that moves [m/s]."""
        lib.cpBodySetVelocity(self._moving, (ax, ay) if self._is_first else (bx, by))
