"""The triggers of the stopwatch: a click, or an event of the run."""

from collections.abc import Iterator
from typing import NamedTuple

from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.session import Session
from sandbox.app.words.formatting import name_in_words, number
from sandbox.app.words.language import say
from sandbox.model.contained_expressions import expressions
from sandbox.model.expressions import Expression, Values
from sandbox.model.level import ApexEvent, ContactEvent, CrossingEvent, LandingEvent, Level
from sandbox.model.level_parts import measured
from sandbox.model.measuring_instants import Passage
from sandbox.model.quantities import QuantityError
from sandbox.physics.measuring.grading import time_of
from sandbox.physics.measuring.recording import Trace, needed_at
from sandbox.physics.quantities.meter import Meter

Moment = Expression | ContactEvent | Passage
"""A time [s], or the first occurrence of an event."""

FEW = 12
"""Apex and landing are offered for at most this many bodies."""
MOST = 60
"""The largest number of triggers offered."""


class StopwatchTrigger(NamedTuple):
    """A trigger."""

    at: Moment | None
    """The moment; None for a click."""
    value: str = ""
    """The text of the height of the landing or the value that is crossed; else empty."""

    @property
    def label(self) -> str:
        """Its name in the list."""
        match self.at:
            case None:
                return say("by hand (key 3)")
            case ApexEvent(body=body):
                return say("apex of {body}", body=name_in_words(body))
            case LandingEvent(body=body):
                faller = name_in_words(body)
                return say("{body} falls to y = {height} m", body=faller, height=self.value)
            case ContactEvent(bodies=bodies):
                first, second = map(name_in_words, bodies)
                return say("{one} meets {other}", one=first, other=second)
            case CrossingEvent(quantity=quantity):
                return say("{quantity} crosses {value}", quantity=quantity, value=self.value)
        return say("start of the run")


class TriggerTime(NamedTuple):
    """The time of an event [s], and whether it is known more precisely than a step."""

    t: float
    between: bool


BY_HAND = StopwatchTrigger(None)
AT_ONCE = StopwatchTrigger(Expression(0))


def triggers(session: Session) -> list[StopwatchTrigger]:
    """Return the triggers offered for a run, with the pairs that have touched so far."""
    pairs = (sorted(pair) for pair in session.run.contacts.met if len(pair) == 2)
    met = (ContactEvent(event="contact", bodies=(first, second)) for first, second in pairs)
    instants = (*_instants(session.level), *met)
    found = [BY_HAND, AT_ONCE, *(_trigger(at, session.values) for at in instants)]
    return list({occasion.label: occasion for occasion in found}.values())[:MOST]


def _instants(level: Level) -> Iterator[Moment]:
    """Yield the events that a level names, then those of each of its bodies."""
    for _, one in measured(level):
        if isinstance(one.at, ContactEvent) and one.at.nth == 1:
            first, second = sorted(one.at.bodies)
            yield one.at.model_copy(update={"bodies": (first, second)})
        elif isinstance(one.at, Passage):
            yield one.at
    moving = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    if level.effects.gravity and len(moving) <= FEW:
        yield from (ApexEvent(event="apex", body=name) for name in moving)
        yield from (LandingEvent(event="landing", body=name) for name in moving)


def _trigger(at: Moment, values: Values) -> StopwatchTrigger:
    match at:
        case LandingEvent(height=value) | CrossingEvent(value=value):
            return StopwatchTrigger(at, number(value(values), 4))
        case _:
            return StopwatchTrigger(at)


def find(at: Moment, run: LiveRun) -> TriggerTime | None:
    """Return the time of an event in a run so far; None if it has not occurred.

    An event that names a body or parameter which a changed run lacks has not occurred either.
    """
    if isinstance(at, ContactEvent):
        met = run.contacts.met.get(frozenset(at.bodies))
        return met and TriggerTime(met.t, met.located)
    if any(named.names - run.world.values.keys() for _, named in expressions(at)):
        return None
    try:
        trace = _trace(at, run)
    except QuantityError:
        return None
    t = time_of(at, trace)
    return None if t is None else TriggerTime(t, between=True)


def _trace(at: Moment, run: LiveRun) -> Trace:
    """Return the recorded states as a trace, in which instants are found."""
    world, states = run.world, run.history.snapshots
    meter = Meter(world, needed_at("t", at))
    units = {name: quantity.unit for name, quantity in meter.quantities.items()}
    columns = meter(states)
    return Trace(world.level, world.values, world.stepping, states.t, columns, units, {}, {})
