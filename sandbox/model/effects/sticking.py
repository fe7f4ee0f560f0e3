"""Bodies that stick to each other."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.effects.contact import Pair
from sandbox.model.effects.contract import Effect
from sandbox.model.number_bounds import MOST_PAIRS


class Sticking(Model):
    """Perfectly inelastic collisions: two bodies become one when they first touch."""

    effect: ClassVar[Effect] = Effect(name="sticking", acts="scene", smooth=False, book="loss")

    pairs: Annotated[tuple[Pair, ...], Field(min_length=1, max_length=MOST_PAIRS)]
    """the pairs that stick together, just as they first touch"""
