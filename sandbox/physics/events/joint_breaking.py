"""Joints that break under an impact.

What is rigid has no finite force where it is jerked taut or struck: it takes an impulse in no time.
A joint that breaks at a force therefore breaks before it has given any, and what it held goes on
as if it had not been there. So a kick in which the force of a joint leaps beyond what it bears is
solved again without that joint. An impulse counts as the force that gives it within a step, so that
the rate decides what is a blow: a joint bears an impulse that it could give in one step.

A rope that is caught in a drift is stopped in the kick before it and in the one after. It is the
whole jerk that counts, J = m u, wherever in the drift that is. Of it the first kick gives the share
(u − u')/u, with the rates u and u' at which the rope grows longer before it and after.

Springs know their force at any time, and know no blows.
"""

from collections.abc import Mapping

import numpy as np

from sandbox.model.acting_events import breaking
from sandbox.model.expressions import Array
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.joints.joint_changes import let_go
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.kick import Kick, Work

SUDDEN = 0.5
"""By how much of what a joint bears its force grows within a step where that is a blow. What grows
less is a force that rises, and found within the drift."""


class JointBreaking:
    """Solves the joints of a scene in a kick, and once more without those that a blow breaks.

    Parameters
    ----------
    scene
        Whose joints.
    joints
        Those that are solved together.
    borne
        The force at which those break that do, by name [N].
    solve
        Solves all joints, from the velocities that pymunk leaves.
    """

    def __init__(
        self, scene: Scene, joints: ExactJoints, borne: Mapping[str, float], solve: Work
    ) -> None:
        self._scene, self._joints, self._solve = scene, joints, solve
        self._borne = {name: load for name, load in borne.items() if name in joints.names}

    def __call__(self, kick: Kick) -> None:
        """Take a kick; one that is only tried, of bodies that are held, breaks nothing."""
        batch, before = self._scene.batch, self._forces()
        velocity = batch.velocity()
        self._solve(kick)
        while kick.start is None and (broken := self._broken(before, velocity)):
            self._break(broken, kick.t)
            batch.set_velocity(velocity)
            self._solve(kick)

    def _forces(self) -> dict[str, float]:
        """Return the size of the force of each joint that can break and has not [N]."""
        whole = self._borne.keys() - self._scene.joints.cut.keys()
        return {name: abs(self._joints.force(name)) for name in self._borne if name in whole}

    def _broken(self, before: Mapping[str, float], velocity: Array) -> str | None:
        """Return the joint that a blow takes furthest beyond what it bears, if there is one.

        Parameters
        ----------
        before
            The forces in the last kick [N].
        velocity
            (n, 3), the velocities before the joints are solved [m/s, rad/s].
        """
        found: dict[str, float] = {}
        for name, force in self._forces().items():
            whole = force if before[name] else force * self._jerk(name, velocity)
            if whole >= self._borne[name] and whole - before[name] > SUDDEN * self._borne[name]:
                found[name] = whole / self._borne[name]
        return max(found, key=lambda name: found[name], default=None)

    def _jerk(self, name: str, velocity: Array) -> float:
        """Return how many times as large the whole jerk is as what a kick has given of it."""
        row = np.array([joint == name for joint in self._joints.names], dtype=bool)
        along = self._joints.jacobian()[row]
        now = self._scene.batch.velocity()
        grew, grows = (float(np.max(np.sum(along * v, axis=(1, 2)))) for v in (velocity, now))
        return grew / (grew - grows) if grew > grows > 0 else 1.0

    def _break(self, name: str, t: float) -> None:
        scene = self._scene
        let_go(scene.joints, name, t)
        scene.happened[breaking(name)] = t
        if scene.direct:
            scene.direct.relay()
