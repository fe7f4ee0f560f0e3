"""The visible part of a level, and the labels in it."""

from typing import Annotated

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.body import MAX_BODIES
from sandbox.model.joints import End
from sandbox.model.landscape import Landscape
from sandbox.model.number_bounds import Coordinate, Extent
from sandbox.model.prose_fields import Prose
from sandbox.model.reference_fields import BodyNames
from sandbox.model.shapes import Point

MAX_LABELS = 100
"""The most labels in a level."""


class Label(Model):
    """A text in the scene."""

    text: Annotated[Prose, Field(min_length=1, max_length=80)]
    """one short line"""
    at: End
    """the body, point of a body, or fixed point [x, y] over which it is written"""


class View(Model):
    """The visible part of the plane, and the labels in it."""

    center: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the centre of the picture"""
    width: Extent = Extent(10)
    """m, the width of the picture"""
    middle: Annotated[float, Field(gt=0, le=1)] = 1.0
    """the share of the width, about the centre, in which everything happens; a picture narrower
    than 16 : 9 then need not show more, and everything is drawn larger"""
    components: bool = False
    """whether velocities are drawn with their components"""
    labels: Annotated[tuple[Label, ...], Field(max_length=MAX_LABELS)] = ()
    """texts over bodies or points, always shown"""
    together: Annotated[
        tuple[Annotated[BodyNames, Field(min_length=2)], ...], Field(max_length=MAX_BODIES)
    ] = ()
    """groups of bodies that the editor selects with one click; no body may be in two groups"""
    landscape: Landscape | None = None
    """a potential, drawn as a curve over the position, with a body's point on it"""
