"""Detects unexplained energy in scenes without energy input.

There, energy can grow for two reasons only: the steps are too coarse, or the correction of overlaps
has lifted a body. The latter is visible: the displacement of the body is not its velocity times the
drift. So the energy can be checked at no cost, and any other growth is unexplained.
"""

from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.scene.scene import Scene
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


class Gains:
    """Detects energy without a cause, from the state of a scene at the start; n bodies.

    `thickness`, (n,), is that of the bodies, 0 for lines [m]; `swing` is the relative oscillation
    of a spring's energy with leapfrog, and `rate` the steps per second [Hz]. `least` is an energy
    that is negligible in the scene, and `lifted` the energy from the correction of overlaps so
    far [J].
    """

    def __init__(
        self, scene: Scene, start: Snapshot, thickness: Array, swing: float, rate: float
    ) -> None:
        self._scene, self._swing, self._dt = scene, swing, 1 / rate
        self._laws = (*([scene.gravity] if scene.gravity else []), *scene.laws)
        stores = {id(law): law for law in self._laws if law.effect.book == "potential"}
        springs = (spring for spring in scene.joints.springs.values() if spring.is_plain)
        plain = [spring for spring in springs if stores.pop(id(spring), None)]
        self._stores, self._springs = [*stores.values()], _rows(plain) if plain else None
        energy, self._lowest = self.energies(start)
        self._before = self._level = energy
        self._last = start
        strength = np.hypot(*self._acceleration(start, self._laws)[:, :2].T)
        rise = strength * UNNOTICED * thickness + (FALLS * strength * self._dt) ** 2 / 2
        self.least = float(scene.mass @ rise) + ROUNDING * abs(energy - self._lowest)
        shift = MOVED * (1 + np.abs(start.position).max(initial=0.0))  # the precision of joints
        self.least += float(scene.mass.sum()) * (shift * rate) ** 2 / 2
        # of forces in balance each stores energy, which is known as well as positions are
        alone = (np.hypot(*self._acceleration(start, [law])[:, :2].T) for law in self._laws)
        self.least += float(scene.mass @ sum(alone, np.zeros_like(scene.mass))) * shift
        self._coarse = float(scene.mass @ strength) * _extent(scene, start, thickness)
        if scene.joints.own:  # pymunk's own joints drift, and their correction lifts bodies, too
            self.least += self._coarse
        self._still = float(shift * shift)
        self.lifted = 0.0

    def energies(self, now: Snapshot) -> tuple[float, float]:
        """Return the total energy and the potential energy [J]."""
        stored = sum(float(law.potential_energy(now).sum()) for law in self._stores)
        if self._springs:
            stored += self._springs.stored(now)
        return float(
            kinetic_energy(self._scene.mass, self._scene.moment, now).sum()
        ) + stored, stored

    def follow(self, now: Snapshot, contacts: Contacts, before: Array | None) -> None:
        """Add the energy from the correction of overlaps since the last observation.

        `before`, (n, 3), are the velocities of the last drift [m/s, rad/s]; None if there were
        several.
        """
        last, self._last = self._last, now
        if before is None or not len(contacts.bodies):
            return
        if now.t - last.t > 1.5 * self._dt:  # the steps between are unknown
            self.lifted, self._coarse = self.lifted + self._coarse, 0.0
            return
        way = now.position - last.position - before[:, :2] * self._dt
        if np.vdot(way, way) <= self._still:  # checked in each step: a tenth of the rest
            return
        touching = np.zeros(len(self._scene.mass), dtype=bool)
        touching[contacts.bodies] = True
        against = -np.sum(self._acceleration(now, self._laws)[:, :2] * way, axis=1)
        self.lifted += max(float(self._scene.mass @ np.where(touching, against, 0.0)), 0.0)

    def look(self, now: Snapshot) -> float:
        """Return the unexplained energy [J].

        It is 0 within the allowed oscillation. The reference is the least energy that two
        observations in a row did not exceed, as a jerk can hide energy from one.
        """
        energy, stored = self.energies(now)
        self._lowest = min(self._lowest, stored)
        had = energy - self.lifted
        self._level = min(self._level, max(had, self._before))
        self._before = had
        there_was = self._level + self.lifted - self._lowest + self.least
        gained = had - self._level
        return 0.0 if gained <= there_was * self._swing else gained

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
