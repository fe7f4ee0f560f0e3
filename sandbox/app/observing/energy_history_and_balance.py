"""The energies of a run over time, and the balance of what changed them."""

from copy import copy
from dataclasses import dataclass

import numpy as np

from sandbox.app.observing.thinned_history import States
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.model.expressions import Array
from sandbox.physics.energy.balance import Balance
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World

INSTANTS = 500
"""The approximate number of instants that are kept per duration of the level."""

_ENERGIES = ("system.kinetic_energy", "system.potential_energy", "system.energy")


@dataclass(frozen=True, slots=True)
class Energies:
    """The energies of the whole system [J]."""

    kinetic: float
    potential: float
    total: float


class EnergyHistory:
    """Records the energies of a world from its current state on; `note` is called at every step.

    `steps` is the number of steps in the level's duration. The balance is recorded only while it is
    shown: that takes as long as the steps themselves, or longer.
    """

    def __init__(self, world: World, steps: int) -> None:
        self._world = world
        self._meter = Meter(world, _ENERGIES)
        self._every = max(steps // INSTANTS, 1)
        self.start = self.energies
        """The energies at the start of the run, or after the user's last action on a body."""
        self._let_go = False
        self._history = States(self._rows, world.snapshot)
        self._ledger: Ledger | None = None
        self._since: float | None = None

    def note(self) -> None:
        """Record a step."""
        if self._ledger is not None:
            self._ledger.note()
        if self._let_go:
            self.start, self._let_go = self.energies, False
        if self._world.steps % self._every == 0:
            self._history.note(self._world.snapshot)

    def drop_last(self, steps: int) -> None:
        """Drop the last steps, now that the world has gone back; a copy of the books keeps them."""
        now = self._world.steps
        self._history = copy(self._history)
        self._history.drop_last((now + steps) // self._every - now // self._every)

    def keep(self, kept: bool) -> None:
        """Start or stop recording the balance."""
        if kept and self._ledger is None:
            self._open()
        elif not kept:
            self._ledger = None

    @property
    def kept(self) -> bool:
        """Whether the balance is recorded."""
        return self._ledger is not None

    def _open(self) -> None:
        """Start a new balance at the current step."""
        self._ledger = Ledger(self._world)
        self._since = self._world.t if self._world.steps else None

    @property
    def since(self) -> float | None:
        """The time since which the balance is recorded [s]; None if it covers the whole run."""
        return self._since if self.kept else self._world.t

    @property
    def covered(self) -> str:
        """The period that the balance covers, in words, and whether it is half a step ahead."""
        told = [say("since the start")]
        if self.since is not None:
            told = [say("since t = {t}", t=formatting.seconds(self.since))]
        if not self._world.kicks.composed:
            told.append(say("half a step ahead"))
        return ", ".join(told)

    def hand_over(self) -> None:
        """Compare energies with the current ones from now on, after the user has done work.

        Half of the last pull is still to come, so the energies after the next step count.
        """
        self.start, self._let_go = self.energies, True

    def restart(self) -> None:
        """Start recording anew, as after a body was moved by hand; `start` stays."""
        if self.kept:
            self._open()
        self._history.restart(self._world.snapshot)

    @property
    def energies(self) -> Energies:
        """The current energies."""
        return Energies(*(float(value) for value in self._meter(self._world.snapshot).values()))

    @property
    def balance(self) -> Balance:
        """The balance of energy and momentum since recording started; see `since`."""
        return (self._ledger or Ledger(self._world)).balance

    @property
    def history(self) -> Array:
        """Energies over time up to now: (k, 4), time [s], kinetic, potential and total [J]."""
        now = self._rows(Snapshot.stack([self._world.snapshot]))
        return np.vstack((self._history.rows, now))

    def _rows(self, snapshots: Snapshot) -> Array:
        """Return time and energies of states: (k, 4)."""
        return np.column_stack((snapshots.t, *self._meter(snapshots).values()))
