"""Remedies for a run that had to stop, each tried before it is suggested.

The run itself only says what it suspects. The window and the commands ask here for a remedy before
they show why it stopped. Each remedy is tried in a world of its own, from the start to well beyond
the stop. All of them together have a bounded time and number of steps.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from time import process_time
from typing import NamedTuple

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.joints import Own, is_exact
from sandbox.model.level import HIGHEST_RATE, Level, Stepping, is_direct
from sandbox.model.message import NOTHING, Message, both, joined
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from sandbox.physics.state.errors import BreakdownError, SimulationError
from sandbox.physics.stepping.world import World

DIRECT = Message('with "contact": {"solver": "direct"}')

SECONDS = 2.0
"""s of processor time for all trials, so that a busy machine finds the same; a step in progress is
not cut short."""

STEPS = 50_000
"""The most steps of a trial."""

FINER = 4
"""The rate of a trial where no rate is known, as a multiple of the present one."""

PAST = 1.5
"""How many times as far as the failed run a trial must come to count as success."""


class Advice(NamedTuple):
    """What was found.

    Attributes
    ----------
    text
        In words; empty if nothing is known.
    rate
        The one that holds, if one was found [Hz].
    """

    text: Message
    rate: float | None = None


@dataclass(frozen=True, slots=True)
class _Trial:
    """How a remedy did."""

    description: Message
    rate: float | None
    t: float
    whole: bool
    stopped: bool

    @property
    def outcome(self) -> Message:
        if self.stopped:
            return Message(
                "{description} it stops at t = {t:.4g} s", description=self.description, t=self.t
            )
        if self.whole:
            return Message(
                "{description} it holds to its end, t = {t:.4g} s",
                description=self.description,
                t=self.t,
            )
        return Message(
            "{description} it holds until t = {t:.4g} s", description=self.description, t=self.t
        )


def tried(
    error: SimulationError,
    level: Level,
    values: Values,
    stepping: Stepping,
    duration: float | None = None,
) -> SimulationError:
    """Return the same error with the remedies that worked.

    Parameters
    ----------
    error
        Why the run stopped.
    level, values, stepping
        The run.
    duration
        How long it should have been [s]; as the level says if left out.
    """
    if isinstance(error, BreakdownError):
        return error
    found = advise(error, level, values, stepping, duration)
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
    """Try remedies for some time [s], and return those that work; for the others, see `tried`."""
    if stepping.accuracy is not None:
        return Advice(NOTHING)
    end = level.duration(values) if duration is None else duration
    attempt = partial(_attempt, values=values, before=error.time, end=end)
    deadline, failed = process_time() + seconds, list[_Trial]()
    rates = list(_finer(error, stepping))
    others = list(_others(level, stepping))
    for i, (description, changed, with_, rate) in enumerate((*rates, *others)):
        left = len(rates) + len(others) - i
        share = (deadline - process_time()) / left * 2  # what stops early leaves more to the others
        until = min(deadline, process_time() + share)
        trial = attempt(description, changed or level, with_, rate, until=until)
        if trial is None:
            continue
        if not trial.stopped:
            return Advice(_found(failed, trial), trial.rate)
        failed.append(trial)
    if not failed:
        return Advice(
            Message("no remedy is known: nothing came as far within {seconds:g} s", seconds=seconds)
        )
    outcomes = joined((trial.outcome for trial in failed), "; ")
    return Advice(Message("nothing that was tried helps: {outcomes}", outcomes=outcomes))


def findings(
    error: SimulationError, level: Level, values: Values, stepping: Stepping, duration: float
) -> Iterator[Advice]:
    """Yield the advice, as work for another process; for the parameters, see `tried`."""
    yield advise(error, level, values, stepping, duration)


def _found(failed: list[_Trial], trial: _Trial) -> Message:
    """Say what helps, and that higher rates did not, if some were tried."""
    rates = [Message("{rate:,.0f}", rate=trial.rate) for trial in failed if trial.rate]
    if not rates:
        return Message("tried: {outcome}", outcome=trial.outcome)
    return Message(
        "tried: a higher rate does not help ({rates} Hz), but {outcome}",
        rates=both(rates),
        outcome=trial.outcome,
    )


def leaning(level: Level, values: Values, stepping: Stepping) -> str:
    """Say that a level's outcome is not determined by its start, and what helps."""
    text = "sweeps of the solver did not settle what rests at the start, so it may lean or fall"
    try:
        build(solved_directly(level), values, stepping)
    except SandboxError:
        return text
    return f"{text}; {DIRECT} its forces are found"


def solved_directly(level: Level) -> Level:
    """Return a level with contact whose contacts are solved directly."""
    contact = level.effects.contact
    assert contact
    direct = contact.model_copy(update={"solver": "direct"})
    return level.model_copy(
        update={"effects": level.effects.model_copy(update={"contact": direct})}
    )


Remedy = tuple[Message, Level | None, Stepping, float | None]


def _finer(error: SimulationError, stepping: Stepping) -> Iterator[Remedy]:
    if stepping.is_stock:
        return
    first = error.rate or FINER * stepping.rate
    for rate in (float(first), 2.0 * first):
        if stepping.rate < rate <= HIGHEST_RATE:
            yield Message("at {rate:,.0f} Hz", rate=rate), None, stepping.at(rate), rate


def _others(level: Level, stepping: Stepping) -> Iterator[Remedy]:
    """Yield what else may help, in the words of a level."""
    if stepping.is_stock:
        other = stepping.model_copy(update={"scheme": "leapfrog"})
        yield Message("with the scheme 'leapfrog'"), None, other, None
    contact = level.effects.contact
    held = {name: joint for name, joint in level.joints.items() if is_exact(joint)}
    own = any(isinstance(joint, Own) and not joint.exact for joint in level.joints.values())
    if contact and not is_direct(level, stepping) and not own:
        yield DIRECT, solved_directly(level), stepping, None
    if contact and held and all(isinstance(joint, Own) for joint in held.values()):
        loose = {n: joint.model_copy(update={"exact": False}) for n, joint in held.items()}
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
) -> _Trial | None:
    """Run a remedy to the end, or as far as it comes; None if that proves nothing."""
    try:
        world = build(level, values, stepping)
    except SandboxError:
        return _Trial(description, rate, 0.0, whole=False, stopped=True)
    steps = count_steps(world, end)
    try:
        whole = _run(world, min(steps, STEPS), until) and steps <= STEPS
    except SandboxError:
        return _Trial(description, rate, world.t, whole=False, stopped=True)
    if not whole and world.t < PAST * before:
        return None
    return _Trial(description, rate, world.t, whole=whole, stopped=False)


def _run(world: World, steps: int, until: float) -> bool:
    """Observe a number of steps, if time is left; return whether it was."""
    for _ in range(steps):
        world.advance()
        if process_time() > until:
            return False
    return True
