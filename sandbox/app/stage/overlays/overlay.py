"""The declaration of an overlay of the stage, from which everything else about it is derived."""

from collections.abc import Callable
from dataclasses import dataclass

import pygame

from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.window_keys import Binding
from sandbox.model.level import Level

Draw = Callable[[pygame.Surface, DrawingContext], None]


@dataclass(frozen=True, slots=True)
class Overlay:
    """The declaration of an overlay, which is drawn over the scene and switched by a key.

    Raises `ValueError` if a part is missing.
    """

    name: str
    """the name of its module, and of the command that switches it"""
    key: str
    """the character that switches it on and off"""
    text: str
    """the text in the help"""
    draw: Draw | None = None
    """draws the overlay over the bodies in every frame"""
    draw_below: Draw | None = None
    """draws the part below the bodies, which is static until the camera moves"""
    draw_trail: bool = False
    """whether it is the trail, for which the stage has its own canvas"""
    caption: str = ""
    """the caption of its button: in the bar below, or on the page Forces if a level switches it;
    empty for no button"""
    on: Callable[[Level], bool] | None = None
    """whether a level switches it on when it is opened; None for on at first, then unchanged"""

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
        """The key binding of the overlay."""
        letters = "".join(dict.fromkeys((self.key, self.key.upper())))
        return Binding(self.name, self.key.upper(), self.text, (), letters)
