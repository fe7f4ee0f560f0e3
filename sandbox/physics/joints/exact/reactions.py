"""The reactions of exact joints between two kicks, where impacts change them.

A rod turns with the ball that hangs on it, so the force of a joint acts along its present
direction, not along that of the last kick. An impact changes the force at once: if it stops the
ball, m v² / l vanishes. So after an impact the force is solved for again, to hold the joints from
there on.
"""

from functools import cached_property

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Booleans
from sandbox.physics.joints.exact.shake import ExactJoints


class Grip:
    """The accelerations of n bodies by exact joints from one kick to the next.

    Parameters
    ----------
    joints
        The exact joints of the scene.
    inverse_mass
        (n, 3), the inverse masses and moments of inertia [1/kg, 1/(kg m²)].
    place
        (n, 3), the positions at the kick [m, rad].
    """

    def __init__(self, joints: ExactJoints, inverse_mass: Array, place: Array) -> None:
        self._joints, self._inverse_mass = joints, inverse_mass
        self._tension = joints.tension
        self._place = place

    @cached_property
    def _begun(self) -> Array:
        """The accelerations by the joints at the kick, or right after the last impact: (n, 3)."""
        return self._acceleration(self._place)

    def change(self, place: Array) -> Array:
        """Return the change of accelerations since the kick or last impact, at a place: (n, 3)."""
        begun = self._begun  # first, as `JointSystem` remembers its last look there
        return self._acceleration(place) - begun

    def renew(self, place: Array, velocity: Array, acceleration: Array, struck: Booleans) -> Array:
        """Solve for the forces after an impact, and return the changes of accelerations: (n, 3).

        Parameters
        ----------
        place, velocity
            (n, 3), the positions and velocities right after the impact [m, rad, m/s, rad/s].
        acceleration
            (n, 3), the accelerations before it, with those by joints [m/s², rad/s²].
        struck
            (n,), the bodies that the impact has reached; only these change.

        Raises
        ------
        JointFailure
            If no forces keep the joints.
        """
        tension = self._joints.hold(place, velocity, acceleration - self._begun)
        reached = self._joints.jacobian(place)[:, struck].any(axis=(1, 2))
        self._tension = np.where(reached, tension, self._tension)
        change = np.where(struck[:, None], self.change(place), 0.0)
        self._begun = self._begun + change
        return change

    def _acceleration(self, place: Array) -> Array:
        """Return the accelerations by the joints at given positions: (n, 3)."""
        return self._joints.wrenches(self._tension, self._joints.at(place)) * self._inverse_mass
