"""Forces that depend on velocities, in a drift that impacts divide into flights.

Leapfrog drifts with the forces of the kick before, and the kick after it gives half of what they
have changed by. An impact changes velocities at once, and with them these forces. So each flight
between two impacts is such a step of its own, as long as it lasts (velocity Verlet): it begins with
the forces at its first velocity, and ends with half of their change in it. What depends on
positions stays as it was in the kick before the drift.
"""

from collections.abc import Callable, Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.time_of_impact import Hit, Path
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.forces.law import Law
from sandbox.physics.forces.velocity_rotation import quarter_turn
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.motion import Reading, momentum


def of_velocity(scene: Scene) -> tuple[Law, ...]:
    """Return the laws of a scene that depend on velocities."""
    return tuple(law for law in scene.laws if law.effect.depends_on_velocity)


class FlightForces:
    """The forces of l laws on the n bodies of a scene, and those that turn velocities, on a path.

    The last kick saw the motion `reading`. `momentum`, (3,), is that by all forces in the flights
    that have ended [kg m/s, kg m²/s].
    """

    def __init__(self, scene: Scene, laws: tuple[Law, ...], reading: Reading, path: Path) -> None:
        self._laws, self._reading, self._path = laws, reading, path
        self._inertia, self._inverse_mass = scene.inertia, scene.inverse_mass
        self._rotations = scene.rotations
        self._at_rest = np.zeros((len(laws) + len(scene.rotations), *scene.inertia.shape))
        self._at_rest = self._forces(np.zeros_like(scene.inertia))
        self._first = self._now = self._forces(reading.state[:, 3:])
        self._start = path.velocity.copy(), path.acceleration.copy()
        self._works, self.momentum = np.zeros(len(self._at_rest)), np.zeros(3)

    @property
    def first_acceleration(self) -> Array:
        """What the velocities contributed to the accelerations in the last kick: (n, 3)."""
        return np.asarray(self._first.sum(axis=0) * self._inverse_mass)

    @property
    def change(self) -> Array:
        """How the forces have changed in the drift: (n, 3) [N, N m]."""
        return np.asarray((self._now - self._first).sum(axis=0))

    @property
    def law_works(self) -> tuple[tuple[Law, float], ...]:
        """The works of the laws, beyond those in the halves of the kicks at its ends [J]."""
        return tuple(zip(self._laws, self._works.tolist(), strict=False))

    def _forces(self, velocity: Array) -> Array:
        """Return the forces beyond those on bodies at rest, (n, 3) each, by laws and rotations.

        `velocity`, (n, 3), are the velocities [m/s, rad/s].
        """
        wrenches = np.zeros_like(self._at_rest)
        state = np.concatenate((self._reading.state[:, :3], velocity), axis=1)
        motion, count = Reading(self._reading.t, state), len(self._laws)
        for law, wrench in zip(self._laws, wrenches, strict=False):
            law.add(motion, wrench)
        for turn, wrench in zip(self._rotations, wrenches[count:], strict=True):
            turned = quarter_turn(velocity)
            wrench[:, :2] = self._inertia[:, :2] * turn.rate(motion)[:, None] * turned
        return np.asarray(wrenches - self._at_rest)

    def divide(self, t: float, hits: Sequence[Hit], jump: Callable[[], Array]) -> Booleans:
        """End and begin flights where bodies hit each other, at a time [s]; return whose: (n,).

        `jump` returns the jumps of velocities in the impact, (n, 3) [m/s, rad/s].
        """
        hit = np.zeros(len(self._inertia), dtype=bool)
        hit[[body for one in hits for body in one.bodies]] = True
        bodies = self._reached(hit)
        self._end(t, bodies)
        self._begin(self._path.at(t)[1] + jump(), bodies)
        return bodies

    def finish(self, dt: float) -> None:
        """End all flights with the drift of dt [s]; the kick after it begins with their forces."""
        path, struck = self._path, self._path.struck.copy()
        self._end(dt, struck)
        self._begin(path.velocity, struck)
        (start, first), end = self._start, path.velocity
        before = 2 * start + first * (dt / 2)  # twice the mean velocity from the step to the middle
        after = 2 * end - path.acceleration * (dt / 2)
        halves = (self._first * before + self._now * after) * struck[:, None]
        self._works -= halves.sum(axis=(1, 2)) * (dt / 4)

    def _reached(self, bodies: Booleans) -> Booleans:
        """Return some bodies, (n,), and those on which forces change with the velocities of them.

        They get new forces together, so that those between two bodies stay opposite.
        """
        while True:
            probe = self._reading.state[:, 3:] + bodies[:, None]
            changed = (self._forces(probe) != self._first).any(axis=(0, 2))
            more = (bodies | changed) & (self._inertia[:, 0] > 0)
            if not (more & ~bodies).any():
                return more
            bodies = more

    def _end(self, t: float, bodies: Booleans) -> None:
        """End the flights of some bodies, (n,), at a time [s], with half of the change of force."""
        path, some = self._path, bodies[:, None]
        pose, velocity = path.at(t)
        half = np.where(bodies, (t - path.start) / 2, 0.0)[:, None]
        middle = path.pose + path.velocity * half
        self.momentum += momentum(self._inertia * path.acceleration * (2 * half), middle)
        impulses = (self._forces(velocity) - self._now) * half
        jump = impulses.sum(axis=0) * self._inverse_mass
        moved = np.where(some, pose - path.pose, 0.0)
        done = self._now * moved + impulses * (velocity + jump / 2)
        self._works += done.sum(axis=(1, 2))
        self.momentum += momentum(self._inertia * jump, pose)
        path.turn(t, jump, bodies)

    def _begin(self, velocity: Array, bodies: Booleans) -> None:
        """Begin the next flights of some bodies, (n,), at velocities (n, 3) [m/s, rad/s]."""
        forces = np.where(bodies[:, None], self._forces(velocity), self._now)
        self._path.acceleration += (forces - self._now).sum(axis=0) * self._inverse_mass
        self._now = forces
