"""Bodies and contacts read and written through pymunk's private handles.

`pymunk.batch` reads or writes all bodies in one C call, but makes its arguments each time: this
takes 0.9 of the 1.1 µs for reading two bodies, and 1.4 of the 1.6 µs for writing them. Reading the
position of a `pymunk.Body` takes 0.5 µs, of which 0.3 make it a vector. A whole step with a string
or a force law takes a few µs and has two to eight such calls. Here the arguments are made once; no
public interface is as fast. Only this module, `pairs_of_bodies`, `arbiters` and `arbiter_handle`
do so.
"""

from collections.abc import Callable
from functools import partial
from types import SimpleNamespace

import numpy as np
import pymunk
from pymunk._chipmunk_cffi import ffi, lib
from pymunk.batch import BodyFields

from sandbox.model.expressions import Array

READ = ffi.addressof(lib, "pmSpaceBodyGetIteratorFuncBatched")
WRITE = ffi.addressof(lib, "pmSpaceBodySetIteratorFuncBatched")


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
        lib.cpSpaceEachBody(self._space, READ, self._memory.call)
        return self.values

    def write(self) -> None:
        """Write the values to the space."""
        self._memory.passed[0] = 0
        lib.cpSpaceEachBody(self._space, WRITE, self._memory.call)
