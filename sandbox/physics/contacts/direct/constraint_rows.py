"""The rows of constraints: what each asks for, and which are active."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.message import Message
from sandbox.physics.engine.batch import Booleans, Integers


@dataclass(frozen=True)
class Friction:
    """The rows whose impulses are bounded; f of them.

    Attributes
    ----------
    row
        (f,), which rows.
    contact
        (2, f), the rows whose impulses bound them, added up; −1 for none.
    sticks, slips
        (f,), the coefficients while it sticks and while it slips.
    """

    row: Integers
    contact: Integers
    sticks: Array
    slips: Array

    @cached_property
    def there(self) -> Booleans:
        """Whether there is such a contact: (2, f)."""
        return np.asarray(self.contact >= 0)

    @cached_property
    def shares(self) -> tuple[Array, Array]:
        """The coefficients of each contact while it sticks, and while it slips: (2, f) each."""
        return self.sticks * self.there, self.slips * self.there


NO_FRICTION = Friction(
    np.zeros(0, dtype=np.intp),
    np.zeros((2, 0), dtype=np.intp),
    np.zeros(0),
    np.zeros(0),
)


class Active(NamedTuple):
    """Which rows hold; m rows, f of friction.

    Attributes
    ----------
    on
        (m,), whose rate is kept at zero.
    slip
        (f,), the sign of the impulses that are at their bound; 0 of others.
    """

    on: Booleans
    slip: Integers

    @property
    def key(self) -> bytes:
        """The same, to be compared."""
        return self.on.tobytes() + self.slip.tobytes()


class Problem(NamedTuple):
    """What rows ask for; m of them.

    Attributes
    ----------
    free
        (m,), whose impulse may have any sign and size: joints.
    pushes
        (m,), whose impulse is not negative: contacts, ropes.
    friction
        All others.
    alike
        (m,), rows of the same number are scaled alike: those of one joint, which point along axes
        that anybody may have turned. No row's is like another's if left out.
    """

    free: Booleans
    pushes: Booleans
    friction: Friction
    alike: Integers | None = None


class TooMuch(Exception):  # noqa: N818 (whoever knows the time tells it)
    """More to solve than a step can carry; `body` is the index of one that has part in it."""

    def __init__(self, body: int, reason: Message) -> None:
        self.body, self.reason = body, reason
        super().__init__(reason)
