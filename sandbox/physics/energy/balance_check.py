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

    turnover: float
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
        limit = min(self.bound, MUCH * self.turnover)
        return self.unexplained <= limit or not self._has_turnover

    @property
    def _has_turnover(self) -> bool:
        """Whether the turnover is not negligible."""
        return self.turnover > max(NOTHING * self.scale, self.rounding)

    @property
    def unexplained_fraction(self) -> float:
        """The unexplained energy over the turnover; 0 if there was none."""
        return self.unexplained / self.turnover if self._has_turnover else 0.0

    @property
    def text(self) -> str:
        """The closing in words."""
        if not self._has_turnover:
            return "nothing turned over"
        fraction = self.unexplained_fraction
        if self.closes:
            return f"closes to {fraction:.1g} of {self.turnover:.3g} J turned over"
        text = (
            f"{self.unexplained:.2g} J of {self.turnover:.3g} J unexplained ({_percent(fraction)})"
        )
        if self.overlaps > self.unexplained / 2:
            return f"{text}, {self.overlaps:.2g} J of it by taking back overlaps"
        return text


class Closer:
    """Keeps the books of a run, and checks whether they close; `note` is called at every step."""

    def __init__(self, run: Recorded) -> None:
        self._run, self._ledger = run, Ledger(run)
        self._inertia, start = run.scene.inertia, run.last
        balance = self._ledger.balance
        self._stores_at_start = dict(balance.potential)
        self._turnover, self._unexplained = balance.kinetic, 0.0
        acceleration, position = start.law_acceleration[:, :2], start.snapshot.position
        weight = float(np.sum(self._inertia[:, 0] * np.hypot(*acceleration.T)))
        self._scale = sum(map(abs, self._stores_at_start.values())) + weight * float(
            np.ptp(position, axis=0).max()
        )
        speed = blur(np.append(position, 0.0), start.dt)
        self._rounding = float(self._inertia[:, 0].sum()) * speed**2
        self._is_constrained = run.scene.joints.together is not None
        self._acceleration_term = self._hessian_term = 0.0
        self._last_acceleration = np.full_like(self._inertia, np.nan)

    def note(self) -> None:
        """Add a step."""
        self._ledger.note()
        balance = self._ledger.balance
        stores = (abs(now - self._stores_at_start[name]) for name, now in balance.potential.items())
        others = (abs(one) for part in (balance.work, balance.loss) for one in part.values())
        self._turnover = max(self._turnover, balance.kinetic, *stores, *others)
        self._unexplained = max(self._unexplained, abs(balance.unexplained))
        now = self._run.last.snapshot
        a = np.column_stack((now.acceleration, now.angular_acceleration))
        v = np.column_stack((now.velocity, now.angular_velocity))
        self._acceleration_term = max(self._acceleration_term, float(np.sum(self._inertia * a * a)))
        term = abs(float(np.sum(self._inertia * v * (a - self._last_acceleration))))
        self._hessian_term = max(self._hessian_term, 0.0 if isnan(term) else term)  # at first NaN
        self._last_acceleration = a

    @property
    def closing(self) -> Closing:
        """The closing so far."""
        dt, bound = self._run.last.dt, ROUNDING * self._turnover + KNOWN * self._scale
        if not self._run.stepping.is_stock:
            acceleration_term = self._acceleration_term * (1 / 12 + self._is_constrained / 4)
            bound += dt * self._hessian_term / 6 + dt * dt * acceleration_term
        overlaps = self._ledger.balance.overlaps
        scales = self._scale, self._rounding
        return Closing(self._turnover, self._unexplained, overlaps, bound, *scales)


def _percent(fraction: float) -> str:
    return f"{100 * fraction:.2g} %" if fraction < 1 else f"{fraction:.2g} times that"
