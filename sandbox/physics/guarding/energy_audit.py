"""Detects unexplained energy.

Without energy input, energy can grow for two reasons only: the steps are too coarse, or the
correction of overlaps has lifted a body. The latter is visible: the displacement of the body is not
its velocity times the drift. So the energy can be checked at no cost, and any other growth is
unexplained.

With energy input, only the ledger knows why energy grows, and it costs more than a step. So the
books are opened when a step changes the kinetic energy by much, as every step does in a run that
blows up, and closed when steps no longer do so. The first such step is booked as well.
"""

from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.energy.balance import Balance
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.motion import Instant, kinetic_energy
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sandbox.physics.forces.law import Law
    from sandbox.physics.forces.spring import SpringForce, SpringRows


UNNOTICED = 1e-2
"""The share of its thickness by which a body may rise; the heaviest piles rock by as much."""

MOVED = 1e-12
"""The least displacement that is checked, as a share of the position or of a metre."""

FALLS = 2.0
"""The speed with which a body may bounce where it should rest, in steps of free fall."""

ROUNDING = 1e-6
"""The share of the initial energy that is negligible."""

MUCH = 0.1
"""The change of kinetic energy in a step, as a share of its maximum so far, that counts as much."""


class PassiveAudit:
    """Detects energy without a cause where nothing puts energy in, from the start on; n bodies.

    `thickness`, (n,), is that of the bodies, 0 for lines [m]; `oscillation` is the relative
    oscillation of a spring's energy with leapfrog, and `rate` the steps per second [Hz].
    `negligible` is an energy that is negligible in the scene, and `correction` the energy
    from the correction of overlaps so far [J].
    """

    def __init__(
        self, scene: Scene, start: Snapshot, thickness: Array, oscillation: float, rate: float
    ) -> None:
        self._scene, self._oscillation, self._dt = scene, oscillation, 1 / rate
        self._laws = (*([scene.gravity] if scene.gravity else []), *scene.laws)
        stores = {id(law): law for law in self._laws if law.effect.book == "potential"}
        springs = (spring for spring in scene.joints.springs.values() if spring.is_plain)
        plain = [spring for spring in springs if stores.pop(id(spring), None)]
        self._stores, self._springs = [*stores.values()], _rows(plain) if plain else None
        energy, self._min_potential = self.energies(start)
        self._previous_energy = self._min_energy = energy
        self._last = start
        strength = np.hypot(*self._acceleration(start, self._laws)[:, :2].T)
        rise = strength * UNNOTICED * thickness + (FALLS * strength * self._dt) ** 2 / 2
        self.negligible = float(scene.mass @ rise) + ROUNDING * abs(energy - self._min_potential)
        shift = MOVED * (1 + np.abs(start.position).max(initial=0.0))  # the precision of joints
        self.negligible += float(scene.mass.sum()) * (shift * rate) ** 2 / 2
        # of forces in balance each stores energy, which is known as well as positions are
        magnitudes = (np.hypot(*self._acceleration(start, [law])[:, :2].T) for law in self._laws)
        self.negligible += float(scene.mass @ sum(magnitudes, np.zeros_like(scene.mass))) * shift
        self._unseen_correction = float(scene.mass @ strength) * _extent(scene, start, thickness)
        if scene.joints.own:  # pymunk's own joints drift, and their correction lifts bodies, too
            self.negligible += self._unseen_correction
        self._negligible_square = float(shift * shift)
        self.correction = 0.0

    def energies(self, now: Snapshot) -> tuple[float, float]:
        """Return the total energy and the potential energy [J]."""
        potential = sum(float(law.potential_energy(now).sum()) for law in self._stores)
        if self._springs:
            potential += self._springs.energy(now)
        return float(
            kinetic_energy(self._scene.mass, self._scene.moment, now).sum()
        ) + potential, potential

    def add_correction(
        self, now: Snapshot, contacts: Contacts, drift_velocity: Array | None
    ) -> None:
        """Add the energy from the correction of overlaps since the last observation.

        `drift_velocity`, (n, 3), are the velocities of the last drift [m/s, rad/s]; None if there
        were several.
        """
        last, self._last = self._last, now
        if drift_velocity is None or not len(contacts.bodies):
            return
        if now.t - last.t > 1.5 * self._dt:  # the steps between are unknown
            self.correction += self._unseen_correction
            self._unseen_correction = 0.0
            return
        displacement = now.position - last.position - drift_velocity[:, :2] * self._dt
        # checked in each step: a tenth of the rest
        if np.vdot(displacement, displacement) <= self._negligible_square:
            return
        touching = np.zeros(len(self._scene.mass), dtype=bool)
        touching[contacts.bodies] = True
        work = -np.sum(self._acceleration(now, self._laws)[:, :2] * displacement, axis=1)
        self.correction += max(float(self._scene.mass @ np.where(touching, work, 0.0)), 0.0)

    def unexplained_energy(self, now: Snapshot) -> float:
        """Return the unexplained energy [J].

        It is 0 within the allowed oscillation. The reference is the least energy that two
        observations in a row did not exceed, as a jerk can hide energy from one.
        """
        energy, potential = self.energies(now)
        self._min_potential = min(self._min_potential, potential)
        passive_energy = energy - self.correction
        self._min_energy = min(self._min_energy, max(passive_energy, self._previous_energy))
        self._previous_energy = passive_energy
        available = self._min_energy + self.correction - self._min_potential + self.negligible
        unexplained = passive_energy - self._min_energy
        return 0.0 if unexplained <= available * self._oscillation else unexplained

    def _acceleration(self, now: Snapshot, laws: "Sequence[Law]") -> Array:
        """Return the accelerations by some laws: (n, 3) [m/s², rad/s²]."""
        wrench = np.zeros((len(self._scene.mass), 3))
        motion = Instant.of(now)
        for law in laws:
            law.add(motion, wrench)
        return np.asarray(wrench * self._scene.inverse_mass)


