"""Bodies that can turn."""

from typing import ClassVar

from sandbox.model.base import Model
from sandbox.model.effects.contract import Effect


class Rotation(Model):
    """Bodies can turn. Without it every moment of inertia is infinite."""

    effect: ClassVar[Effect] = Effect(name="rotation", acts="scene", trial={})
