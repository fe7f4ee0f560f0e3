"""Buttons of a long list, which cost time only while they are visible."""

from pygame_gui.elements import UIButton


class Row(UIButton):
    """A button that rests while it is scrolled out of sight.

    pygame_gui asks each button in each frame whether its look has changed. Of some hundred in a
    list two dozen are seen.
    """

    @property
    def in_sight(self) -> bool:
        """Whether any of it is in what its list shows."""
        clip = self._image_clip
        return clip is None or clip.height > 0

    def update(self, time_delta: float) -> None:
        """Take up another look, if it has one."""
        if self.in_sight:
            super().update(time_delta)
