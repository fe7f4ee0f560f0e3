"""Whether the energy books of a run close, and how well they can.

Leapfrog keeps an energy to rounding, but not quite the one that is read. Read in the middle of a
drift, the two differ by

    dt² (v · V'' v / 12 − a · M a / 24),

or a part of it (Hairer, Lubich and Wanner 2006, IX.3). V'' are the slopes of the forces, a the
accelerations. So the energy that is read swings by at most twice the largest value of that, and as
much of it is unexplained: of a spring's energy (ω dt)² / 4. A body that joints hold leaves its path
in the middle of a drift, by a dt² / 8 across it; this adds a · M a dt² / 8. Where forces are
constant the difference stays the same, and the books close to rounding. The scheme does not explain
more than that. The rest comes from overlaps that were taken back, from steps that are too coarse
for an orbit or a bend, or from a scheme that is not leapfrog. A scheme of fourth order leaves less.
"""

from math import isnan
from typing import NamedTuple

import numpy as np

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.joints.exact.constraints import blur

ROUNDING = 1e-11
"""The share of the turnover that rounding may make in a run;"""

KNOWN = 1e-13
"""and the share of the energy that the scene could store to which the turnover is known."""

MUCH = 1 / 15
"""The share of what was turned over beyond which no books close, whatever the scheme may leave: as
much as of a spring at the lowest rate that is advised for it. Where a jerk or an impact sets the
bound, that alone would let pass what was in motion."""

NOTHING = 1e-9
"""The turnover counts as none below this share of that energy."""


class Closing(NamedTuple):
    """How the books of energy closed [J].

    Attributes
    ----------
    turned
        What was turned over: the most of what was in motion, of what any store gave or took, or
        anything else since the start.
    unexplained
        The most that had no cause.
    overlaps
        Of that, what taking back overlaps gave by the end.
    bound
        What the scheme may leave unexplained.
    scale
        What could be stored in the scene, about.
    rounding
        The kinetic energy of velocities that round positions within a step; less is rest.
    """

    turned: float
    unexplained: float
    overlaps: float
    bound: float
    scale: float
    rounding: float = 0.0

    @property
    def closes(self) -> bool:
        """Whether no more is unexplained than the scheme may leave, and not much of it all."""
        most = min(self.bound, MUCH * self.turned)
        return self.unexplained <= most or not self._turns

    @property
    def _turns(self) -> bool:
        """Whether anything to speak of was turned over."""
        return self.turned > max(NOTHING * self.scale, self.rounding)

    @property
    def share(self) -> float:
        """The unexplained energy over the turnover; 0 if there was none."""
        return self.unexplained / self.turned if self._turns else 0.0

    @property
    def text(self) -> str:
        """How they closed, in words."""
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
        """Take in a step."""
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
        self._slope = max(self._slope, 0.0 if isnan(slope) else slope)  # at the first there is none
        self._before = pull

    @property
    def closing(self) -> Closing:
        """How they stand."""
        dt, bound = self._run.last.dt, ROUNDING * self._turned + KNOWN * self._scale
        if not self._run.stepping.is_stock:
            strain = self._strain * (1 / 12 + self._bends / 4)
            bound += dt * self._slope / 6 + dt * dt * strain
        overlaps = self._ledger.balance.overlaps
        known = self._scale, self._rounding
        return Closing(self._turned, self._unexplained, overlaps, bound, *known)


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 1 else f"{share:.2g} times that"
