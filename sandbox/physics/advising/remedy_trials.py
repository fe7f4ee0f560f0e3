"""Remedies for a run that had to stop, each tried before it is suggested.

The run itself only reports a suspicion. The window and the commands ask here for a remedy before
they show why it stopped. Each remedy is tried in a world of its own, from the start to well beyond
the stop, within a limited time for all and a limited number of steps each.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from math import ceil
from time import process_time
from typing import NamedTuple

from sandbox.model.contact_solver_choice import is_direct
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.joints import Own, is_exact, is_solved_by_pymunk
from sandbox.model.level import HIGHEST_RATE, Level, Stepping
from sandbox.model.translatable_message import NOTHING, Message, both, joined
from sandbox.physics.guarding.least_step_rate import required_rate
from sandbox.physics.measuring.recording import Trace, count_steps
from sandbox.physics.measuring.unbalanced_contacts import NOTICED
from sandbox.physics.run import build
from sandbox.physics.scene.stability_limits import MARGIN
from sandbox.physics.state.cancellation_points import cancellable, cancellation_point
from sandbox.physics.state.simulation_errors import (
    BlockedError,
    BreakdownError,
    OverlapError,
    SimulationError,
)
from sandbox.physics.stepping.world import World

DIRECT = Message('with "contact": {"solver": "direct"}')

SECONDS = 4.0
"""s of processor time for all trials, so that a busy machine finds the same."""

SECONDS_OF_A_COMMAND = 1.0
"""The same where a user waits for the answer."""

STEPS = 50_000
"""The most steps of a trial."""

FINER = 4
"""The rate to try if none is suggested, as a multiple of the present one."""

MOST_BODIES = 100
"""The most bodies of a pile whose forces are found directly, to see whether that helps."""

PAST = 1.5
"""The time that a trial must reach to count as success, as a multiple of the failed run's."""


class Advice(NamedTuple):
    """The outcome of the trials."""

    text: Message
    """The advice in words; empty if there is none."""
    rate: float | None = None
    """The rate that holds, if one was found [Hz]."""


@dataclass(frozen=True, slots=True)
class _Trial:
    """The outcome of the trial of a remedy; `is_slow` if it took too long to prove anything."""

    description: Message
    rate: float | None
    t: float
    is_complete: bool = False
    has_stopped: bool = False
    is_slow: bool = False

    @property
    def outcome(self) -> Message:
        if self.is_slow:
            return Message("{description} it took too long to tell", description=self.description)
        if self.has_stopped:
            return Message(
                "{description} it stops at t = {t:.4g} s", description=self.description, t=self.t
            )
        if self.is_complete:
            return Message(
                "{description} it runs to its end, t = {t:.4g} s",
                description=self.description,
                t=self.t,
            )
        return Message(
            "{description} it runs until t = {t:.4g} s", description=self.description, t=self.t
        )


def with_advice(
    error: SimulationError,
    level: Level,
    values: Values,
    stepping: Stepping,
    duration: float | None = None,
    seconds: float = SECONDS,
) -> SimulationError:
    """Return the error with which a run stopped, with advice from the trials of remedies.

    None is tried where no setting can help: what is wrong is where bodies are, or a defect.
    `duration` is the intended duration [s], that of the level if left out; `seconds` is the
    processor time for all trials.
    """
    if isinstance(error, BreakdownError | BlockedError | OverlapError):
        return error
    found = advise(error, level, values, stepping, duration, seconds)
    if not found.text:
        return error
    return error.advised(found.text, found.rate)


def advise(
    error: SimulationError,
    level: Level,
    values: Values,
    stepping: Stepping,
    duration: float | None = None,
    seconds: float = SECONDS,
) -> Advice:
    """Try remedies for some time [s], and return advice; see `with_advice` for the parameters."""
    if stepping.accuracy is not None:
        return Advice(NOTHING)
    end = level.duration(values) if duration is None else duration
    attempt = partial(_attempt, values=values, before=error.time, end=end)
    deadline, failed = process_time() + seconds, list[_Trial]()
    start_rate = _rate_at_start(error, level, values, stepping, until=deadline)
    rates = _higher_rates(error, stepping, start_rate)
    remedies = [*rates, *_other_remedies(level, stepping)]
    for i, (description, changed, with_, rate) in enumerate(remedies):
        left = len(remedies) - i
        # early stops leave more time to the others
        time_share = (deadline - process_time()) / left * 2
        until = min(deadline, process_time() + time_share)
        trial = attempt(description, changed or level, with_, rate, until=until)
        if not (trial.has_stopped or trial.is_slow):
            return Advice(_helpful(failed, trial), trial.rate)
        failed.append(trial)
    if all(trial.is_slow for trial in failed):
        return Advice(
            Message("no remedy is known: nothing got as far within {seconds:g} s", seconds=seconds)
        )
    outcomes = joined((trial.outcome for trial in failed), "; ")
    return Advice(Message("nothing that was tried helps: {outcomes}", outcomes=outcomes))


def advice_in_background(
    error: SimulationError, level: Level, values: Values, stepping: Stepping, duration: float
) -> Iterator[Advice]:
    """Yield advice, as work for another process; for the parameters, see `with_advice`."""
    yield advise(error, level, values, stepping, duration)


def _helpful(failed: list[_Trial], trial: _Trial) -> Message:
    """Return the remedy that helps, and the higher rates that did not, if any were tried."""
    stopped = (trial.rate for trial in failed if trial.has_stopped)
    rates = [Message("{rate:,.0f}", rate=rate) for rate in stopped if rate]
    if not rates:
        return Message("tried: {outcome}", outcome=trial.outcome)
    if trial.rate:
        return Message(
            "tried: at {rates} Hz it stops as well, but {outcome}",
            rates=both(rates),
            outcome=trial.outcome,
        )
    return Message(
        "tried: a higher rate does not help ({rates} Hz), but {outcome}",
        rates=both(rates),
        outcome=trial.outcome,
    )


