"""The energies of a run over time, and the accounts of where they come from and go."""

from dataclasses import dataclass

import numpy as np

from sandbox.app.observing.state_rows import States
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.model.expressions import Array
from sandbox.physics.energy.balance import Balance
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World

INSTANTS = 500
"""How many instants are kept per duration of the level, about."""

_ENERGIES = ("system.kinetic_energy", "system.potential_energy", "system.energy")


@dataclass(frozen=True, slots=True)
class Energies:
    """Of the whole system [J]."""

    kinetic: float
    potential: float
    total: float


class Books:
    """The energies of a world from its present state on; `note` is called at every step.

    Where they come from and go is booked only while somebody looks: that takes as long as the steps
    themselves, or longer.

    Attributes
    ----------
    start
        The energies with which the run began, or with which a hand has left it.

    Parameters
    ----------
    world
        The world to watch.
    steps
        How many steps reach the end of its duration.
    """

    def __init__(self, world: World, steps: int) -> None:
        self._world = world
        self._meter = Meter(world, _ENERGIES)
        self._every = max(steps // INSTANTS, 1)
        self.start, self._let_go = self.energies, False
        self._history = States(self._rows, world.snapshot)
        self._ledger: Ledger | None = None
        self._since: float | None = None

    def note(self) -> None:
        """Take in a step."""
        if self._ledger is not None:
            self._ledger.note()
        if self._let_go:
            self.start, self._let_go = self.energies, False
        if self._world.steps % self._every == 0:
            self._history.note(self._world.snapshot)

    def keep(self, kept: bool) -> None:
        """Book what steps do from now on, or no more."""
        if kept and self._ledger is None:
            self._open()
        elif not kept:
            self._ledger = None

    @property
    def kept(self) -> bool:
        """Whether steps are booked."""
        return self._ledger is not None

    def _open(self) -> None:
        """Start books without any steps."""
        self._ledger = Ledger(self._world)
        self._since = self._world.t if self._world.steps else None

    @property
    def since(self) -> float | None:
        """The time since which steps are booked [s]; None if all of the run are."""
        return self._since if self.kept else self._world.t

    @property
    def covered(self) -> str:
        """What the balance is of, in words: since when, and whether it is read at the step."""
        told = [say("since the start")]
        if self.since is not None:
            told = [say("since t = {t}", t=formatting.seconds(self.since))]
        if not self._world.kicks.composed:
            told.append(say("half a step ahead"))
        return ", ".join(told)

    def hand_over(self) -> None:
        """Compare energies with the present ones from now on: a hand has done work, and lets go.

        Half of its last pull is still to come, so those after the next step count.
        """
        self.start, self._let_go = self.energies, True

    def restart(self) -> None:
        """Start again, as after a hand has moved a body; the start of the run stays."""
        if self.kept:
            self._open()
        self._history.restart(self._world.snapshot)

    @property
    def energies(self) -> Energies:
        """The energies of now."""
        return Energies(*(float(value) for value in self._meter(self._world.snapshot).values()))

    @property
    def balance(self) -> Balance:
        """Where energy and momentum came from and went, since steps are booked."""
        return (self._ledger or Ledger(self._world)).balance

    @property
    def history(self) -> Array:
        """Energies over time: (k, 4), [s], then kinetic, potential and total [J], up to now."""
        now = self._rows(Snapshot.stack([self._world.snapshot]))
        return np.vstack((self._history.rows, now))

    def _rows(self, snapshots: Snapshot) -> Array:
        """Return time and energies of states: (k, 4)."""
        return np.column_stack((snapshots.t, *self._meter(snapshots).values()))
