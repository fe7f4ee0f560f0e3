"""Bodies and contacts read and written through pymunk's private handles.

`pymunk.batch` reads or writes all bodies in one C call, but makes its arguments each time: this
takes 0.9 of the 1.1 µs for reading two bodies, and 1.4 of the 1.6 µs for writing them. Reading the
position of a `pymunk.Body` takes 0.5 µs, of which 0.3 make it a vector. A whole step with a string
or a force law takes a few µs and has two to eight such calls. Here the arguments are made once; no
public interface is as fast. Only this module, `arbiters` and `arbiter_handle` do so.
"""

from collections.abc import Callable, Sequence
from functools import partial
from struct import Struct
from types import SimpleNamespace

import numpy as np
import pymunk
from pymunk._chipmunk_cffi import ffi, lib
from pymunk.batch import BodyFields

from sandbox.model.expressions import Array

_READ = ffi.addressof(lib, "pmSpaceBodyGetIteratorFuncBatched")
_WRITE = ffi.addressof(lib, "pmSpaceBodySetIteratorFuncBatched")
_READ_BODY, _WRITE_BODY = (
    lib.pmSpaceBodyGetIteratorFuncBatched,
    lib.pmSpaceBodySetIteratorFuncBatched,
)
_FOUR, _EIGHT, _PACK = Struct("4d").unpack, Struct("8d").unpack, Struct("4d").pack_into


def stepper(space: pymunk.Space) -> Callable[[float], None]:
    """Return a function that takes a step of a duration [s].

    Unlike `Space.step` it does not handle objects that are added or removed within a step. There
    are none here, and that takes 0.4 of the 0.6 µs of `Space.step` for two bodies.
    """
    return partial(lib.cpSpaceStep, space._space)  # noqa: SLF001


def gravity_setter(space: pymunk.Space) -> Callable[[tuple[float, float]], None]:
    """Return a function that sets the gravity [m/s²].

    Setting `Space.gravity` takes 1.2 µs, this takes a fifth of it.
    """
    return partial(lib.cpSpaceSetGravity, space._space)  # noqa: SLF001


class _Caller:
    """What pymunk's callback asks of a constraint: is its body in a space, and which function."""

    a = SimpleNamespace(space=True)

    def __init__(self, call: Callable[[object, object], None]) -> None:
        self._pre_solve_func = call


def call_before_kick(constraint: pymunk.Constraint, call: Callable[[object, object], None]) -> None:
    """Let a constraint call a function before pymunk's kick, as its `pre_solve`.

    pymunk's callback looks up the constraint's body and its space twice, through weak references,
    which takes 0.7 of the 1.1 µs of a call. Here it finds what it asks for in one object. The
    function gets two arguments without meaning.
    """
    constraint.pre_solve = call
    handle = ffi.new_handle(_Caller(call))
    lib.cpConstraintSetUserData(constraint._constraint, handle)  # noqa: SLF001
    constraint._data_handle = handle  # noqa: SLF001 (which keeps the object)


class Memory:
    """An array that pymunk reads or writes, `values` (count,), and the arguments of the `call`.

    `passed[0]` is the number of values that pymunk has passed; setting a field of a structure of
    cffi takes twice the time.
    """

    def __init__(self, fields: BodyFields, count: int) -> None:
        # pymunk reallocates an array when it is full, which it must not here: leave room
        self.values = np.zeros(count + 1)[:-1]
        held = ffi.from_buffer("cpFloat[]", self.values.base)
        self._floats = ffi.new("pmFloatArray *", {"num": 0, "max": count + 1, "arr": held})
        self.passed = memoryview(ffi.buffer(self._floats)).cast("i")
        self._integers = ffi.new("pmIntArray *")
        arrays = {"floatArray": self._floats, "intArray": self._integers}
        self.call = ffi.new("pmBatchedData *", {"fields": fields.value, **arrays})


class Table:
    """Some fields of all bodies of a space, in pymunk's order, with its static body.

    `values`, (rows, columns), are those last read, or to be written.
    """

    def __init__(self, space: pymunk.Space, fields: BodyFields, rows: int, columns: int) -> None:
        self._memory = Memory(fields, rows * columns)
        self.values = self._memory.values.reshape(rows, columns)
        self._space = space._space  # noqa: SLF001

    def read(self) -> Array:
        """Read the values from the space, and return them."""
        self._memory.passed[0] = 0
        lib.cpSpaceEachBody(self._space, _READ, self._memory.call)
        return self.values

    def write(self) -> None:
        """Write the values to the space."""
        self._memory.passed[0] = 0
        lib.cpSpaceEachBody(self._space, _WRITE, self._memory.call)


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
        lib.cpSpaceEachBody(self._space, _READ, self._state)
        return _EIGHT(self._values)

    def set_velocity(self, ax: float, ay: float, bx: float, by: float) -> None:
        """Write the velocities of the first and the second [m/s]."""
        _PACK(self._buffer, 0, ax, ay, bx, by)
        self._velocities[0] = 0
        lib.cpSpaceEachBody(self._space, _WRITE, self._velocity)


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
