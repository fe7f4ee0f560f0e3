"""The plugin that stops a run if a body leaves the grid in which pymunk finds pairs."""

from math import hypot

import numpy as np

from sandbox.model.translatable_message import Message
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.drifts_and_kicks import Kicks
from sandbox.physics.stepping.step_plugin import Plugin, Setup

LOOK = 16
"""The steps between two checks far from the bounds."""

FASTER = 1e4
"""The growth of distances and speeds that impacts and springs cannot reach in so many steps."""


def make(setup: Setup) -> Plugin:
    """Make the plugin."""
    return Plugin(before_drift=GridBounds(setup.scene, setup.kicks).check)


def out_of_bounds(name: str, scene: Scene, t: float) -> SimulationError:
    """Return the message for a body that leaves the grid of a scene at a time [s]."""
    reason = Message(
        "'{name}' is more than {reach:.3g} m from the origin, the limit for so many shapes",
        name=name,
        reach=scene.reach,
    )
    return SimulationError(name, t, reason)


class GridBounds:
    """Checks that all bodies of a scene stay within its grid, beyond which pymunk never returns.

    The scene has so many bodies that pairs are found in a grid.
    """

    def __init__(self, scene: Scene, kicks: Kicks) -> None:
        self._scene, self._kicks = scene, kicks
        self._next_check = 0  # the step of the next check

    def check(self) -> None:
        """Raise `SimulationError` if a body would leave the grid in the coming drift."""
        kicks = self._kicks
        if name := self._leaving_body(kicks.clock.steps, kicks.clock.dt):
            raise out_of_bounds(name, self._scene, kicks.clock.after(0))

    def _leaving_body(self, step: int, drift: float) -> str | None:
        """Return a body that would leave the grid in a drift of a length [s] at a step."""
        if step < self._next_check:
            return None
        extent, reach, field = self._scene.batch.extent(), self._scene.reach, self._scene.gravity
        speed_gain = hypot(*field.acceleration) if field else 0.0
        # laws are unbounded
        if not self._scene.hooked_laws and (extent + speed_gain) * FASTER < reach:
            self._next_check = step + LOOK
            return None
        return None if extent * (1 + drift) < reach else self._outermost(drift)

    def _outermost(self, drift: float) -> str | None:
        state, reach = self._scene.batch.state(), self._scene.reach
        with np.errstate(all="ignore"):  # NaN is reported later, by name
            outside = (np.abs(state[:, :2] + state[:, 3:5] * drift) >= reach).any(axis=1)
        return list(self._scene.bodies)[int(outside.argmax())] if outside.any() else None