def _rows(springs: "Sequence[SpringForce]") -> "SpringRows":
    from sandbox.physics.forces.spring import SpringRows  # few scenes need it

    return SpringRows(springs)


def _extent(scene: Scene, start: Snapshot, thickness: Array) -> float:
    """Return the width of a scene, the most that the correction of overlaps can lift [m]."""
    if not (moving := scene.mass > 0).any():
        return 0.0
    return float(np.ptp(start.position[moving], axis=0).max() + thickness.max())


class DrivenAudit:
    """Checks every observed step of a run with energy input, such as a world.

    `negligible` is an energy that is negligible in the scene [J], and `oscillation` the relative
    oscillation of energy that the scheme allows. If `always_open`, the books stay open, to detect
    slow growth, oscillation by oscillation.
    """

    def __init__(
        self, run: Recorded, negligible: float, oscillation: float, always_open: bool
    ) -> None:
        self._run = run
        self._negligible = negligible
        self._oscillation = oscillation
        self._is_always_open = always_open
        self._kinetic, self._max_kinetic = 0.0, negligible
        self._books: Ledger | None = None
        self._opening_correction = 0.0  # before the books were opened
        # the energy at their opening, and the smallest potential energy since
        self._opening_energy = self._min_potential = 0.0

    def unexplained_energy(self, now: Snapshot, velocity: Array, correction: float) -> float:
        """Return the unexplained energy in a row of steps that change much [J].

        It is 0 within the allowed oscillation, and not finite if the kinetic energy is not.
        `velocity`, (n, 3), are the velocities at the beginning of the last kick [m/s,
        rad/s]; `correction` is the energy from the correction of overlaps since the start
        [J].
        """
        scene = self._run.scene
        kinetic = float(kinetic_energy(scene.mass, scene.moment, now).sum())
        if not isfinite(kinetic):
            return kinetic
        self._max_kinetic = max(kinetic, self._max_kinetic)
        large_change = abs(kinetic - self._kinetic) > MUCH * self._max_kinetic
        previous_kinetic, self._kinetic = self._kinetic, kinetic
        if not (large_change or self._is_always_open):
            self._books = None
            self._opening_correction = correction
            return 0.0
        if self._books is None or self._books.steps != self._run.last.steps - 1:
            self._books = Ledger(self._run, velocity)
            balance = self._books.balance
            self._min_potential = _potential(balance)
            # an event in the last drift may have stopped bodies before the books begin
            self._opening_energy = max(balance.energy, previous_kinetic + self._min_potential)
        self._books.note()
        return self._unexplained(self._books.balance, correction - self._opening_correction)

    def _unexplained(self, balance: Balance, correction: float) -> float:
        self._min_potential = min(self._min_potential, _potential(balance))
        put_in = sum(max(work, 0.0) for work in balance.work.values())
        available = (
            self._opening_energy - self._min_potential + put_in + correction + self._negligible
        )
        # where only losses belong
        negative_losses = sum(max(-loss, 0.0) for loss in balance.loss.values())
        unexplained = balance.unexplained - correction + negative_losses
        return unexplained if unexplained > available * self._oscillation else 0.0


def _potential(balance: Balance) -> float:
    return sum(balance.potential.values())
