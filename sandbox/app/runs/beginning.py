"""The start of a run: a world with the setting that its level asks for, if that is known."""

from collections.abc import Sequence
from typing import NamedTuple

from sandbox.app.runs.companions import Companion, Variant
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy.cache import calibrated, recalled
from sandbox.physics.accuracy.calibration import Setting
from sandbox.physics.run import build
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.world import World


class Beginning(NamedTuple):
    """What a run begins with.

    Attributes
    ----------
    world
        The world at its start.
    companions
        Other runs beside it.
    setting
        What is known to reach the accuracy that its level asks for; None if it asks for none, or
        nobody knows yet.
    """

    world: World
    companions: tuple[Companion, ...]
    setting: Setting | None


def begin(level: Level, values: Values, beside: Sequence[Variant], *, patient: bool) -> Beginning:
    """Build a level, and what runs beside it.

    Parameters
    ----------
    level, values
        The level to build.
    beside
        The variants that run beside it.
    patient
        Whether an accuracy that the level asks for is waited for.

    Raises
    ------
    SandboxError
        If one of them cannot be built with these values.
    """
    setting = _known(level, values, patient)
    if setting is not None:
        offer = setting.chosen if patient else setting.playable
        world = build(level, values, offer.stepping)
    elif level.stepping.accuracy is None:
        world = build(level, values)
    else:
        world = _for_now(level, values)
    return Beginning(world, tuple(Companion(variant, values) for variant in beside), setting)


def at_rate(level: Level, rate: float | None) -> Level:
    """Return a level, at another rate if one is given [Hz]."""
    if rate is None:
        return level
    return level.model_copy(update={"stepping": level.stepping.at(float(rate))})


def _known(level: Level, values: Values, patient: bool) -> Setting | None:
    target = level.stepping.accuracy
    find = calibrated if patient else recalled
    return None if target is None else find(level, values, target)


def _for_now(level: Level, values: Values) -> World:
    """Build a level that asks for an accuracy with a setting that has not been tried."""
    try:
        return build(level, values, Stepping())
    except SimulationError as error:
        if error.rate is None:
            raise
        return build(level, values, Stepping(rate=error.rate))
