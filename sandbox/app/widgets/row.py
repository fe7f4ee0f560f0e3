"""Buttons of a long list, of which only those in sight take time."""

from pygame_gui.elements import UIButton


class Row(UIButton):
    """A button that rests while it is scrolled out of sight.

    pygame_gui asks each button in each frame whether its look changes and whether the mouse is over
    it. Of some hundred in a list two dozen are seen.
    """

    @property
    def in_sight(self) -> bool:
        """Whether any of it is seen."""
        clip = self.get_image_clipping_rect()
        return bool(self.visible) and (clip is None or clip.height > 0)

    def update(self, time_delta: float) -> None:
        """Take up another look, if it has one."""
        if self.in_sight:
            super().update(time_delta)

    def check_hover(self, time_delta: float, hovered_higher_element: bool) -> bool:
        """Return whether the mouse is over it, and nothing above it is."""
        if not (self.in_sight or self.hovered or self.held):
            return False
        return bool(super().check_hover(time_delta, hovered_higher_element))
