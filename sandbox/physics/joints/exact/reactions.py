"""The reactions of exact joints between two kicks, where impacts change them.

A rod turns with the ball that hangs on it, so the force of a joint is taken along its present
direction, not along that of the last kick. An impact changes the force at once: if it stops the
ball, nothing is left of m v² / l. So after an impact the force is found anew, as the one with which
the joints hold from there.
"""

from functools import cached_property

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Booleans
from sandbox.physics.joints.exact.shake import ExactJoints


class Grip:
    """What exact joints do to n bodies from one kick to the next.

    Parameters
    ----------
    joints
        Those of the scene.
    inverse_mass
        (n, 3), what a force or torque is multiplied by to give an acceleration [1/kg, 1/(kg m²)].
    place
        (n, 3), where the bodies are at the kick [m, rad].
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
        """Return how accelerations change from the kick, or the last impact, to a place: (n, 3)."""
        begun = self._begun  # first: that is where joints were looked at last
        return self._acceleration(place) - begun

    def renew(self, place: Array, velocity: Array, acceleration: Array, struck: Booleans) -> Array:
        """Return how the accelerations of those that are struck change by it: (n, 3).

        Parameters
        ----------
        place, velocity
            (n, 3), right after the impact [m, rad, m/s, rad/s].
        acceleration
            (n, 3), the accelerations before it, joints included [m/s², rad/s²].
        struck
            (n,), which bodies it has reached.

        Raises
        ------
        JointFailure
            If joints cannot be kept.
        """
        tension = self._joints.hold(place, velocity, acceleration - self._begun)
        reached = self._joints.jacobian(place)[:, struck].any(axis=(1, 2))
        self._tension = np.where(reached, tension, self._tension)
        change = np.where(struck[:, None], self.change(place), 0.0)
        self._begun = self._begun + change
        return change

    def _acceleration(self, place: Array) -> Array:
        """Return the accelerations by the joints somewhere: (n, 3)."""
        return self._joints.wrenches(self._tension, self._joints.at(place)) * self._inverse_mass
