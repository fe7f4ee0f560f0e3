"""The energies of a run over time, and the accounts of where they come from and go."""

from dataclasses import dataclass

import numpy as np

from sandbox.app.observing.trail import Trail
from sandbox.model.expressions import Array
from sandbox.physics.energy.balance import Balance
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.metering.meter import Meter
from sandbox.physics.stepping.world import World

INSTANTS = 500
"""At about how many instants of a level's duration the energies are kept."""

_ENERGIES = ("system.kinetic_energy", "system.potential_energy", "system.energy")


@dataclass(frozen=True, slots=True)
class Energies:
    """Of the whole system [J]."""

    kinetic: float
    potential: float
    total: float


class Books:
    """The books of a world from its present state on; `note` is called at every step.

    Attributes
    ----------
    start
        The energies with which the run began, or with which a hand has left it.

    Parameters
    ----------
    world
        What is watched.
    steps
        How many steps reach the end of its duration.
    """

    def __init__(self, world: World, steps: int) -> None:
        self._world, self._ledger = world, Ledger(world)
        self._meter = Meter(world, _ENERGIES)
        self._every = max(steps // INSTANTS, 1)
        self.start, self._let_go = self.energies, False
        self._history = Trail(self._row())

    def note(self) -> None:
        """Take in a step."""
        self._ledger.note()
        if self._let_go:
            self.start, self._let_go = self.energies, False
        if self._world.steps % self._every == 0:
            self._history.add(self._row())

    def hand_over(self) -> None:
        """Let energies be compared with those of now: a hand has worked, and lets go.

        Half of its last pull is still to come, so those after the next step count.
        """
        self.start, self._let_go = self.energies, True

    def restart(self) -> None:
        """Begin anew, as after a hand has put a body elsewhere; the start stays."""
        self._ledger = Ledger(self._world)
        self._history.restart(self._row())

    @property
    def energies(self) -> Energies:
        """The energies of now."""
        return Energies(*(float(value) for value in self._meter(self._world.snapshot).values()))

    @property
    def balance(self) -> Balance:
        """Where energy and momentum came from and went, since the run or the books began."""
        return self._ledger.balance

    @property
    def history(self) -> Array:
        """Energies over time: (k, 4), [s], then kinetic, potential and total [J], up to now."""
        return np.vstack((self._history.points, self._row()))

    def _row(self) -> Array:
        now = self.energies
        return np.array([self._world.snapshot.t, now.kinetic, now.potential, now.total])
