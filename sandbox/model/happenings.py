"""What happens once in a run and changes what acts: a body is let go, a string cut, a force set in.

A joint is there until it is cut. A force that some event switches on is off until then; any other
is on from the start.
"""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

from pydantic import Discriminator, Tag

from sandbox.model.base import Model
from sandbox.model.expressions import Expression, Values
from sandbox.model.instants import ApexEvent, CrossingEvent, LandingEvent, kind_of
from sandbox.model.mention import ForceNames, JointNames

if TYPE_CHECKING:
    from sandbox.model.level import Level

Direction = Literal["up", "down", "either"]

Trigger = Annotated[
    Annotated[Expression, Tag("a number")]
    | Annotated[CrossingEvent, Tag("crossing")]
    | Annotated[ApexEvent, Tag("apex")]
    | Annotated[LandingEvent, Tag("landing")],
    Discriminator(kind_of),
]
"""A time [s], or what is seen at once: a quantity that crosses a value."""

MOST_EVENTS = 200
"""How many events a level may have."""


class Event(Model):
    """Something that happens once, at its own time within a step, and changes what acts."""

    at: Trigger
    """a time [s], or when a quantity crosses a value for the first time"""
    cut: JointNames = ()
    """the joints that let go"""
    on: ForceNames = ()
    """the effects, or the named forces, that set in; they are off until then"""
    off: ForceNames = ()
    """the effects, or the named forces, that end"""


class Crossing(NamedTuple):
    """When an event happens: as a quantity crosses a value, which way."""

    quantity: str
    value: float
    direction: Direction


def crossing(at: Trigger, values: Values) -> Crossing:
    """Return what an event waits for; a time is a crossing of `t`."""
    match at:
        case ApexEvent(body=body):
            return Crossing(f"{body}.velocity.y", 0.0, "down")
        case LandingEvent(body=body, height=height):
            return Crossing(f"{body}.position.y", height(values), "down")
        case CrossingEvent(quantity=quantity, value=value, direction=direction):
            return Crossing(quantity, value(values), direction)
    return Crossing("t", at(values), "up")


def cut(level: "Level") -> frozenset[str]:
    """Return the joints of a level that some event cuts."""
    return frozenset(name for event in level.events.values() for name in event.cut)


def switched(level: "Level") -> Mapping[str, bool]:
    """Return the forces of a level that events switch, and whether they are on at the start.

    Springs that are cut are among them.
    """
    found = dict.fromkeys(cut(level) & _springs(level), True)
    for event in level.events.values():
        found.update((name, True) for name in event.off if name not in found)
    found.update((name, False) for event in level.events.values() for name in event.on)
    return found


def _springs(level: "Level") -> frozenset[str]:
    return frozenset(name for name, joint in level.joints.items() if joint.kind.force)


def switchable(level: "Level") -> Iterator[str]:
    """Yield what can be switched: effects that are laws, and forces that have a name."""
    for effect, _, one in level.effects.said:
        if effect.is_law and not effect.changes_mass:
            yield effect.name
            if name := getattr(one, "name", None):
                yield name
