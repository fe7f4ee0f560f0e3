"""Reads pymunk's arbiters, one for each pair in contact, as the arrays of `space_arrays.Contacts`.

The pairs in contact seldom change from step to step, so everything that follows from them alone is
kept.
"""

from typing import Any, NamedTuple

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk._chipmunk_cffi import ffi, lib
from pymunk.batch import ArbiterFields, Buffer

_PAIRS = ffi.addressof(lib, "pmSpaceArbiterIteratorFuncBatched")


class ArbiterTable:
    """Some fields of all pairs of shapes that pymunk remembers as in contact.

    They are read through the C functions behind `pymunk.batch`; see `private_handles.py`. Of the
    4.6 µs in which `pymunk.batch` reads three pairs, it takes 3.7 to make the arguments.
    """

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


_FIELDS = (
    ArbiterFields.BODY_A_ID
    | ArbiterFields.BODY_B_ID
    | ArbiterFields.IS_FIRST_CONTACT
    | ArbiterFields.CONTACT_COUNT
    | ArbiterFields.TOTAL_IMPULSE
    | ArbiterFields.NORMAL
    | ArbiterFields.POINT_A_1
    | ArbiterFields.POINT_B_1
    | ArbiterFields.POINT_A_2
    | ArbiterFields.POINT_B_2
)


class Pairs(NamedTuple):
    """The pairs in contact."""

    raw: bytes
    """pymunk's record of them."""
    rows: NDArray[np.intp]
    """(k,), their rows in that record, in the order of the bodies."""
    bodies: NDArray[np.intp]
    first: NDArray[np.bool_]
    touches: NDArray[np.intp]
    """See `Contacts`."""
    is_unique: bool
    """Whether each two bodies have at most one pair, so that the order is unique."""
    none: tuple[NDArray[np.float64], ...]
    """`normal`, `friction` and `impulse` of `Contacts` without impulses."""


class Arbiters:
    """Reads the pairs in contact of a space.

    `ids`, (n,), are the ids of the bodies in ascending order, and `order` the indices of these
    bodies. `has_impulses` tells whether pymunk's impulses count; else they only tell pairs of the
    same bodies apart. `pairs` are those that were in contact at the last reading; None before.
    """

    def __init__(
        self,
        space: pymunk.Space,
        ids: NDArray[np.uintp],
        order: NDArray[np.intp],
        *,
        has_impulses: bool,
    ) -> None:
        self._has_impulses = has_impulses
        self._table, self._ids, self._order = ArbiterTable(space, _FIELDS), ids, order
        self._raw = b"", b""
        self.pairs: Pairs | None = None

    def has_changed(self) -> bool:
        """Read pymunk's records of contacts, and return whether they have changed."""
        before, self._raw = self._raw, self._table.read()
        return self._raw != before

    def read(self) -> tuple[NDArray[Any], ...] | None:
        """Return the fields of `Contacts`, in the order of the bodies; None without contacts."""
        integer, floating = self._raw
        if self.pairs is None or integer != self.pairs.raw:
            self.pairs = self._read_pairs(integer)
        _, rows, bodies, first, touches, is_unique, none = self.pairs
        if not len(rows):
            return None
        floats = np.frombuffer(floating).reshape(-1, 12).take(rows, axis=0)
        impulse, direction = floats[:, :2], floats[:, 2:4]
        on_surfaces = floats.reshape(-1, 6, 2)[:, 2:]
        one, other = on_surfaces[:, ::2], on_surfaces[:, 1::2]
        overlap = (one - other) * direction[:, None]
        depth = overlap[..., 0] + overlap[..., 1]
        points = (one + other) / 2
        if is_unique and not self._has_impulses:
            normal, friction, impulse = none
        else:
            normal, friction, impulse = _split(impulse, direction)
        return bodies, first, direction, normal, friction, touches, points, impulse, depth

    def _read_pairs(self, integer: bytes) -> Pairs:
        """Return the pairs in pymunk's record."""
        integers = np.frombuffer(integer, dtype=np.uintp).reshape(-1, 4)
        live = np.flatnonzero(integers[:, 3])  # pymunk remembers pairs for a while after they part
        bodies = self._order[self._ids.searchsorted(integers[live, :2])]
        order = np.lexsort((bodies[:, 1], bodies[:, 0]))
        rows, bodies = live[order], bodies[order]
        is_unique = bool((bodies[1:] != bodies[:-1]).any(axis=1).all())
        first, touches = integers[rows, 2] > 0, integers[rows, 3].astype(np.intp)
        none = np.zeros(len(rows)), np.zeros(len(rows)), np.zeros((len(rows), 2))
        return Pairs(integer, rows, bodies, first, touches, is_unique, none)


def _split(
    impulse: NDArray[np.float64], direction: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return the sizes of impulses along and across normals, (k,), and those on second bodies."""
    along = impulse[:, 0] * direction[:, 0] + impulse[:, 1] * direction[:, 1]
    impulse = impulse * np.where(along < 0, -1.0, 1.0)[:, None]
    across = impulse[:, 0] * direction[:, 1] - impulse[:, 1] * direction[:, 0]
    return np.abs(along), np.abs(across), impulse
