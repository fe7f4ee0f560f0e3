"""The update of an active set: which rows let go, bear, stick or slip instead.

Row by row in plain numbers: most islands have few rows, for which arrays take longer.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active, Friction


class ActiveSetResult(NamedTuple):
    """What an active set leads to; m rows.

    `on`, (m,), tells which rows are active. Impulses and rates, (m,), are scaled to inverse masses
    of the rows near one. `close` is the rounding error of any impulse, and `still`, (m,), are those
    of the rates.
    """

    on: list[bool]
    impulse: list[float]
    rate: list[float]
    close: float
    still: list[float]

    @classmethod
    def of(
        cls, active: Active, impulse: Array, rate: Array, close: float, still: Array
    ) -> "ActiveSetResult":
        """Return it from arrays."""
        return cls(active.on.tolist(), impulse.tolist(), rate.tolist(), close, still.tolist())

    def better(
        self, active: Active, pushing: Sequence[int], friction: Friction, size: Sequence[float]
    ) -> Active | None:
        """Return a better active set; None if this one is right.

        `active` is the set that led to this result; `pushing` and `friction` are the rows with a
        non-negative impulse, and those of friction. `size`, (m,), has the factors by which impulses
        are scaled.
        """
        before: list[int] = active.slip.tolist()
        on, slip = self._update_active(pushing), before.copy()
        self._update_friction(on, slip, friction, size)
        if on == self.on and slip == before:
            return None
        return Active(np.array(on), np.array(slip, dtype=np.intp))

    def _update_active(self, pushing: Sequence[int]) -> list[bool]:
        """Return the active rows: without those that pull, and with those that would overlap."""
        was, impulse, rate, close, still = self
        on = was.copy()
        for row in pushing:
            if (impulse[row] + close if was[row] else rate[row] + still[row]) < 0:
                on[row] = not was[row]
        return on

    def _update_friction(
        self, on: list[bool], slip: list[int], friction: Friction, size: Sequence[float]
    ) -> None:
        """Update which rows of friction stick, and the directions of those that slip."""
        was, impulse, rate, close, still = self
        for i, (row, contacts, sticks, _) in enumerate(friction.each):
            if slip[i]:
                if slip[i] * rate[row] > still[row]:
                    slip[i] = 0
            elif was[row]:
                bound = 0.0
                for contact in contacts:
                    bound += sticks * (size[row] / size[contact]) * max(impulse[contact], 0.0)
                if abs(impulse[row]) > bound + close:
                    slip[i] = 1 if impulse[row] > 0 else -1
            if not (on[contacts[0]] or on[contacts[-1]]):
                slip[i], on[row] = 0, False
            else:
                on[row] = not slip[i]
