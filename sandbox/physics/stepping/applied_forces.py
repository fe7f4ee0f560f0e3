"""The forces of a scene, given to its bodies before each kick."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.forces.turning import pull, rates
from sandbox.physics.forces.variable_mass import MassFlows
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.motion import Reading


class Forces:
    """Gravity and the force laws of a scene; n bodies.

    Attributes
    ----------
    seen
        What the laws saw in the last kick; None if there are none, or before it.
    older
        (n, 3), the velocities that the last kick began with, by which those at the next are known
        [m/s, rad/s].

    turning
        (n,), how fast the last kick turned velocities [rad/s]; None if nothing does.

    Parameters
    ----------
    scene
        What moves, and the laws.
    pulling
        Joints whose last pull acts from the start of a kick; None if there are none.
    leapfrog
        Whether kicks are half a step from the velocities before them.
    """

    def __init__(self, scene: Scene, pulling: ExactJoints | None, *, leapfrog: bool) -> None:
        self._batch, self._laws, self._share = scene.batch, scene.hooked, scene.share
        self._turns, self._space, self._step = scene.turns, scene.space, scene.step
        self._mass, self._moment, self._inverse = scene.mass, scene.moment, scene.agility
        self._bodies, self._pulling = list(scene.bodies.values()), pulling
        sees = any(law.effect.sees_velocity for law in scene.laws)
        self._guesses = leapfrog and (sees or bool(scene.turns))
        self._field = np.zeros((len(self._bodies), 3))  # acceleration by gravity
        if scene.gravity:
            self._field[scene.mass > 0, :2] = scene.gravity.acceleration
        self._wrench = np.zeros_like(self._field)  # what the laws give in the last kick
        self._agility = scene.agility
        self.older: Array = np.zeros_like(self._field)
        self.turning: Array | None = None
        self.seen: Reading | None = None

    @property
    def acts(self) -> bool:
        """Whether anything has to be given to bodies before a kick."""
        return bool(self._laws or self._turns or self._pulling)

    @property
    def smooth(self) -> Array:
        """The acceleration by gravity and laws in the last kick: (n, 3) [m/s², rad/s²]."""
        return self._field + self._wrench * self._agility

    def start(self, begun: Array, after: Array) -> None:
        """Take note of the first half kick: its velocities before and after it [m/s, rad/s]."""
        if self._guesses:
            self.older = begun + (begun - after)

    @contextmanager
    def tried(self) -> Iterator[None]:
        """Let kicks be tried: what the last one before them saw and gave is known again after."""
        kept = self.older, self.seen, self._wrench
        self._wrench = self._wrench.copy()
        yield
        self.older, self.seen, self._wrench = kept

    def apply(self, t: float, scale: float) -> None:
        """Read all bodies once, add up the laws, and write all forces once.

        Parameters
        ----------
        t
            The time of the kick [s].
        scale
            What the forces are multiplied by.
        """
        held = self._held(scale) if self._turns else None
        self.seen = reading = self._read(t)
        if isinstance(self._share, MassFlows):
            self._weigh(self._share, reading.t)
        wrench = self._wrench
        wrench.fill(0.0)
        for law in self._laws:
            law.add(reading, wrench)
        if held is not None:
            self._turn(reading, wrench, held, self._length(scale))
        if self._pulling:
            wrench = wrench.copy()
            self._pulling.pull(wrench)
        self._batch.set_force(wrench if scale == 1 else wrench * scale)

    def _held(self, scale: float) -> Array:
        """Return what joints and contacts gave each velocity in the last kick: (n, 2) [m/s].

        A kick of another length than a step is the first of a motion, and nothing is known yet.
        """
        if not self._guesses or self._length(scale) != self._step:
            return np.zeros_like(self._field[:, :2])
        gained = self._batch.velocity() - self.older - self.smooth * self._step
        return gained[:, :2]

    def _turn(self, reading: Reading, wrench: Array, held: Array, length: float) -> None:
        """Add what turns velocities in a kick of a length [s], beside all else that acts in it."""
        self.turning = rates(self._turns, reading)
        velocity = self.older[:, :2] if self._guesses else reading.velocity
        agility = self._agility[:, :2]
        others = self._field[:, :2] + wrench[:, :2] * agility + held / length
        pulled = pull(self.turning, velocity, others, length)
        wrench[:, :2] += np.divide(pulled, agility, out=np.zeros_like(pulled), where=agility > 0)

    def _length(self, scale: float) -> float:
        """Return how long the kick is that pymunk is about to give [s]; a step before the first."""
        return scale * (self._space.current_time_step or self._step)

    def _read(self, t: float) -> Reading:
        """Return the motion that the laws see in a kick.

        pymunk's velocities are half a step old. Those at the kick are, to second order, 3/2 of them
        less 1/2 of those another step ago.
        """
        state = self._batch.state()
        if self._guesses:
            velocity = state[:, 3:].copy()
            state[:, 3:] = 1.5 * velocity - 0.5 * self.older
            self.older = velocity
        return Reading(np.asarray(t), state)

    def _weigh(self, share: MassFlows, t: Array) -> None:
        """Give the bodies whose mass changes that of a time [s], for the kick around it."""
        now = share(t)
        for row in share.bodies:
            body = self._bodies[row]
            body.mass = self._mass[row] * now[row]
            if self._moment[row]:
                body.moment = self._moment[row] * now[row]
        self._agility = self._inverse / now[:, None]
