"""Bodies read and written by the handles that pymunk keeps to itself.

`pymunk.batch` reads or writes all bodies in one call of C, but makes the arguments of that call
anew each time: 0.9 of the 1.1 µs that it takes to read two bodies, and 1.4 of the 1.6 to write
them. A `pymunk.Body` takes 0.5 µs to tell its place, of which 0.3 make a vector of it. A whole step
with a string or a force law takes few µs and has from two to eight such calls. Here the arguments
are made once; no public way is as fast, and nothing else in the sandbox looks behind pymunk.
"""

import numpy as np
import pymunk
from pymunk._chipmunk_cffi import ffi, lib
from pymunk.batch import BodyFields

from sandbox.model.expressions import Array

_READ = ffi.addressof(lib, "pmSpaceBodyGetIteratorFuncBatched")
_WRITE = ffi.addressof(lib, "pmSpaceBodySetIteratorFuncBatched")


class Memory:
    """Numbers that pymunk fills or reads, and the arguments of the call in which it does.

    Attributes
    ----------
    values
        (count,), the numbers.
    floats
        How pymunk sees them; `num` is how many it has been through.
    call
        What it is called with.
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
    """Where two bodies are and how fast, whatever else is in their space. The plane is complex."""

    def __init__(self, a: pymunk.Body, b: pymunk.Body) -> None:
        self._bodies = a, b  # or pymunk would let go of them
        self._a, self._b = a._body, b._body  # noqa: SLF001
        self._state = Memory(BodyFields.POSITION | BodyFields.VELOCITY, 8)
        self._velocity = Memory(BodyFields.VELOCITY, 4)
        self._seen, self._told = (m.values.view(complex) for m in (self._state, self._velocity))

    def read(self) -> list[complex]:
        """Return the place and the velocity of the one, and those of the other [m, m/s]."""
        memory = self._state
        memory.floats.num = 0
        lib.pmSpaceBodyGetIteratorFuncBatched(self._a, memory.call)
        lib.pmSpaceBodyGetIteratorFuncBatched(self._b, memory.call)
        return self._seen.tolist()

    def set_velocity(self, a: complex, b: complex) -> None:
        """Give both their velocities [m/s]."""
        memory, self._told[0], self._told[1] = self._velocity, a, b
        memory.floats.num = 0
        lib.pmSpaceBodySetIteratorFuncBatched(self._a, memory.call)
        lib.pmSpaceBodySetIteratorFuncBatched(self._b, memory.call)
