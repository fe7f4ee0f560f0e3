"""The states of a run in bounded memory, for the graphs."""

from dataclasses import fields

import numpy as np

from sandbox.app.observing.state_rows import States
from sandbox.model.expressions import Array
from sandbox.physics.state.snapshot import Snapshot

_FIELDS = [field.name for field in fields(Snapshot)]


class History:
    """The states of a run; when memory is full, every second one is dropped."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._shapes = [np.shape(getattr(snapshot, name)) for name in _FIELDS]
        self._kept = States(_flat, snapshot)

    def __len__(self) -> int:
        return len(self._kept)

    def note(self, snapshot: Snapshot) -> None:
        """Record the next state."""
        self._kept.note(snapshot)

    def restart(self, snapshot: Snapshot) -> None:
        """Forget everything, as after a body was moved by hand."""
        self._kept.restart(snapshot)

    @property
    def snapshots(self) -> Snapshot:
        """The states that are kept; the first axis of each array is time."""
        rows, start, parts = self._kept.rows, 0, {}
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
