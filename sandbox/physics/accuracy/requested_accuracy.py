"""The cheapest setting that reaches a requested accuracy, or the reason why there is none."""

from collections.abc import Sequence
from dataclasses import dataclass

from sandbox.model.expressions import Values
from sandbox.model.level import FINEST, Level
from sandbox.model.translatable_message import Message, both
from sandbox.physics.accuracy.candidate_settings import REAL_TIME, Offer, SearchResult
from sandbox.physics.accuracy.chaos_detection import chaotic, prediction_horizon
from sandbox.physics.accuracy.compared_runs import Stop, Watched, never, watched
from sandbox.physics.accuracy.exceptions import AccuracyError
from sandbox.physics.accuracy.refinement_scheduling import Progress
from sandbox.physics.accuracy.setting_search import Seeker
from sandbox.physics.measuring.grading import applies

BUDGET = 1.0
"""The counted work of all runs of a calibration, at most [s]."""

_ENERGY = Watched("system.energy")


@dataclass(frozen=True, slots=True)
class Setting:
    """The cheapest setting that reaches an accuracy."""

    target: float
    """The requested accuracy."""
    chosen: Offer
    """The setting, its estimated error and its cost."""
    judged_by: str
    """The quantities by which the error is judged, in words."""
    verified: bool
    """Whether runs with smaller steps confirmed the error; else it is extrapolated by the order."""
    in_real_time: Offer | None = None
    """The most accurate setting that runs in real time, if the chosen one does not."""
    decided_by: str = ""
    """The quantity with the largest error; empty if no quantity has any."""

    @property
    def for_drawing(self) -> Offer:
        """The setting for a run that is drawn, however long that takes."""
        return self.chosen.at_drawing_rate

    @property
    def for_playing(self) -> Offer:
        """The setting for a run that is watched live."""
        return (self.in_real_time or self.chosen).at_drawing_rate

    def __str__(self) -> str:
        text = f"accuracy {self.target:g}: {self.chosen}, judged by {self.judged_by}"
        if self.decided_by:
            text += f"; the largest error is that of {self.decided_by}"
        if not self.verified:
            text += "; expected of its order, for a run that shows it takes too long"
        if self.in_real_time is None:
            return text
        return f"{text}; not in real time, in which there is {self.in_real_time}"


def calibrate(
    level: Level,
    values: Values | None = None,
    target: float = 1e-6,
    budget: float = BUDGET,
    progress: Progress | None = None,
    stop: Stop = never,
    also: Sequence[str] = (),
) -> Setting:
    """Return the cheapest setting with which a run reaches an accuracy.

    `target` is the largest error allowed in the level's checks, in the positions and velocities of
    moving bodies, and in further quantities, `also`. `budget` is the counted work of the search,
    about [s]; `stop` is called repeatedly, and returns whether to give up.

    Raises `AccuracyError` if the accuracy cannot be reached, or there is nothing to judge it by;
    `Cancelled` if `stop` returned true; `QuantityError` or `SimulationError` if there is no such
    quantity, or the level does not run at all.
    """
    _require_above_rounding(target)
    values = level.defaults if values is None else values
    seeker = Seeker(level, values, target, budget, progress, stop)
    items, judged_by = _judging_items(level, values, also)
    result = seeker.search(items)
    if result.chosen.error <= target:
        return _to_setting(result, judged_by)
    horizon = _horizon(result, target)
    if chaos := chaotic(result.offers.fine, stop):
        judged_by = _energy_reason(chaos, horizon)
        result = seeker.search((_ENERGY,))
    if result.chosen.error > target:
        raise _refused(level, result, target, judged_by, horizon)
    return _to_setting(result, judged_by)


def _require_above_rounding(target: float) -> None:
    if not target >= FINEST:
        raise AccuracyError(
            "an accuracy of {target:g} is below rounding; it must be at least {finest:g}",
            target=target,
            finest=FINEST,
        )


def _energy_reason(chaos: Message, horizon: Message) -> Message:
    return Message(
        "its energy, since it is chaotic: {chaos}; positions are {until}",
        chaos=chaos,
        until=horizon,
    )


def _horizon(result: SearchResult, target: float) -> Message:
    """Say up to what time a run can be predicted to an accuracy."""
    if t := prediction_horizon(result.offers.refinements, result.items, target):
        return Message("predictable until t = {t:.3g} s", t=t)
    return Message("not predictable at all")


def _to_setting(result: SearchResult, judged_by: str) -> Setting:
    """Return the result of a search as a setting."""
    offer = result.timed()
    affordable = None if offer.at_drawing_rate.cost <= REAL_TIME else result.in_real_time()
    verified = result.chosen.trace is not None
    return Setting(result.target, offer, judged_by, verified, affordable, result.decided_by)


def _refused(
    level: Level, result: SearchResult, target: float, judged_by: Message, horizon: Message
) -> AccuracyError:
    """Return the error for an accuracy that cannot be reached; it names the best setting."""
    if result.decided_by:
        judged_by = Message(
            "{judged_by}; the largest error is that of {name}",
            judged_by=judged_by,
            name=result.decided_by,
        )
    judged = result.level.duration(result.values)
    if judged < level.duration(result.values):
        horizon = Message(
            "{until}; smaller steps bring the first {t:.2g} s no closer to a result",
            until=horizon,
            t=judged,
        )
    return AccuracyError(
        "an accuracy of {target:g} cannot be reached; the best is {timed}, judged by"
        " {judged_by}; to {target:g} it is {until}",
        target=target,
        timed=result.timed().in_words,
        judged_by=judged_by,
        until=horizon,
    )


def _judging_items(
    level: Level, values: Values, also: Sequence[str]
) -> tuple[tuple[Watched, ...], Message]:
    """Return the quantities by which the error is judged, and their description."""
    items = watched(level, values, also)
    if not items:
        raise AccuracyError("nothing moves freely, so there is no accuracy to reach")
    checked = any(applies(check, values) for check in level.checks)
    parts = [Message("its checks")] * checked + [Message("what is recorded")] * bool(also)
    return items, both([*parts, Message("positions and velocities")])
