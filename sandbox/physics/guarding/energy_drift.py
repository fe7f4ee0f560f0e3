"""Unexplained energy in scenes to which nothing gives any.

There energy can grow for two reasons only: the steps are too coarse, or the correction of overlaps
has lifted a body. The second can be seen: the body has not gone where its velocity led in the
drift. So the books stay open at no cost, and what they do not explain has no cause.
"""

from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.motion import Instant, kinetic_energy
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sandbox.physics.forces.spring import SpringForce, SpringRows

UNNOTICED = 1e-2
"""The share of its thickness by which a body may rise: so far the heaviest piles still rock."""

MOVED = 1e-12
"""The share of a place, or of a metre, by which a body must have been moved to be looked at."""

FALLS = 2.0
"""How many steps' fall a body may bounce with where it should rest."""

ROUNDING = 1e-6
"""The share of the energy that there was at first which is nothing beside it."""


class Gains:
    """Looks for energy from nowhere; n bodies.

    Parameters
    ----------
    scene
        What moves.
    start
        Its state at the start.
    thickness
        (n,), how thick the bodies are; 0 of what has no thickness to speak of [m].
    swing
        By how much leapfrog lets the energy of a spring swing.
    rate
        Steps a second [Hz].

    Attributes
    ----------
    least
        An energy that is nothing beside the scene [J].
    lifted
        What taking back overlaps has put in so far [J].
    """

    def __init__(
        self,
        scene: Scene,
        start: Snapshot,
        thickness: Array,
        swing: float,
        rate: float,
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
        acceleration = self._acceleration(start)
        strength = np.hypot(*acceleration[:, :2].T)
        rise = strength * UNNOTICED * thickness + (FALLS * strength * self._dt) ** 2 / 2
        self.least = float(scene.mass @ rise) + ROUNDING * abs(energy - self._lowest)
        shift = MOVED * (1 + np.abs(start.position).max(initial=0.0))  # no joint knows better
        self.least += float(scene.mass.sum()) * (shift * rate) ** 2 / 2
        self._coarse = float(scene.mass @ strength) * _extent(scene, start, thickness)
        if scene.joints.own:  # pymunk's own joints give way, and what takes that back lifts, too
            self.least += self._coarse
        self._still = float(shift * shift)
        self.lifted = 0.0

    def energies(self, now: Snapshot) -> tuple[float, float]:
        """Return the whole energy and what is stored of it [J]."""
        stored = sum(float(law.potential_energy(now).sum()) for law in self._stores)
        if self._springs:
            stored += self._springs.stored(now)
        return float(
            kinetic_energy(self._scene.mass, self._scene.moment, now).sum()
        ) + stored, stored

    def follow(self, now: Snapshot, contacts: Contacts, before: Array | None) -> None:
        """Take note of what taking back overlaps has lifted since the last observation.

        Parameters
        ----------
        now, contacts
            The observation.
        before
            (n, 3), the velocities of the last drift [m/s, rad/s]; None if it had several.
        """
        last, self._last = self._last, now
        if before is None or not len(contacts.bodies):
            return
        if now.t - last.t > 1.5 * self._dt:  # of the steps between nothing is known
            self.lifted, self._coarse = self.lifted + self._coarse, 0.0
            return
        way = now.position - last.position - before[:, :2] * self._dt
        if np.vdot(way, way) <= self._still:  # looked at in each step: a tenth of what follows
            return
        touching = np.zeros(len(self._scene.mass), dtype=bool)
        touching[contacts.bodies] = True
        against = -np.sum(self._acceleration(now)[:, :2] * way, axis=1)
        self.lifted += max(float(self._scene.mass @ np.where(touching, against, 0.0)), 0.0)

    def look(self, now: Snapshot) -> float:
        """Return how much has come from nowhere [J].

        0 if it is no more than the scene could have. What it could have is the least that it had in
        two looks, for a jerk can hide energy from one.
        """
        energy, stored = self.energies(now)
        self._lowest = min(self._lowest, stored)
        had = energy - self.lifted
        self._level = min(self._level, max(had, self._before))
        self._before = had
        there_was = self._level + self.lifted - self._lowest + self.least
        gained = had - self._level
        return 0.0 if gained <= there_was * self._swing else gained

    def _acceleration(self, now: Snapshot) -> Array:
        """Return the accelerations by gravity and laws: (n, 3) [m/s², rad/s²]."""
        wrench = np.zeros((len(self._scene.mass), 3))
        motion = Instant.of(now)
        for law in self._laws:
            law.add(motion, wrench)
        return np.asarray(wrench * self._scene.inverse_mass)


def _rows(springs: "Sequence[SpringForce]") -> "SpringRows":
    from sandbox.physics.forces.spring import SpringRows  # few scenes need it

    return SpringRows(springs)


def _extent(scene: Scene, start: Snapshot, thickness: Array) -> float:
    """Return how wide a scene is: taking back overlaps lifts nothing higher [m]."""
    if not (moving := scene.mass > 0).any():
        return 0.0
    return float(np.ptp(start.position[moving], axis=0).max() + thickness.max())
