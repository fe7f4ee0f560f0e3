"""Stops a run in which a body's position or energy is no longer a finite number."""

from collections.abc import Callable, Sequence
from math import isfinite
from typing import NoReturn

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.level import Stepping
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.motion import kinetic_energy
from sandbox.physics.state.simulation_errors import SimulationError, way_out
from sandbox.physics.state.snapshot import Snapshot

MARGIN = 4
"""The advised rate, as a multiple of the present one, where nothing else is known."""

Cause = Callable[[int], tuple[Message, float | None]]
"""Returns the cause for a body, by its row, and the rate that it needs [Hz]."""


class FreeFallWatch:
    """Watches bodies under uniform gravity alone, without contacts or joints.

    `last_good` is the last state that passed the checks. `is_doubtful` and `ignores_doubts` are
    unused here: a run that it stops cannot continue.
    """

    def __init__(self, scene: Scene, stepping: Stepping, start: Snapshot) -> None:
        self._names, self._stepping = list(scene.bodies), stepping
        self.last_good = self._last = start
        self.is_doubtful = self.ignores_doubts = False
        kinetic = kinetic_energy(scene.mass, scene.moment, start)
        potential = float(scene.gravity.potential_energy(start).sum()) if scene.gravity else 0.0
        if not isfinite(float(kinetic.sum()) + potential):
            refuse_infinite_energy(self._names, int(np.argmax(kinetic)), start, stepping.rate)

    def check(
        self,
        now: Snapshot,
        contacts: Contacts,  # noqa: ARG002 (there are none)
        velocity: Array,  # noqa: ARG002 (not needed)
        *,
        disturbed: bool,  # noqa: ARG002
        cut: bool = False,  # noqa: ARG002
    ) -> None:
        """Check an observation; see `Watchdog.check`."""
        self.last_good = self._last
        if not is_finite(now):
            refuse_non_finite(self._names, now, self._stepping.rate, self._cause, _unknown)
        self._last = now

    def _cause(self, _row: int) -> tuple[Message, float | None]:
        if self._stepping.is_stock:
            return energy_from_scheme(self._stepping.scheme), None
        return NOTHING, MARGIN * self._stepping.rate


def energy_from_scheme(scheme: str) -> Message:
    """Return the cause of energy growth with a textbook scheme."""
    return Message(": the scheme '{scheme}' adds energy in every step", scheme=scheme)


def is_finite(now: Snapshot) -> bool:
    """Return whether positions and velocities, and their squares, are finite numbers."""
    in_plane = now.position.ravel(), now.velocity.ravel()
    values = np.concatenate((*in_plane, now.angle, now.angular_velocity))
    return isfinite(values.dot(values))  # a sum of squares is finite only if all are


def refuse_non_finite(
    names: Sequence[str], now: Snapshot, rate: float, position_cause: Cause, energy_cause: Cause
) -> None:
    """Stop if a body's position or its energy is no longer finite.

    `now` is a state for which `is_finite` is false; `position_cause` and `energy_cause` return the
    cause of a lost position, and of an infinite energy. Raises `SimulationError` if so.
    """
    rows = np.column_stack((now.position, now.velocity, now.angle, now.angular_velocity))
    non_finite, infinite = (~np.isfinite(part).all(axis=1) for part in (rows, rows * rows))
    if non_finite.any():
        row = int(non_finite.argmax())
        cause, required_rate = position_cause(row)
        reason = Message(
            "the position of '{name}' is no longer finite{cause}", name=names[row], cause=cause
        )
        stop_run(names[row], now, reason, required_rate, rate)
    if infinite.any():
        refuse_infinite_energy(names, int(infinite.argmax()), now, rate, energy_cause)


def _unknown(_row: int) -> tuple[Message, float | None]:
    return NOTHING, None


def refuse_infinite_energy(
    names: Sequence[str], row: int, now: Snapshot, rate: float, cause_of: Cause = _unknown
) -> NoReturn:
    """Stop because a body's energy is not finite; see `refuse_non_finite`."""
    cause, required_rate = cause_of(row)
    reason = Message(
        "'{name}' is so fast, so far away or so heavy that its energy is not finite{cause}",
        name=names[row],
        cause=cause,
    )
    stop_run(names[row], now, reason, required_rate, rate)


def stop_run(
    name: str, now: Snapshot, reason: Message, required_rate: float | None, rate: float
) -> NoReturn:
    """Stop for a reason, and advise the rate that should hold, if known [Hz]."""
    hint = NOTHING if required_rate is None else way_out(required_rate, rate)
    raise SimulationError(name, float(now.t), reason, required_rate, hint=hint)
