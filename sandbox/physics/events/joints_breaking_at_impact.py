"""Joints that break under an impact.

At an impact, rigid joints transmit an impulse in no time, so their force is not finite. A joint
with a breaking force therefore breaks before it has transmitted any impulse, and its bodies go on
as if it had not been there. So if the force of a joint jumps beyond its limit in a kick, the kick
is solved again without that joint. An impulse counts as the force that would give it within one
step, so the rate decides what counts as an impact: a joint bears the impulse that its breaking
force gives in one step.

A rope that becomes taut within a drift is stopped partly in the kick before it and partly in the
kick after it. The whole jerk J = m u counts, wherever in the drift it happens. The first kick gives
the share (u − u')/u of it, where u and u' are the rates of extension before and after that kick.

Bodies that land within a drift strike in the middle of it. If a landing breaks a joint, the joint
breaks at the step before it, up to a step too early: the kick and its drift are solved again.

A joint that catches within a drift, or a body that bounces off a stop, is an impact at its own
time. It breaks joints by the same rule, and is solved again without each joint that it breaks,
which may be the joint that catches.

The force of a spring is known at any time, so springs need none of this.
"""

from collections.abc import Callable, Mapping

import numpy as np

from sandbox.model.events import breaking_event
from sandbox.model.expressions import Array
from sandbox.physics.events.joint_impacts import Jolt
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.joints.joint_changes import let_go
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.kick_context import Kick, Work

SUDDEN = 0.5
"""A joint takes a blow if its force grows, within a step, by more than this share of what it bears.
Slower growth is a rising force, and is located within the drift."""


class JointBreaking:
    """Solves the joints of a scene in a kick, and again without each joint that a blow breaks.

    `joints` are solved together by `solve`, from the velocities that pymunk leaves;
    `breaking_loads` is the breaking force of each joint that has one, by name [N], and `dt` the
    time step [s].
    """

    def __init__(
        self,
        scene: Scene,
        joints: ExactJoints,
        breaking_loads: Mapping[str, float],
        dt: float,
        solve: Work,
    ) -> None:
        self._scene, self._joints, self._solve = scene, joints, solve
        self._breaking_loads, self._dt = breaking_loads, dt

    def __call__(self, kick: Kick) -> None:
        """Solve a kick. A trial kick, of bodies that are held in place, breaks nothing."""
        batch, before = self._scene.batch, self._forces()
        velocity = batch.velocity()
        self._solve(kick)
        while kick.start is None and (broken := self._broken(before, velocity)):
            _break(self._scene, broken, kick.t)
            batch.set_velocity(velocity)
            if self._scene.direct:
                self._scene.direct.drifts.take_back()
            self._solve(kick)

    def _forces(self) -> dict[str, float]:
        """Return the size of the force of each intact joint that can break [N]."""
        holding = self._joints.equations.pulling
        return {
            name: abs(self._joints.force(name)) for name in self._breaking_loads if name in holding
        }

    def _broken(self, before: Mapping[str, float], velocity: Array) -> str | None:
        """Return the joint that a blow overloads most, from the last forces [N]; else None."""
        found: dict[str, float] = {}
        for name, force in self._forces().items():
            whole = force if before[name] else force * self._jerk(name, velocity)
            if (
                whole >= self._breaking_loads[name]
                and whole - before[name] > SUDDEN * self._breaking_loads[name]
            ):
                found[name] = whole / self._breaking_loads[name]
        for name, share in self._landing_fractions().items():
            if share >= 1:
                found[name] = max(share, found.get(name, 0.0))
        return max(found, key=lambda name: found[name], default=None)

    def _landing_fractions(self) -> dict[str, float]:
        """Return the impulses of landings in the coming drift, as shares of what joints bear."""
        divided = self._scene.direct.drifts.drift_after if self._scene.direct else None
        if not divided:
            return {}
        at_once = [
            one.stage.joint_impulses for one in divided.kicks_between if one.stage.duration == 0
        ]
        if not at_once:
            return {}
        return _load_fractions(self._scene, self._breaking_loads, self._dt, np.sum(at_once, axis=0))

    def _jerk(self, name: str, velocity: Array) -> float:
        """Return the ratio of the whole jerk to the share of it that a kick has given."""
        row = np.array([joint == name for joint in self._joints.names], dtype=bool)
        along = self._joints.jacobian()[row]
        now = self._scene.batch.velocity()
        grew, grows = (float(np.max(np.sum(along * v, axis=(1, 2)))) for v in (velocity, now))
        return grew / (grew - grows) if grew > grows > 0 else 1.0


def broken_jolt(
    scene: Scene, t: float, breaking_loads: Mapping[str, float], dt: float, jolt: Callable[[], Jolt]
) -> Jolt:
    """Solve an impact of joints at a time t, in a step of dt [s], without those that it breaks.

    `breaking_loads` is the breaking force of each joint that has one, by name [N]. `jolt` finds the
    impulses; it is called again after each joint that breaks. Raises `JointFailure` or `NoForces`
    if no such impulses exist.
    """
    found = jolt()
    while broken := _overloaded(scene, breaking_loads, dt, found):
        _break(scene, broken, t)
        found = jolt()
    return found


def _overloaded(
    scene: Scene, breaking_loads: Mapping[str, float], dt: float, found: Jolt
) -> str | None:
    """Return the joint that an impact overloads most; None if there is none."""
    shares = _load_fractions(scene, breaking_loads, dt, found.joint_impulses.tension)
    most = max(shares, key=lambda name: shares[name], default=None)
    return most if most is not None and shares[most] >= 1 else None


def _load_fractions(
    scene: Scene, breaking_loads: Mapping[str, float], dt: float, impulses: Array
) -> dict[str, float]:
    """Return the impulses of joints, from those of all equations, as shares of what they bear."""
    together = scene.joints.together
    pulling = together.equations.pulling if together else {}
    return {
        name: float(np.linalg.norm(impulses[pulling[name]])) / (dt * load)
        for name, load in breaking_loads.items()
        if name in pulling
    }


def _break(scene: Scene, name: str, t: float) -> None:
    let_go(scene.joints, name, t)
    scene.event_times[breaking_event(name)] = t
    if scene.direct:
        scene.direct.relay()
