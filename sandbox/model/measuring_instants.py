"""Instants of a run at which something is measured: times, and events such as a contact."""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag

from sandbox.model.base import Model
from sandbox.model.expressions import Expression
from sandbox.model.number_bounds import Coordinate
from sandbox.model.reference_fields import BodyName, Couple, QuantityName

MOST_MEETINGS = 100
"""The most contacts and separations of two bodies that can be counted."""


def _counted(text: object) -> object:
    """Return a quoted number as a number, as results from substituting an index."""
    return int(text) if isinstance(text, str) and text.isdecimal() and len(text) < 5 else text


Nth = Annotated[int, BeforeValidator(_counted), Field(ge=1, le=MOST_MEETINGS)]
"""The occurrence of an event, from 1."""


class ContactEvent(Model):
    """Two bodies begin to touch; measured one step later, when the impact is over.

    An impact that is located in time is measured just after it.
    """

    event: Literal["contact"]
    bodies: Couple
    """the two bodies"""
    nth: Nth = 1
    """which contact of the two, counted from 1; bodies that touch at the start have to separate
    first"""


class SeparationEvent(Model):
    """Two bodies separate; measured at the first step at which they no longer touch."""

    event: Literal["separation"]
    bodies: Couple
    """the two bodies"""
    nth: Nth = 1
    """which separation of the two, counted from 1"""


class CrossingEvent(Model):
    """A quantity crosses a value for the first time; measured between steps."""

    event: Literal["crossing"]
    quantity: QuantityName
    """what crosses it, such as `ball.speed`"""
    value: Expression = Expression(0)
    """the value, in the quantity's unit"""
    direction: Literal["up", "down", "either"] = "either"
    """the direction of the crossing"""


class ApexEvent(Model):
    """A body stops rising for the first time; measured between steps."""

    event: Literal["apex"]
    body: BodyName
    """the body that rises or falls"""


class LandingEvent(Model):
    """A body's centre falls to a height for the first time; measured between steps."""

    event: Literal["landing"]
    body: BodyName
    """the body that rises or falls"""
    height: Coordinate = Coordinate(0)
    """m, the height"""


Passage = CrossingEvent | ApexEvent | LandingEvent
"""An event at which a quantity crosses a value."""


def crossing_of(at: Passage) -> tuple[str, Expression, Literal["up", "down", "either"]]:
    """Return the quantity that crosses a value at an event, the value, and the direction."""
    match at:
        case ApexEvent():
            return f"{at.body}.velocity.y", Expression(0), "down"
        case LandingEvent():
            return f"{at.body}.position.y", at.height, "down"
        case CrossingEvent():
            return at.quantity, at.value, at.direction


def kind_of(at: object) -> str | None:
    """Return the kind of an instant; None if it is unclear."""
    if isinstance(at, Mapping):
        return str(at["event"]) if "event" in at else None
    return str(getattr(at, "event", "a number"))


Instant = Annotated[
    Annotated[Expression, Tag("a number")]
    | Annotated[ContactEvent, Tag("contact")]
    | Annotated[SeparationEvent, Tag("separation")]
    | Annotated[CrossingEvent, Tag("crossing")]
    | Annotated[ApexEvent, Tag("apex")]
    | Annotated[LandingEvent, Tag("landing")],
    Discriminator(kind_of),
]
"""A time [s], or an event."""
