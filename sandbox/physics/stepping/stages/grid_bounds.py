"""The stage that stops bodies from leaving the grid in which pymunk looks for pairs."""

from math import hypot

import numpy as np

from sandbox.model.message import Message
from sandbox.physics.scene.scene import Scene
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.kicks import Kicks
from sandbox.physics.stepping.stage import Setup, Stage

LOOK = 16
"""Steps between two looks at how far out bodies are."""

FASTER = 1e4
"""How many times as far as now, or as fast, none is after so many steps of impacts and springs."""


def make(setup: Setup) -> Stage:
    """Make the stage."""
    return Stage(before_drift=Fence(setup.scene, setup.kicks).look)


def beyond(name: str, scene: Scene, t: float) -> SimulationError:
    """Return the message for a body that leaves the grid of a scene at a time [s]."""
    reason = Message(
        "'{name}' leaves the {reach:.3g} m around the origin that so many shapes may be in",
        name=name,
        reach=scene.reach,
    )
    return SimulationError(name, t, reason)


class Fence:
    """Looks whether all bodies of a scene stay within its grid, beyond which pymunk never returns.

    Parameters
    ----------
    scene, kicks
        Of a crowd, for which pairs are found in a grid.
    """

    def __init__(self, scene: Scene, kicks: Kicks) -> None:
        self._scene, self._kicks = scene, kicks
        self._look_again = 0  # at which step

    def look(self) -> None:
        """Stop if somebody would leave the grid in the coming drift.

        Raises
        ------
        SimulationError
            If so.
        """
        kicks = self._kicks
        if name := self._leaver(kicks.clock.steps, kicks.clock.dt):
            raise beyond(name, self._scene, kicks.clock.after(0))

    def _leaver(self, step: int, drift: float) -> str | None:
        """Return who would leave it in a drift [s] after so many steps."""
        if step < self._look_again:
            return None
        extent, reach, field = self._scene.batch.extent(), self._scene.reach, self._scene.gravity
        gains = hypot(*field.acceleration) if field else 0.0
        if not self._scene.hooked and (extent + gains) * FASTER < reach:  # laws may do anything
            self._look_again = step + LOOK
            return None
        return None if extent * (1 + drift) < reach else self._outermost(drift)

    def _outermost(self, drift: float) -> str | None:
        state, reach = self._scene.batch.state(), self._scene.reach
        with np.errstate(all="ignore"):  # what is not a number is told later, by name
            beyond = (np.abs(state[:, :2] + state[:, 3:5] * drift) >= reach).any(axis=1)
        return list(self._scene.bodies)[int(beyond.argmax())] if beyond.any() else None
