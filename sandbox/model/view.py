"""The visible part of a level, and the labels in it."""

from typing import Annotated

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.body import MAX_BODIES
from sandbox.model.bounds import Coordinate, Extent
from sandbox.model.joints import End
from sandbox.model.landscape import Landscape
from sandbox.model.prose_fields import Prose
from sandbox.model.reference_fields import BodyNames
from sandbox.model.shapes import Point

MAX_LABELS = 100
"""The most labels in a level."""


class Label(Model):
    """Words on the stage."""

    text: Annotated[Prose, Field(min_length=1, max_length=80)]
    """one short line"""
    at: End
    """the body, the point of a body or the fixed point [x, y] that they are written over"""


class View(Model):
    """What part of the plane is shown, and what is written on it."""

    center: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, of the middle of the picture"""
    width: Extent = Extent(10)
    """m, of the picture"""
    middle: Annotated[float, Field(gt=0, le=1)] = 1.0
    """the part of the width, about the center, in which things happen; a picture that is less wide
    than 16 : 9 need not show more of it, and all is drawn larger"""
    components: bool = False
    """whether velocities are drawn with their components"""
    labels: Annotated[tuple[Label, ...], Field(max_length=MAX_LABELS)] = ()
    """words at points or on bodies, always written"""
    together: Annotated[
        tuple[Annotated[BodyNames, Field(min_length=2)], ...], Field(max_length=MAX_BODIES)
    ] = ()
    """groups of bodies that the editor selects with one click; no body is in two"""
    landscape: Landscape | None = None
    """a body's potential, drawn as a curve over the places that it can reach"""
