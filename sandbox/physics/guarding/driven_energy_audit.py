"""Detects unexplained energy in scenes whose energy may grow for a reason.

Only the ledger knows the reason, and it costs more than a step. So the books are opened when a step
changes the kinetic energy by much, as every step does in a run that blows up, and closed when steps
no longer do so. The first such step is booked as well.
"""

from math import isfinite

from sandbox.model.expressions import Array
from sandbox.physics.energy.balance import Balance
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.state.motion import kinetic_energy
from sandbox.physics.state.snapshot import Snapshot

MUCH = 0.1
"""The change of kinetic energy in a step, as a share of its maximum so far, that counts as much."""


class Audit:
    """Checks every observed step of a run, such as a world.

    `least` is an energy that is negligible in the scene [J], and `swing` the relative oscillation
    of energy that the scheme allows. If `always`, the books stay open, to detect slow growth,
    oscillation by oscillation.
    """

    def __init__(self, run: Recorded, least: float, swing: float, always: bool) -> None:
        self._run, self._least, self._swing, self._always = run, least, swing, always
        self._kinetic, self._most = 0.0, least
        self._books: Ledger | None = None
        self._lifted = 0.0  # before the books were opened
        self._had = self._lowest = 0.0  # energy at their opening; least stored since

    def look(self, now: Snapshot, before: Array, lifted: float) -> float:
        """Return the unexplained energy in a row of steps that change much [J].

        It is 0 within the allowed oscillation, and not finite if the kinetic energy is not.
        `before`, (n, 3), are the velocities at the beginning of the last kick [m/s, rad/s];
        `lifted` is the energy from the correction of overlaps since the start [J].
        """
        scene = self._run.scene
        kinetic = float(kinetic_energy(scene.mass, scene.moment, now).sum())
        if not isfinite(kinetic):
            return kinetic
        self._most = max(kinetic, self._most)
        much = abs(kinetic - self._kinetic) > MUCH * self._most
        had, self._kinetic = self._kinetic, kinetic
        if not (much or self._always):
            self._books = None
            self._lifted = lifted
            return 0.0
        if self._books is None or self._books.steps != self._run.last.steps - 1:
            self._books = Ledger(self._run, before)
            balance = self._books.balance
            self._lowest = _stored(balance)
            # an event in the last drift may have stopped bodies before the books begin
            self._had = max(balance.energy, had + self._lowest)
        self._books.note()
        return self._gained(self._books.balance, lifted - self._lifted)

    def _gained(self, balance: Balance, lifted: float) -> float:
        self._lowest = min(self._lowest, _stored(balance))
        put_in = sum(max(work, 0.0) for work in balance.work.values())
        there_was = self._had - self._lowest + put_in + lifted + self._least
        given = sum(max(-loss, 0.0) for loss in balance.loss.values())  # where only losses belong
        gained = balance.unexplained - lifted + given
        return gained if gained > there_was * self._swing else 0.0


def _stored(balance: Balance) -> float:
    return sum(balance.potential.values())
