"""The rows of constraints: their conditions, and which are active."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.engine.space_arrays import Booleans, Integers


@dataclass(frozen=True)
class Friction:
    """The rows of friction, whose impulses are bounded; f of them.

    `row`, (f,), has the indices of the rows, and `contact`, (2, f), those of the contact rows whose
    impulses, added up, bound them; −1 for none. `static` and `kinetic`, (f,), are the coefficients
    of static and of kinetic friction.
    """

    row: Integers
    contact: Integers
    static: Array
    kinetic: Array

    @cached_property
    def each(self) -> list[tuple[int, list[int], float, float]]:
        """Each row, with the contact rows that there are, and its two coefficients."""
        contacts = [[row for row in pair if row >= 0] for pair in self.contact.T.tolist()]
        coefficients = self.static.tolist(), self.kinetic.tolist()
        return list(zip(self.row.tolist(), contacts, *coefficients, strict=True))

    @cached_property
    def has_contact(self) -> Booleans:
        """Whether there is such a contact row: (2, f)."""
        return np.asarray(self.contact >= 0)

    @cached_property
    def coefficients(self) -> tuple[Array, Array]:
        """The static and the kinetic coefficients of each contact row: (2, f) each."""
        return self.static * self.has_contact, self.kinetic * self.has_contact


NO_FRICTION = Friction(
    np.zeros(0, dtype=np.intp),
    np.zeros((2, 0), dtype=np.intp),
    np.zeros(0),
    np.zeros(0),
)


class Active(NamedTuple):
    """The active rows; m rows, f of friction.

    `on`, (m,), tells which rows' rate is kept at zero; `slip`, (f,), is the sign of friction
    impulses that are at their bound, and 0 for others.
    """

    on: Booleans
    slip: Integers

    @property
    def key(self) -> bytes:
        """The active set as a hashable key."""
        return self.on.tobytes() + self.slip.tobytes()

    def equals(self, other: "Active") -> bool:
        """Return whether another active set is the same."""
        return other is self or other.key == self.key

    def changes(self, other: "Active") -> int:
        """Return in how many rows, and signs of slips, another active set differs."""
        rows, signs = self.on != other.on, self.slip != other.slip
        return int(np.count_nonzero(rows)) + int(np.count_nonzero(signs))


class Problem(NamedTuple):
    """The kinds of the rows; m of them.

    Rows in `free`, (m,), have an impulse of any sign and size: joints. Those in `pushes`, (m,),
    have a non-negative one: contacts, ropes. All other rows are friction.

    Rows with the same number in `alike`, (m,), are scaled alike: those of one joint, so that the
    result does not depend on the directions of its axes. If left out, each row is scaled by itself.
    """

    free: Booleans
    pushes: Booleans
    friction: Friction
    alike: Integers | None = None


class SystemTooLarge(Exception):  # noqa: N818 (the caller, who knows the time, tells it)
    """A system that is too large for a step; `body` is the index of a body that takes part."""

    def __init__(self, body: int, reason: Message) -> None:
        self.body, self.reason = body, reason
        super().__init__(reason)
