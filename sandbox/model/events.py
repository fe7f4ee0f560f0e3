"""Events that act once in a run: a string is cut, a hook catches, or a force is switched.

A joint exists until it is cut or breaks. A joint that an event ties is open until then. A force
that an event switches on is off until then; any other is on from the start.
"""

from collections.abc import Iterator, Mapping
from typing import Annotated, Literal, NamedTuple

from pydantic import Discriminator, Tag

from sandbox.model.base import Model
from sandbox.model.expressions import Expression, Fraction, Values
from sandbox.model.joints import AngleStop, Joint, OneSided, Stop, is_exact
from sandbox.model.measuring_instants import (
    ApexEvent,
    CrossingEvent,
    LandingEvent,
    crossing_of,
    kind_of,
)
from sandbox.model.number_bounds import Load
from sandbox.model.reference_fields import BodyNames, ForceNames, JointNames

Direction = Literal["up", "down", "either", "beyond"]
"""The direction of a crossing; `beyond` is where the size of a quantity reaches the value."""

Trigger = Annotated[
    Annotated[Expression, Tag("a number")]
    | Annotated[CrossingEvent, Tag("crossing")]
    | Annotated[ApexEvent, Tag("apex")]
    | Annotated[LandingEvent, Tag("landing")],
    Discriminator(kind_of),
]
"""A time [s], or a quantity that crosses a value."""

ACTIONS = ("cut", "tie", "on", "off", "reverse")
"""The fields of an event that define its action."""

MOST_EVENTS = 200
"""The most events in a level."""


class Event(Model):
    """A change that happens once in a run, at its exact time within a step."""

    at: Trigger
    """a time [s], or the first time that a quantity crosses a value"""
    cut: JointNames = ()
    """the joints to cut"""
    tie: JointNames = ()
    """the joints to tie, which hold their ends as they are then; they are open before"""
    on: ForceNames = ()
    """the effects or named forces to switch on; they are off before"""
    off: ForceNames = ()
    """the effects or named forces to switch off"""
    reverse: BodyNames = ()
    """the one-way surfaces to reverse; a body that is in one at that time passes through"""

    @property
    def has_action(self) -> bool:
        """Whether it has any action."""
        return any(getattr(self, action) for action in ACTIONS)


class Crossing(NamedTuple):
    """The crossing that triggers an event: a quantity, a value, and a direction."""

    quantity: str
    value: float
    direction: Direction


class SingleEvent(NamedTuple):
    """An event that happens once: its trigger, and what it cuts, ties, switches and reverses."""

    trigger: Crossing
    cut: tuple[str, ...] = ()
    tie: tuple[str, ...] = ()
    on: tuple[str, ...] = ()
    off: tuple[str, ...] = ()
    reverse: tuple[str, ...] = ()


def events_by_name(
    events: Mapping[str, Event], joints: Mapping[str, Joint], values: Values
) -> dict[str, SingleEvent]:
    """Return the events of a level, including those of joints that break."""
    single_events = {
        name: SingleEvent(_crossing(event.at, values), *(getattr(event, a) for a in ACTIONS))
        for name, event in events.items()
    }
    for joint, load in breaking_loads(joints, values).items():
        single_events[breaking_event(joint)] = SingleEvent(
            Crossing(f"{joint}.tension", load, "beyond"), (joint,)
        )
    return single_events


def breaking_event(joint: str) -> str:
    """Return the name of the event in which a joint breaks; no other event can have it."""
    return f"{joint} breaks"


def breaking_loads(joints: Mapping[str, Joint], values: Values) -> dict[str, float]:
    """Return the force at which each breakable joint breaks [N]."""
    return {name: load(values) for name, load in breakable(joints)}


def breakable(joints: Mapping[str, Joint]) -> Iterator[tuple[str, Load]]:
    """Yield the joints that may break, with the forces at which they do."""
    for name, joint in joints.items():
        if (load := getattr(joint, "breaks_at", None)) is not None:
            yield name, load


def _crossing(at: Trigger, values: Values) -> Crossing:
    """Return the crossing that triggers an event; a time is a crossing of `t`."""
    if isinstance(at, Expression):
        return Crossing("t", at(values), "up")
    quantity, value, direction = crossing_of(at)
    return Crossing(quantity, value(values), direction)


def cut_joints(events: Mapping[str, Event], joints: Mapping[str, Joint]) -> frozenset[str]:
    """Return the joints that are cut by an event, or that may break."""
    cut_by_events = {name for event in events.values() for name in event.cut}
    return frozenset(cut_by_events.union(name for name, _ in breakable(joints)))


def rebounding_stops(joints: Mapping[str, Joint]) -> Iterator[tuple[str, Fraction]]:
    """Yield the stops that rebound, with their coefficients of restitution."""
    for name, joint in joints.items():
        if isinstance(joint, Stop | AngleStop) and joint.restitution is not None:
            yield name, joint.restitution


def stops_without_rebound(joints: Mapping[str, Joint], events: Mapping[str, Event]) -> list[str]:
    """Return the ropes and stops that do not rebound if other stops do, but not those tied later.

    Both kinds may be reached within the same step, so both are located.
    """
    others = {name for name, _ in rebounding_stops(joints)}
    if not others:
        return []
    others |= tied_joints(events)
    return [
        name
        for name, joint in joints.items()
        if isinstance(joint, OneSided) and is_exact(joint) and name not in others
    ]


def tied_joints(events: Mapping[str, Event]) -> frozenset[str]:
    """Return the joints that an event ties; they are open until then."""
    return frozenset(name for event in events.values() for name in event.tie)
