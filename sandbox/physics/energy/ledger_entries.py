"""The accounts of a ledger, and their entries."""

from collections.abc import Mapping

import numpy as np

from sandbox.model import ledger_accounts
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.forces.law import Law
from sandbox.physics.forces.spring import damps
from sandbox.physics.state.motion import momentum


class Entries:
    """The entries so far, by account: works and losses, which are negative [J], and impulses.

    The impulses are those from outside, (3,) each: along x and y [N s], and about the
    origin [N m s].
    """

    def __init__(self, level: Level) -> None:
        self.works = dict.fromkeys((*ledger_accounts.works(level), "hand"), 0.0)
        self.losses = dict.fromkeys(ledger_accounts.losses(level), 0.0)
        self.impulses = {name: np.zeros(3) for name in ledger_accounts.external_accounts(level)}
        self._loss_in_kick: dict[str, float] | None = None  # in the kick or impact so far [J]

    def begin(self) -> None:
        """Begin a kick, or an impact: within it, a gain may cancel earlier losses, and no more."""
        self._loss_in_kick = {}

    def add_impulse(self, name: str, impulse: Array, position: Array) -> None:
        """Book impulses (n, 3) at places, unless they are internal to the system."""
        if name in self.impulses:
            self.impulses[name] = self.impulses[name] + momentum(impulse, position)

    def add_support(self, impulse: Array) -> None:
        """Book an impulse from supports: (3,)."""
        if "supports" in self.impulses:
            self.impulses["supports"] += impulse

    def add_works(self, works: Mapping[str, float]) -> None:
        """Book works by cause, where there is an account for the cause."""
        for name in works.keys() & self.works.keys():
            self.works[name] += works[name]

    def add_law_work(self, law: Law, work: float) -> None:
        """Book the work of a law, unless it stores energy."""
        if law.effect.book == "work":
            self.works[law.effect.account_name] += work
        elif law.effect.book == "loss":
            self.losses[law.effect.account_name] += work

    def add_extra_work(self, law: Law, work: float) -> None:
        """Book the work that a law does within a drift, beyond that in kicks."""
        self.add_law_work(law, work)
        if damps(law):
            self.losses["damping"] += work

    def add_friction(self, work: float) -> None:
        """Book the work of friction."""
        if "friction" in self.losses:
            self.losses["friction"] += work

    def add_loss(self, name: str, work: float) -> float:
        """Book a loss, and return the booked part; a net gain in a kick stays unexplained.

        Before the first kick, what is booked takes back a part of the kick that opened the books.
        """
        if self._loss_in_kick is None:
            self.losses[name] += work
            return work
        before = self._loss_in_kick.get(name, 0.0)
        self._loss_in_kick[name] = before + work
        booked = min(before + work, 0.0) - min(before, 0.0)
        self.losses[name] += booked
        return booked

    @property
    def explained(self) -> float:
        """The sum of all works and losses [J]."""
        return sum(self.works.values()) + sum(self.losses.values())
