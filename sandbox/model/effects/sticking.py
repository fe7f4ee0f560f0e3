"""Bodies that stick to each other."""

from typing import Annotated, ClassVar

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import MOST_PAIRS
from sandbox.model.effects.contract import Effect
from sandbox.model.effects.pair import Pair


class Sticking(Model):
    """Bodies that become one at their first touch: the perfectly inelastic collision."""

    effect: ClassVar[Effect] = Effect(name="sticking", acts="scene", smooth=False, book="loss")

    pairs: Annotated[tuple[Pair, ...], Field(min_length=1, max_length=MOST_PAIRS)]
    """who sticks to whom, where and how they first touch"""
