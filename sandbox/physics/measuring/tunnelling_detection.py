"""Bodies that moved further than their own width in a step, where only steps see impacts."""

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from sandbox.physics.guarding.least_step_rate import RateBound
    from sandbox.physics.stepping.world import World


class HighestSpeeds:
    """The highest speeds of the bodies of a world, which may have passed through others; n bodies.

    They are noted only if impacts, except those of `located` bodies, are noticed at steps alone.
    """

    def __init__(self, world: "World") -> None:
        self._world, scene = world, world.scene
        contact = world.level.effects.contact
        self._counts = bool(contact and not (scene.direct or scene.sequence))
        self._speeds = np.zeros(len(scene.bodies))  # m/s

    def note(self, states: Snapshot) -> None:
        """Note some states; the first axis of each array is time."""
        if self._counts:
            speeds = np.hypot(states.velocity[..., 0], states.velocity[..., 1])
            self._speeds = np.maximum(self._speeds, speeds.max(axis=0))

    @property
    def bounds(self) -> "tuple[RateBound, ...]":
        """The bodies that may have passed through others, with the rates that prevent it."""
        world, contact = self._world, self._world.level.effects.contact
        if not (contact and self._counts):
            return ()
        from sandbox.physics.guarding.least_step_rate import speed_bounds

        too_fast = self._speeds > world.stepping.rate * self._widths
        speeds = np.where(too_fast, self._speeds, 0.0)
        bounds = speed_bounds(world.scene, speeds, self._widths, contact.located or ())
        return tuple(sorted(bounds))[::-1]

    @cached_property
    def _widths(self) -> Array:
        """The smallest widths, (n,) [m]; to find them takes as long as a frame."""
        from sandbox.physics.guarding.least_step_rate import widths

        return widths(self._world.scene)