def leaning_warning(level: Level, values: Values, stepping: Stepping) -> str:
    """Return the warning that a pile may lean because its contact forces were not settled."""
    text = "sweeps of the solver did not settle what rests at the start, so it may lean or fall"
    if len(level.bodies) > MOST_BODIES:
        return text
    try:
        build(solved_directly(level), values, stepping)
    except SandboxError:
        return text
    return f"{text}; {DIRECT} its forces are found"


def creep_warning(trace: Trace, seconds: float | None = None) -> str:
    """Return what sweeps left unbalanced in the piles of a run; empty if that is negligible.

    It also tries the direct solver for some time [s] and, if that finds the forces, says how long a
    step then takes.
    """
    level, values, stepping = trace.level, trace.values, trace.stepping
    if trace.unbalanced < NOTICED:
        return ""
    text = (
        f"sweeps of the solver left {100 * trace.unbalanced:.2g} % of the forces between bodies"
        " that rest on each other unbalanced, so they may creep, lean or fall"
    )
    if all(description is not DIRECT for description, *_ in _other_remedies(level, stepping)):
        return text
    begun, end = process_time(), float(trace.t[-1])
    trial = _attempt(
        DIRECT, solved_directly(level), stepping, None,
        values=values, before=0.0, end=end, until=begun + (SECONDS if seconds is None else seconds),
    )  # fmt: skip
    if trial.has_stopped or not trial.t:
        return text
    took = 1000 * (process_time() - begun) / stepping.steps(trial.t)
    return f"{text}; {DIRECT} they are found, and a step takes {took:.3g} ms (tried)"


def solved_directly(level: Level) -> Level:
    """Return a level with the direct solver for its contacts."""
    contact = level.effects.contact
    assert contact
    direct = contact.model_copy(update={"solver": "direct"})
    return level.model_copy(
        update={"effects": level.effects.model_copy(update={"contact": direct})}
    )


Remedy = tuple[Message, Level | None, Stepping, float | None]


def _higher_rates(
    error: SimulationError, stepping: Stepping, start_rate: float
) -> Iterator[Remedy]:
    """Yield higher rates [Hz]: only one if the level cannot even start, for another cause."""
    if stepping.is_stock:
        return
    first = error.rate or FINER * stepping.rate
    is_other_cause = bool(error.place) and not error.rate
    others = () if is_other_cause else (2.0 * first, float(ceil(max(first, start_rate))))
    for rate in sorted({float(first), *others}):
        if stepping.rate < rate <= HIGHEST_RATE:
            yield Message("at {rate:,.0f} Hz", rate=rate), None, stepping.at(rate), rate


def _rate_at_start(
    error: SimulationError, level: Level, values: Values, stepping: Stepping, *, until: float
) -> float:
    """Return the rate that the start needs [Hz], with a margin; 0 if the world cannot be built."""
    if error.place or stepping.is_stock:
        return 0.0
    try:
        with cancellable(partial(_check_time, until)):
            world = build(level, values, stepping)
    except SandboxError:
        return 0.0
    return MARGIN * required_rate(world.scene, world.snapshot)


def _other_remedies(level: Level, stepping: Stepping) -> Iterator[Remedy]:
    """Yield the remedies other than a higher rate, in the words of a level."""
    if stepping.is_stock:
        other = stepping.model_copy(update={"scheme": "leapfrog"})
        yield Message("with the scheme 'leapfrog'"), None, other, None
    contact = level.effects.contact
    exact_joints = {name: joint for name, joint in level.joints.items() if is_exact(joint)}
    has_pymunk_joints = any(map(is_solved_by_pymunk, level.joints.values()))
    if contact and not is_direct(level, stepping) and not has_pymunk_joints:
        yield DIRECT, solved_directly(level), stepping, None
    if contact and exact_joints and all(isinstance(joint, Own) for joint in exact_joints.values()):
        loose = {n: joint.model_copy(update={"exact": False}) for n, joint in exact_joints.items()}
        swept = contact.model_copy(update={"solver": "iterative"})
        effects = level.effects.model_copy(update={"contact": swept})
        joints = {**level.joints, **loose}
        changed = level.model_copy(update={"joints": joints, "effects": effects})
        yield Message('with "exact": false for its joints'), changed, stepping, None


def _attempt(
    description: Message,
    level: Level,
    stepping: Stepping,
    rate: float | None,
    *,
    values: Values,
    before: float,
    end: float,
    until: float,
) -> _Trial:
    """Run a remedy as far as it goes."""
    world: World | None = None
    try:
        with cancellable(partial(_check_time, until)):
            world = build(level, values, stepping)
            steps = count_steps(world, end)
            _run(world, min(steps, STEPS))
            is_complete = steps <= STEPS
    except _LateError:
        is_complete = False
    except SandboxError:
        return _Trial(description, rate, world.t if world else 0.0, has_stopped=True)
    t = world.t if world else 0.0
    return _Trial(
        description,
        rate,
        t,
        is_complete=is_complete,
        is_slow=not is_complete and t <= PAST * before,
    )


def _run(world: World, steps: int) -> None:
    """Take a number of observed steps, with a cancellation point after each."""
    for _ in range(steps):
        world.advance()
        cancellation_point()


class _LateError(SandboxError):
    """The time for a trial is over: never shown."""

    def __init__(self) -> None:
        super().__init__("")


def _check_time(until: float) -> None:
    if process_time() > until:
        raise _LateError
