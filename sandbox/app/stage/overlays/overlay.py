"""The declaration of an overlay of the stage, from which everything else about it is derived."""

from collections.abc import Callable
from dataclasses import dataclass

import pygame

from sandbox.app.keys import Binding
from sandbox.app.stage.view import View
from sandbox.model.level import Level

Draw = Callable[[pygame.Surface, View], None]


@dataclass(frozen=True, slots=True)
class Overlay:
    """The declaration of an explanation that is drawn over the scene, and that a key switches.

    Raises
    ------
    ValueError
        If a part is missing.
    """

    name: str
    """the name of its module, and of the command that switches it"""
    key: str
    """the letter, or the sign, that switches it off and on"""
    text: str
    """what the help says"""
    draw: Draw | None = None
    """draws it over the bodies, every frame"""
    draw_below: Draw | None = None
    """draws what stands below the bodies and stays as it is, until the camera moves"""
    draw_trail: bool = False
    """whether it is the trail, which the stage keeps on a canvas of its own"""
    caption: str = ""
    """of its button in the bar below; without one it has no button"""
    on: Callable[[Level], bool] | None = None
    """whether a level asks for it when it is opened; else it stays as it was, at first on"""

    def __post_init__(self) -> None:
        for part in ("name", "key", "text"):
            if not getattr(self, part):
                raise ValueError(self._lacks(f"a {part}"))
        if not (self.draw or self.draw_below or self.draw_trail):
            raise ValueError(self._lacks("something to draw"))

    def _lacks(self, part: str) -> str:
        where = f"sandbox/app/stage/overlays/{self.name}.py"
        return f"overlay '{self.name}' lacks {part}; say it in {where}"

    @property
    def binding(self) -> Binding:
        """Its key."""
        letters = "".join(dict.fromkeys((self.key, self.key.upper())))
        return Binding(self.name, self.key.upper(), self.text, (), letters)
