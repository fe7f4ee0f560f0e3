"""What sweeps of pymunk's solver leave unbalanced where bodies rest on each other.

After a kick whose contact forces are all found, no two touching bodies approach each other. Sweeps
stop before that: each contact of a pile still closes with a share of the speed that gravity and
other forces give in a step, and so what should rest creeps and leans. Measured, of boxes dropped
onto each other by a centimetre: 6e-2 in a column of 5, 0.2 in columns of 20; 1e-13 if solved
directly.
"""

from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.impacts.contact_kinematics import point_velocity

if TYPE_CHECKING:
    from sandbox.physics.stepping.world import World

EVERY = 8
"""The steps from one look to the next."""

NOTICED = 1e-2
"""From this share on a run counts as unbalanced. One body on a floor has less."""


class Unbalanced:
    """Watches the contacts of a world that are left to sweeps; n bodies."""

    def __init__(self, world: "World") -> None:
        self._world, scene = world, world.scene
        contact, stepping = world.level.effects.contact, world.stepping
        swept = contact is not None and not (scene.direct or scene.sequence or stepping.is_stock)
        self._is_movable = scene.mass > 0
        self._is_swept = swept and np.count_nonzero(self._is_movable) > 1
        self._sum, self._samples, self._steps = 0.0, 0, 0

    @property
    def fraction(self) -> float:
        """The mean share of the speed that forces give in a step, with which contacts close.

        It is the mean over all looks at which a body rested on another that moves.
        """
        return self._sum / self._samples if self._samples else 0.0

    def note(self) -> None:
        """Look at the contacts of the world's last step, at every eighth step."""
        if not self._is_swept:
            return
        self._steps += 1
        contacts = self._world.contacts
        if self._steps % EVERY or not len(contacts.bodies):
            return
        persistent = ~contacts.first & (contacts.normal > 0)
        speed_per_step = self._world.dt * float(
            np.hypot(*self._world.last.law_acceleration[:, :2].T).max()
        )
        a, b = contacts.bodies.T
        if not (speed_per_step and (persistent & self._is_movable[a] & self._is_movable[b]).any()):
            return
        self._sum += float(self._approach_speed()[persistent].mean()) / speed_per_step
        self._samples += 1

    def _approach_speed(self) -> Array:
        """Return how fast the two bodies of each contact approach: (k,) [m/s]."""
        contacts, position = self._world.contacts, self._world.snapshot.position
        velocity, (a, b) = self._world.scene.batch.velocity(), contacts.bodies.T
        velocities = (
            point_velocity(velocity[b], at - position[b])
            - point_velocity(velocity[a], at - position[a])
            for at in np.moveaxis(contacts.points, 1, 0)
        )
        separation_speeds = [np.sum(point * contacts.direction, axis=1) for point in velocities]
        slowest = np.where(
            contacts.touches > 1, np.minimum(*separation_speeds), separation_speeds[0]
        )
        return np.maximum(-slowest, 0.0)
