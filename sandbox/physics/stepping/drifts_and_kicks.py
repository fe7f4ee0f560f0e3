"""The drifts and kicks of a scene: pymunk's own step, and the Python calls in it.

pymunk's step drifts the positions with the velocities of the previous step, then kicks the
velocities. Every call in a kick gets the kick as its argument: see `Kick`.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.engine.private_handles import gravity_setter, stepper
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.scene.substep import Substep, once
from sandbox.physics.state.kick_context import Clock, Kick, Work
from sandbox.physics.stepping.applied_forces import Forces
from sandbox.physics.stepping.kicks_without_drift import KicksWithoutDrift

if TYPE_CHECKING:
    from sandbox.physics.engine.step_hook import Hook


class Kicks:
    """Takes the drifts and kicks of a scene in steps of dt [s]; n bodies.

    `has_contacts` tells whether the level has contacts. `clock` counts the steps; the caller counts
    a step before taking it. `take` takes the last drift of a step and its kick; `parts` are all its
    drifts and kicks, see `compose`. `trail` has positions and velocities after each part but the
    last, (n, 6) each; None unless kept. `settling` repeats kicks of held bodies until contacts
    converge; None without contacts.
    """

    def __init__(self, scene: Scene, forces: Forces, dt: float, *, has_contacts: bool) -> None:
        self.clock, self.forces, self._scene = Clock(dt), forces, scene
        self.trail: list[Array] | None = None
        self._space, self._joints = scene.space, scene.joints
        self._drift_and_kick, self._set_gravity = stepper(self._space), gravity_setter(self._space)
        self._hook: Hook | None = None
        positions = scene.direct is not None
        self._held_kicks = KicksWithoutDrift(
            scene, self.finish, has_contacts=has_contacts, positions=positions
        )
        self.settling = self._held_kicks.settling
        self.compose([once(dt)])

    def compose(self, parts: Sequence[Substep]) -> None:
        """Compose all further steps of these drifts and kicks."""
        self.parts, self._last_part = parts, parts[-1]
        kicks = [
            Kick(self.clock, part.ahead, part.kick, part.following, scale=part.scale)
            for part in parts
        ]
        kicks[-1] = replace(kicks[-1], ahead=0)  # the step is counted before its last kick
        *self._take_leading, self.take = map(self._with_calls, parts, kicks)
        field = self._scene.gravity
        x, y = field.acceleration if field else (0.0, 0.0)
        self._gravity = [(x * part.scale, y * part.scale) for part in parts]
        if self._joints.together:
            self._joints.together.parts = len(parts)

    def add_calls(self, in_kick: Sequence[Work], after_kick: Sequence[Work]) -> None:
        """Call Python in all further kicks: before pymunk's kick, and after its solver."""
        bodies = self._scene.bodies.values()
        dynamic = next((b for b in bodies if b.body_type == pymunk.Body.DYNAMIC), None)
        if dynamic is not None and (in_kick or after_kick):
            from sandbox.physics.engine.step_hook import Hook

            self._hook = Hook(self._space, dynamic, in_kick, after_kick)
            self.compose(self.parts)

    def _with_calls(self, part: Substep, kick: Kick) -> Callable[[], None]:
        """Return a function that takes the drift and the kick of a part, with Python calls."""
        quietly = partial(self._drift_and_kick, part.drift)
        return self._hook.around(quietly, kick) if self._hook else quietly

    def take_leading_parts(self) -> None:
        """Take all drifts and kicks of a step but the last."""
        if self.trail is not None:
            self.trail = []
        for part, gravity, take in zip(self.parts, self._gravity, self._take_leading, strict=False):
            self._prepare(part, gravity)
            take()
            if self.trail is not None:
                self.trail.append(self._scene.batch.state())
        self._prepare(self._last_part, self._gravity[-1])

    def _prepare(self, part: Substep, gravity: tuple[float, float]) -> None:
        """Set the durations and the gravity of a part of a step."""
        self._joints.time(part.kick, part.following)
        self._set_gravity(gravity)

    def hold(self, *, first: bool = False) -> AbstractContextManager[None]:
        """Hold all bodies in place, between two steps or before the `first`; see `settle`."""
        return self._held_kicks.hold(first=first)

    @contextmanager
    def trial(self) -> Iterator[None]:
        """Hold all bodies for trial kicks, which leave no trace."""
        with self.forces.trial(), self._held_kicks.hold():
            try:
                yield
            finally:
                self._joints.time(self.clock.dt, self.clock.dt)

    def settle(
        self, ahead: float, start: Array, length: float, drift: float, *, at_step: bool = False
    ) -> Array:
        """Kick the held bodies until convergence, and return their velocities: (n, 3).

        `ahead` is the time since the last step, in steps, and `start`, (n, 3), are the velocities
        before the kick [m/s, rad/s]; `length` and `drift` are the lengths of the kick and of the
        drift that would follow [s]. The velocities are those at the time of the kick if `at_step`
        or if `ahead` is 0, else half a kick old.
        """
        ends, at_step = drift / self.clock.dt, at_step or ahead == 0
        kick = Kick(self.clock, ahead, length, drift, ends, start=start, at_step=at_step)
        self._joints.time(length, drift)
        if self._hook:
            self._hook.kick = kick
        return self._held_kicks.kick(kick, self.forces.law_acceleration)

    def begin(self, length: float, start: Array) -> Array:
        """Take the first kick, half the last kick of a step; return the velocities after it."""
        if gravity := self._scene.gravity:
            self._space.gravity = gravity.acceleration
        return self.settle(0, start, length, self._last_part.following)

    def keep_trail(self) -> None:
        """Keep the trail of every step from now on."""
        if self.trail is None:  # another ledger may keep it already
            self.trail = []

    def finish(self) -> None:
        """Complete a kick of pymunk's, and raise errors from it."""
        if self._hook:
            self._hook.finish()

    @property
    def composed(self) -> bool:
        """Whether a step has several drifts and kicks."""
        return len(self.parts) > 1

    @property
    def calls(self) -> int:
        """The number of Python calls in the kicks of a step."""
        return (self._hook.count if self._hook else 0) * len(self.parts)

    def time_calls(self) -> None:
        """Measure the time of these calls from now on."""
        if self._hook:
            self._hook.start_timing()
            self.compose(self.parts)

    @property
    def seconds(self) -> float:
        """The time of these calls since `time_calls` [s]."""
        return self._hook.seconds if self._hook else 0.0
