"""Rows of numbers computed from the states of a run, in bounded memory."""

from collections.abc import Callable

from sandbox.app.observing.thinned_series import FIELDS, Trail
from sandbox.model.expressions import Array
from sandbox.physics.state.snapshot import Snapshot

MANY = 64
"""The number of states that are collected before they are converted: together they cost hardly
more than one."""


class States:
    """Rows of numbers, one for each state; when memory is full, every second one is dropped.

    `rows` converts k stacked states into rows: (k, ...). States are collected until the rows are
    needed, or until there are many.
    """

    def __init__(self, rows: Callable[[Snapshot], Array], first: Snapshot) -> None:
        self._rows = rows
        self._kept = Trail(rows(Snapshot.stack([first]))[0])
        self._waiting: list[Snapshot] = []
        self._most = max(min(MANY, FIELDS // max(first.position.size, 1)), 1)

    def __len__(self) -> int:
        self._take_in()
        return len(self._kept)

    def note(self, snapshot: Snapshot) -> None:
        """Record the next state."""
        self._waiting.append(snapshot)
        if len(self._waiting) == self._most:
            self._take_in()

    def restart(self, snapshot: Snapshot) -> None:
        """Forget everything, as after a body was moved by hand."""
        self._waiting.clear()
        self._kept.restart(self._rows(Snapshot.stack([snapshot]))[0])

    @property
    def rows(self) -> Array:
        """All rows that are kept: (k, ...)."""
        self._take_in()
        return self._kept.points

    def _take_in(self) -> None:
        if self._waiting:
            for row in self._rows(Snapshot.stack(self._waiting)):
                self._kept.add(row)
            self._waiting.clear()
