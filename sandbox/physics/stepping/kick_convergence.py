"""Kicks that are repeated until contacts and strings have converged.

pymunk solves contacts and then strings, in turn, so one kick leaves a small residual. Each
repetition begins with the same velocities, and with the impulses of the one before.
"""

from collections.abc import Callable, Sequence
from math import inf

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.cancellation_points import cancellation_point
from sandbox.physics.state.kick_context import Kick

MAX_KICKS = 500
"""The most repetitions of a kick."""

PATIENCE = 50
"""The number of kicks without convergence after which the sweeps of the solver are doubled."""

UNSETTLED = 1000
"""Changes of velocities above this multiple of rounding count as not converged."""

LULL = 10
"""If a small change has not halved over this many kicks, it is rounding that cycles."""

DIRECT_LULL = 2
"""The same for the direct solver: only rounding is left after the first kick, and each repetition
is costly where bodies land in the drift, as it locates all landings again."""

MAX_SWEEPS = 5000
"""The largest product of the sweeps of a kick and the pairs in contact: it bounds the time."""


class KickRepetition:
    """Repeats kicks of the n bodies of a scene, which are held in place.

    `positions` tells whether contacts are solved for the positions after the drift, not for
    velocities; `is_unsettled`, whether contacts and strings did not converge in the last
    repetition.
    """

    def __init__(self, scene: Scene, *, positions: bool) -> None:
        self._space, self._batch, self._solves_positions = (scene.space, scene.batch, positions)
        self._stall_length = DIRECT_LULL if scene.direct else LULL
        self._bodies = [b for b in scene.bodies.values() if b.body_type != pymunk.Body.STATIC]
        self.is_unsettled = False

    def repeat(self, once: Callable[[], Array], kick: Kick, acceleration: Array) -> Array:
        """Repeat a kick, and return the velocities after the last one: (n, 3).

        `once` applies the kick, to the same velocities each time, and returns those after it;
        `kick` and `acceleration` are those of `KicksWithoutDrift.kick`.
        """
        rounding, cyclic_rounding = self._tolerances(kick, acceleration)
        sweeps, after = self._space.iterations, once()
        changes = [inf]
        for count in range(1, MAX_KICKS):
            cancellation_point()
            previous, after = after, once()
            changes.append(float(np.abs(after - previous).max(initial=0.0)))
            if changes[-1] <= rounding or self._is_cycling(
                changes[-2 * self._stall_length :], cyclic_rounding
            ):
                break
            if count % PATIENCE == PATIENCE - 1 and changes[-1] > cyclic_rounding:
                most_sweeps = MAX_SWEEPS // max(len(self._batch.contacts().bodies), 1)
                self._space.iterations = max(min(2 * self._space.iterations, most_sweeps), sweeps)
        self._space.iterations = sweeps
        self.is_unsettled = changes[-1] > cyclic_rounding
        return after

    def _tolerances(self, kick: Kick, acceleration: Array) -> tuple[float, float]:
        """Return the changes of velocities due to rounding, and due to cyclic rounding."""
        assert kick.start is not None
        velocity_change = kick.length * np.abs(acceleration).max(initial=0.0)
        rounding = 1e-15 * float(velocity_change or np.abs(kick.start).max(initial=0.0))
        cyclic_rounding = UNSETTLED * rounding
        if self._solves_positions:
            from sandbox.physics.contacts.direct.solving.velocity_rounding import (
                spread,
                velocity_rounding,
            )

            residual = velocity_rounding(self._batch.state()[:, :3], self._bodies, kick.drift)
            cyclic_rounding = max(cyclic_rounding * spread(self._bodies), residual)
        return rounding, cyclic_rounding

    def _is_cycling(self, changes: Sequence[float], cyclic_rounding: float) -> bool:
        """Return whether the changes are near rounding, and no longer decrease."""
        earlier, latest = changes[: self._stall_length], changes[self._stall_length :]
        return (
            len(latest) == self._stall_length
            and max(latest) <= cyclic_rounding
            and min(latest) >= min(earlier) / 2
        )
