"""The start of a run: a world with the stepping that reaches its level's accuracy, if known."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from sandbox.app.runs.companion_runs import Companion, Variant
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.physics.accuracy.requested_accuracy import Setting


class RunStart(NamedTuple):
    """The start of a run."""

    world: World
    """The world at the start."""
    companions: tuple[Companion, ...]
    """The companion runs."""
    setting: "Setting | None"
    """The setting that reaches the accuracy that the level asks for; None if it asks for none, or
    if the setting is not known yet."""


def begin(level: Level, values: Values, beside: Sequence[Variant], *, patient: bool) -> RunStart:
    """Build a level, and its companion runs.

    If `patient`, search for the setting that reaches the accuracy the level asks for, unless it is
    known. Raises `SandboxError` if the level or a variant cannot be built with these values.
    """
    setting = _known_setting(level, values, patient)
    if setting is not None:
        offer = setting.for_drawing if patient else setting.for_playing
        world = build(level, values, offer.stepping)
    elif level.stepping.accuracy is None:
        world = build(level, values)
    else:
        world = _at_default_rate(level, values)
    return RunStart(world, tuple(Companion(variant, values) for variant in beside), setting)


def at_rate(level: Level, rate: float | None) -> Level:
    """Return the level, with another rate if one is given [Hz]."""
    if rate is None:
        return level
    return level.model_copy(update={"stepping": level.stepping.at(float(rate))})


def _known_setting(level: Level, values: Values, patient: bool) -> "Setting | None":
    target = level.stepping.accuracy
    if target is None:
        return None
    from sandbox.physics.accuracy.calibration_cache import calibrated, recalled

    return (calibrated if patient else recalled)(level, values, target)


def _at_default_rate(level: Level, values: Values) -> World:
    """Build a level that asks for an accuracy at the default rate, or at a stable one."""
    try:
        return build(level, values, Stepping())
    except SimulationError as error:
        if error.rate is None:
            raise
        return build(level, values, Stepping(rate=error.rate))
