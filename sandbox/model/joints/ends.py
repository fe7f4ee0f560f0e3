"""The ends of joints: the points that they hold."""

from collections.abc import Mapping
from typing import Annotated

from pydantic import Discriminator, Tag

from sandbox.model.base import Model
from sandbox.model.number_bounds import Coordinate
from sandbox.model.reference_fields import BodyName
from sandbox.model.shapes import Point


class Held(Model):
    """A point of a body."""

    body: BodyName
    """the body"""
    at: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, relative to the body's position, in its frame"""


ENDS = ("a body", "a point of a body", "a fixed point")
"""The kinds of ends."""


def _end_kind(end: object) -> str | None:
    kinds = ((str,), (Held, Mapping), (list, tuple))
    return next(
        (kind for kind, types in zip(ENDS, kinds, strict=True) if isinstance(end, types)), None
    )


End = Annotated[
    Annotated[BodyName, Tag("a body")]
    | Annotated[Held, Tag("a point of a body")]
    | Annotated[Point, Tag("a fixed point")],
    Discriminator(_end_kind),
]
"""The end of a joint: the centre of a body, a point of it, or a fixed point [x, y] in m."""

BodyEnd = Annotated[
    Annotated[BodyName, Tag("a body")] | Annotated[Held, Tag("a point of a body")],
    Discriminator(_end_kind),
]
"""An end that must be on a body."""
