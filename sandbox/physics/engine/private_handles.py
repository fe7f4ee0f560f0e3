"""Bodies and contacts read and written through pymunk's private handles.

`pymunk.batch` reads or writes all bodies in one call of C, but makes the arguments of that call
anew each time: 0.9 of the 1.1 µs that it takes to read two bodies, and 1.4 of the 1.6 to write
them. A `pymunk.Body` takes 0.5 µs to tell its place, of which 0.3 make a vector of it. A whole step
with a string or a force law takes few µs and has from two to eight such calls. Here the arguments
are made once; no public way is as fast. Nothing but this and `contact_handles.py` looks behind
pymunk.
"""

from collections.abc import Callable
from functools import partial
from struct import Struct

import numpy as np
import pymunk
from pymunk._chipmunk_cffi import ffi, lib
from pymunk.batch import BodyFields

from sandbox.model.expressions import Array

_READ = ffi.addressof(lib, "pmSpaceBodyGetIteratorFuncBatched")
_WRITE = ffi.addressof(lib, "pmSpaceBodySetIteratorFuncBatched")
_PAIR = Struct("4d")


def stepper(space: pymunk.Space) -> Callable[[float], None]:
    """Return what takes a step of a length [s], without looking after what comes and goes in one.

    Nothing does here, and of the 0.6 µs that `Space.step` takes for two bodies that is 0.4.
    """
    return partial(lib.cpSpaceStep, space._space)  # noqa: SLF001


class Memory:
    """Numbers that pymunk fills or reads, and the arguments of the call in which it does.

    Attributes
    ----------
    values
        (count,), the numbers.
    floats
        How pymunk sees them; `num` is how many it has been through.
    call
        The arguments of that call.
    """

    def __init__(self, fields: BodyFields, count: int) -> None:
        # pymunk reallocates an array that it has filled, and this one is not its own: leave room
        self.values = np.zeros(count + 1)[:-1]
        held = ffi.from_buffer("cpFloat[]", self.values.base)
        self.floats = ffi.new("pmFloatArray *", {"num": 0, "max": count + 1, "arr": held})
        self._integers = ffi.new("pmIntArray *")
        arrays = {"floatArray": self.floats, "intArray": self._integers}
        self.call = ffi.new("pmBatchedData *", {"fields": fields.value, **arrays})


class Table:
    """Some fields of all bodies of a space, in pymunk's order, its static body among them.

    Attributes
    ----------
    values
        (rows, columns), what was read last, or is to be written.
    """

    def __init__(self, space: pymunk.Space, fields: BodyFields, rows: int, columns: int) -> None:
        self._memory = Memory(fields, rows * columns)
        self.values = self._memory.values.reshape(rows, columns)
        self._space = space._space  # noqa: SLF001

    def read(self) -> Array:
        """Take up what the space has, and return it."""
        self._memory.floats.num = 0
        lib.cpSpaceEachBody(self._space, _READ, self._memory.call)
        return self.values

    def write(self) -> None:
        """Give the space what is here."""
        self._memory.floats.num = 0
        lib.cpSpaceEachBody(self._space, _WRITE, self._memory.call)


class Pair:
    """Where two bodies are and how fast, whatever else is in their space."""

    def __init__(self, a: pymunk.Body, b: pymunk.Body) -> None:
        self._bodies = a, b  # or pymunk would let go of them
        self._a, self._b = a._body, b._body  # noqa: SLF001
        self._state = Memory(BodyFields.POSITION | BodyFields.VELOCITY, 8)
        self._velocity = Memory(BodyFields.VELOCITY, 4)
        self._buffer = self._velocity.values.data

    def read(self) -> list[float]:
        """Return x, y, vx, vy of the one, and then of the other [m, m/s]."""
        memory = self._state
        memory.floats.num = 0
        lib.pmSpaceBodyGetIteratorFuncBatched(self._a, memory.call)
        lib.pmSpaceBodyGetIteratorFuncBatched(self._b, memory.call)
        return memory.values.tolist()

    def set_velocity(self, ax: float, ay: float, bx: float, by: float) -> None:
        """Give the one and the other their velocities [m/s]."""
        memory = self._velocity
        _PAIR.pack_into(self._buffer, 0, ax, ay, bx, by)
        memory.floats.num = 0
        lib.pmSpaceBodySetIteratorFuncBatched(self._a, memory.call)
        lib.pmSpaceBodySetIteratorFuncBatched(self._b, memory.call)
