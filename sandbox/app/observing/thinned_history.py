"""The states of a run, and rows of numbers computed from them, in bounded memory."""

from collections.abc import Callable
from copy import copy
from dataclasses import fields

import numpy as np

from sandbox.app.observing.thinned_series import FIELDS, ThinnedSeries
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
        self._kept = ThinnedSeries(rows(Snapshot.stack([first]))[0])
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

    def drop_last(self, count: int) -> None:
        """Drop the last states that were noted; a copy of the history keeps them."""
        self._take_in()
        self._kept, self._waiting = copy(self._kept), []
        self._kept.drop_last(count)

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


_FIELDS = [field.name for field in fields(Snapshot)]


class ThinnedHistory(States):
    """The states of a run, for the graphs."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._shapes = [np.shape(getattr(snapshot, name)) for name in _FIELDS]
        super().__init__(_flat, snapshot)

    @property
    def snapshots(self) -> Snapshot:
        """The states that are kept; the first axis of each array is time."""
        rows, start, parts = self.rows, 0, {}
        for name, shape in zip(_FIELDS, self._shapes, strict=True):
            size = int(np.prod(shape))
            parts[name] = rows[:, start : start + size].reshape(len(rows), *shape)
            start += size
        return Snapshot(**parts)

    def at(self, t: float) -> Snapshot:
        """Return the kept state nearest to a time [s]."""
        states = self.snapshots
        row = int(np.abs(states.t - t).argmin())
        return Snapshot(**{name: getattr(states, name)[row] for name in _FIELDS})


def _flat(snapshots: Snapshot) -> Array:
    """Return all fields of the states, concatenated into a row for each state."""
    parts = (np.asarray(getattr(snapshots, name)) for name in _FIELDS)
    return np.concatenate([part.reshape(len(snapshots.t), -1) for part in parts], axis=1)
