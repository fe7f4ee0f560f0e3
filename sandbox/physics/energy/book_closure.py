"""Checks whether the energy books of a run close, within what the scheme allows.

Leapfrog conserves an energy to rounding, but not quite the one that is read. In the middle of a
drift the two differ by

    dt² (v · V'' v / 12 − a · M a / 24),

or a part of it (Hairer, Lubich and Wanner 2006, IX.3). V'' is the Hessian of the potential, a are
the accelerations. So the energy that is read oscillates by at most twice the largest value of that
difference, and as much is unexplained: for a spring, (ω dt)² / 4 of its energy. A body held by
joints leaves its path in the middle of a drift, by a dt² / 8 across it; this adds a · M a dt² / 8.
Under constant forces the difference is constant, and the books close to rounding. The scheme
explains no more than that. Larger gaps come from the correction of overlaps, from steps too coarse
for an orbit or a bend, or from a scheme other than leapfrog. A scheme of fourth order leaves less.
"""

from math import isnan
from typing import NamedTuple

import numpy as np

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.joints.exact.constraint_interface import blur

ROUNDING = 1e-11
"""The share of the turnover that rounding may add up to in a run;"""

KNOWN = 1e-13
"""and the precision of the turnover, as a share of the energy that the scene could store."""

MUCH = 1 / 15
"""The unexplained share of the turnover beyond which no books close, whatever the scheme allows:
that of a spring at the lowest rate advised for it. Where a jerk or an impact sets the bound, the
bound alone would allow an error as large as the kinetic energy."""

NOTHING = 1e-9
"""The turnover counts as none below this share of that energy."""


class Closing(NamedTuple):
    """The closing of the energy books [J]."""

    turned: float
    """The turnover: the largest kinetic energy, change of a store, or other entry."""
    unexplained: float
    """The largest amount without a cause."""
    overlaps: float
    """The part of it due to the correction of overlaps, at the end."""
    bound: float
    """The most that the scheme may leave unexplained."""
    scale: float
    """The approximate energy that the scene could store."""
    rounding: float = 0.0
    """The kinetic energy of the rounding of positions within a step; less is rest."""

    @property
    def closes(self) -> bool:
        """Whether the unexplained energy is within the bound, and not a large share of all."""
        most = min(self.bound, MUCH * self.turned)
        return self.unexplained <= most or not self._turns

    @property
    def _turns(self) -> bool:
        """Whether the turnover is not negligible."""
        return self.turned > max(NOTHING * self.scale, self.rounding)

    @property
    def share(self) -> float:
        """The unexplained energy over the turnover; 0 if there was none."""
        return self.unexplained / self.turned if self._turns else 0.0

    @property
    def text(self) -> str:
        """The closing in words."""
        if not self._turns:
            return "nothing turned over"
        share = self.share
        if self.closes:
            return f"closes to {share:.1g} of {self.turned:.3g} J turned over"
        text = f"{self.unexplained:.2g} J of {self.turned:.3g} J unexplained ({_percent(share)})"
        if self.overlaps > self.unexplained / 2:
            return f"{text}, {self.overlaps:.2g} J of it by taking back overlaps"
        return text


class Closer:
    """Keeps the books of a run, and checks whether they close; `note` is called at every step."""

    def __init__(self, run: Recorded) -> None:
        self._run, self._ledger = run, Ledger(run)
        self._inertia, start = run.scene.inertia, run.last
        balance = self._ledger.balance
        self._stored = dict(balance.potential)
        self._turned, self._unexplained = balance.kinetic, 0.0
        pull, place = start.smooth[:, :2], start.snapshot.position
        weight = float(np.sum(self._inertia[:, 0] * np.hypot(*pull.T)))
        self._scale = sum(map(abs, self._stored.values())) + weight * float(
            np.ptp(place, axis=0).max()
        )
        speed = blur(np.append(place, 0.0), start.dt)
        self._rounding = float(self._inertia[:, 0].sum()) * speed**2
        self._bends = run.scene.joints.together is not None
        self._strain = self._slope = 0.0
        self._before = np.full_like(self._inertia, np.nan)

    def note(self) -> None:
        """Add a step."""
        self._ledger.note()
        balance = self._ledger.balance
        stores = (abs(now - self._stored[name]) for name, now in balance.potential.items())
        others = (abs(v) for part in (balance.work, balance.loss) for v in part.values())
        self._turned = max(self._turned, balance.kinetic, *stores, *others)
        self._unexplained = max(self._unexplained, abs(balance.unexplained))
        now = self._run.last.snapshot
        pull = np.column_stack((now.acceleration, now.angular_acceleration))
        moves = np.column_stack((now.velocity, now.angular_velocity))
        self._strain = max(self._strain, float(np.sum(self._inertia * pull * pull)))
        slope = abs(float(np.sum(self._inertia * moves * (pull - self._before))))
        self._slope = max(self._slope, 0.0 if isnan(slope) else slope)  # at first NaN
        self._before = pull

    @property
    def closing(self) -> Closing:
        """The closing so far."""
        dt, bound = self._run.last.dt, ROUNDING * self._turned + KNOWN * self._scale
        if not self._run.stepping.is_stock:
            strain = self._strain * (1 / 12 + self._bends / 4)
            bound += dt * self._slope / 6 + dt * dt * strain
        overlaps = self._ledger.balance.overlaps
        known = self._scale, self._rounding
        return Closing(self._turned, self._unexplained, overlaps, bound, *known)


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 1 else f"{share:.2g} times that"
