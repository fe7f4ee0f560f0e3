"""Buttons of a long list, which take time only while they are visible."""

from pygame_gui.elements import UIButton


class Row(UIButton):
    """A button that is not updated while it is scrolled out of view.

    pygame_gui checks each button for changes in every frame. Of some hundred in a list, two dozen
    are visible.
    """

    @property
    def in_sight(self) -> bool:
        """Whether any part of the button is in the visible part of its list."""
        clip = self._image_clip
        return clip is None or clip.height > 0

    def update(self, time_delta: float) -> None:
        """Update the button if it is in view, after some time [s]."""
        if self.in_sight:
            super().update(time_delta)
