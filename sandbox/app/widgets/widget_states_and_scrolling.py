"""Small helpers for pygame_gui's widgets, shared by several panels."""

from collections.abc import Sequence
from itertools import pairwise

from pygame_gui.core import UIElement
from pygame_gui.elements import UIButton, UIScrollingContainer


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


def show_pressed(button: UIButton, on: bool) -> None:
    """Draw a button as switched on or off."""
    if on and not button.is_selected:
        button.select()  # type: ignore[no-untyped-call]
    elif not on and button.is_selected:
        button.unselect()  # type: ignore[no-untyped-call]


def set_enabled(button: UIButton, possible: bool) -> None:
    """Enable or disable a button."""
    if possible and not button.is_enabled:
        button.enable()  # type: ignore[no-untyped-call]
    elif not possible and button.is_enabled:
        button.disable()  # type: ignore[no-untyped-call]


def show(widget: UIElement, shown: bool) -> None:
    """Show or hide a widget."""
    if shown and not widget.visible:
        widget.show()  # type: ignore[no-untyped-call]
    elif not shown and widget.visible:
        widget.hide()  # type: ignore[no-untyped-call]


def stretched(widths: Sequence[int], room: int) -> list[int]:
    """Return widths, increased equally, that together fill the available width [px]."""
    spare = max(room - sum(widths), 0)
    ends = [spare * i // len(widths) for i in range(len(widths) + 1)]
    return [own + b - a for own, (a, b) in zip(widths, pairwise(ends), strict=True)]


def scroll_to(container: UIScrollingContainer, top: float) -> None:
    """Scroll a container to a height of its contents [px], as far as possible."""
    bar = container.vert_scroll_bar
    seen, height = container.rect.height, container.scrollable_container.rect.height
    if bar is not None:
        bar.set_scroll_from_start_percentage(max(min(top, height - seen), 0.0) / height)


def scroll_position(container: UIScrollingContainer) -> float:
    """Return the height of the contents at the upper edge of a container [px]."""
    return float(container.rect.y - container.scrollable_container.rect.y)
