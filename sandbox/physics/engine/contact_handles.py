"""Reads pairs in contact through the C functions behind `pymunk.batch`; see `private_handles.py`.

Of the 4.6 µs in which `pymunk.batch` reads three pairs, it takes 3.7 to make the arguments.
"""

import pymunk
from pymunk._chipmunk_cffi import ffi, lib
from pymunk.batch import ArbiterFields, Buffer

_PAIRS = ffi.addressof(lib, "pmSpaceArbiterIteratorFuncBatched")


class ArbiterTable:
    """Some fields of all pairs of shapes that pymunk remembers as in contact."""

    def __init__(self, space: pymunk.Space, fields: ArbiterFields) -> None:
        self._buffer = Buffer()  # its arrays grow with the number of pairs
        self._floats, self._integers = self._buffer._float_arr, self._buffer._int_arr  # noqa: SLF001
        arrays = {"floatArray": self._floats, "intArray": self._integers}
        self._call = ffi.new("pmBatchedData *", {"fields": fields.value, **arrays})
        self._space = space._space  # noqa: SLF001

    def read(self) -> tuple[bytes, bytes]:
        """Return the present fields: the integers, and the floats."""
        floats, integers = self._floats, self._integers
        floats.num = integers.num = 0
        lib.cpSpaceEachCachedArbiter(self._space, _PAIRS, self._call)
        whole, rest = (ffi.buffer(held.arr, 8 * held.num) for held in (integers, floats))
        return bytes(whole), bytes(rest)
