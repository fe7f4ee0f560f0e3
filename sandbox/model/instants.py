"""When something is measured: at a time, or when something happens for the first time."""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Discriminator, Tag

from sandbox.model.base import Model
from sandbox.model.bounds import Coordinate
from sandbox.model.expressions import Expression
from sandbox.model.mention import BodyName, Couple, QuantityName


class ContactEvent(Model):
    """Two bodies first come to touch; measured one step later, when the impact is over.

    Just after the impact itself where it is located in time.
    """

    event: Literal["contact"]
    bodies: Couple


class CrossingEvent(Model):
    """A quantity crosses a value for the first time; measured between steps."""

    event: Literal["crossing"]
    quantity: QuantityName
    value: Expression = Expression(0)
    direction: Literal["up", "down", "either"] = "either"


class ApexEvent(Model):
    """A body stops rising for the first time; measured between steps."""

    event: Literal["apex"]
    body: BodyName


class LandingEvent(Model):
    """A body's centre falls to a height for the first time; measured between steps."""

    event: Literal["landing"]
    body: BodyName
    height: Coordinate = Coordinate(0)
    """m"""


def _kind(at: object) -> str | None:
    if isinstance(at, Mapping):
        return str(at["event"]) if "event" in at else None
    return str(getattr(at, "event", "a number"))


Instant = Annotated[
    Annotated[Expression, Tag("a number")]
    | Annotated[ContactEvent, Tag("contact")]
    | Annotated[CrossingEvent, Tag("crossing")]
    | Annotated[ApexEvent, Tag("apex")]
    | Annotated[LandingEvent, Tag("landing")],
    Discriminator(_kind),
]
"""A time [s], or an event."""
