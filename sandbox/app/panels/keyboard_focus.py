"""Keyboard focus: Tab moves it from widget to widget, and a ring marks the focused one."""

from collections.abc import Mapping, Sequence

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UI_HORIZONTAL_SLIDER_MOVED, UIManager
from pygame_gui.core import UIElement
from pygame_gui.elements import UIButton, UIHorizontalSlider, UIScrollingContainer

from sandbox.app.drawing import theme
from sandbox.app.panels.window_layout import WindowLayout
from sandbox.app.widgets.text_field import TextField
from sandbox.app.widgets.widget_states_and_scrolling import scroll_position, scroll_to

Containers = Mapping[int, UIScrollingContainer]
Stop = UIButton | TextField | UIHorizontalSlider
"""The widgets that can have the focus."""
PRESSING = (pygame.K_RETURN, pygame.K_KP_ENTER, pygame.K_SPACE)
SLIDING = {pygame.K_LEFT: -1, pygame.K_DOWN: -1, pygame.K_RIGHT: 1, pygame.K_UP: 1}
RING = 2  # px
APART = 2  # px, between a widget and its ring
DIALOG = "file_dialog"
"""The prefix of the ids of the file dialog's parts."""
INNER = ("#sliding_button", "scroll_bar", "#left_button", "#right_button")
"""The ids of the inner parts of sliders and scroll bars, which cannot have the focus."""


class KeyboardFocus:
    """The keyboard focus among the widgets of a window."""

    def __init__(self) -> None:
        self._at: Stop | None = None
        self._around: list[UIScrollingContainer] = []  # the containers in which it scrolls
        self._known = "", 0  # its text and index, to find it again after a rebuild

    @property
    def lost(self) -> bool:
        """Whether the focused widget is gone, and its replacement has not been found yet."""
        return self._at is not None and not _seen(self._at)

    def element(self, manager: UIManager, layout: WindowLayout) -> Stop | None:
        """Return the focused widget, or its replacement after the widgets were rebuilt."""
        if not self.lost:
            return self._at
        words, place = self._known
        alike = [(abs(i - place), each) for i, each in enumerate(stops(manager, layout))
                 if _text_of(each) == words]  # fmt: skip
        self._at = min(alike, key=lambda found: found[0])[1] if alike and words else None
        self._around = _scrolling(self._at, _containers(manager)) if self._at is not None else []
        return self._at

    def move(self, manager: UIManager, layout: WindowLayout, direction: int) -> None:
        """Move to the next or the previous widget, and scroll it into view."""
        found = stops(manager, layout)
        if not found:
            return
        typed = next((e for e in found if isinstance(e, TextField) and e.is_focused), None)
        current = typed or self.element(manager, layout)
        start = found.index(current) if current in found else (-1 if direction > 0 else 0)
        place = (start + direction) % len(found)
        at = self._at = found[place]
        self._known = _text_of(at), place
        manager.set_focus_set(at.get_focus_set() if isinstance(at, TextField) else None)
        if isinstance(at, TextField):
            at.select_range = [0, len(at.get_text())]
        self._around = _scrolling(at, _containers(manager))
        for container in self._around:
            _show(container, at)

    def leave(self) -> bool:
        """Take the focus from a button or slider, and return whether one had it."""
        had = self._at is not None and not isinstance(self._at, TextField)
        self._at, self._around = None, []  # a container would keep all widgets of its time
        return had

    def key(self, manager: UIManager, layout: WindowLayout, event: pygame.event.Event) -> bool:
        """Handle a key for the focused button or slider, and return whether it had an effect."""
        if any(isinstance(each, TextField) for each in manager.focused_set or ()):
            return False
        at = self.element(manager, layout)
        if event.mod & (pygame.KMOD_CTRL | pygame.KMOD_ALT | pygame.KMOD_META):
            return False
        if isinstance(at, UIButton) and event.key in PRESSING:
            pygame.event.post(pygame.Event(UI_BUTTON_PRESSED, ui_element=at, mouse_button=1))
            return True
        if isinstance(at, UIHorizontalSlider) and event.key in SLIDING:
            _move_slider(at, SLIDING[event.key])
            return True
        return False

    def draw(self, surface: pygame.Surface, manager: UIManager, layout: WindowLayout) -> None:
        """Draw a ring around the visible part of the focused widget."""
        at = self.element(manager, layout)
        if at is None or (isinstance(at, TextField) and not at.is_focused):
            return
        surface.set_clip(surface.get_rect())
        for container in self._around:
            surface.set_clip(surface.get_clip().clip(container.rect.inflate(2 * APART, 0)))
        ring = at.rect.inflate(2 * (APART + RING), 2 * (APART + RING))
        pygame.draw.rect(surface, theme.NOTICE, ring, RING, border_radius=6)
        surface.set_clip(None)


def stops(manager: UIManager, layout: WindowLayout) -> Sequence[Stop]:
    """Return the widgets that can have the focus, in the order of Tab.

    These are the widgets on the page of the side panel, around it, in the bar below, around and in
    the list of levels, and on the stage; while the file dialog is open, only those of the dialog.
    """
    every = [each for each in manager.get_sprite_group().sprites() if isinstance(each, Stop)]
    found = [each for each in every if _is_a_stop(each)]
    found = [each for each in found if DIALOG in each.most_specific_combined_id] or found
    fields = {id(each.ui_container) for each in found if isinstance(each, TextField)}
    elements = [
        each
        for each in found
        if not (isinstance(each, UIHorizontalSlider) and id(each.ui_container) in fields)
    ]  # the slider of a parameter is skipped: the arrow keys do the same in its field
    containers = _containers(manager)
    return sorted(elements, key=lambda each: _rank(layout, each, containers))


def _is_a_stop(each: Stop) -> bool:
    inner = any(part in each.most_specific_combined_id for part in INNER)
    return _seen(each) and each.is_enabled and not inner


def _seen(each: UIElement) -> bool:
    return bool(each.alive() and each.visible)  # type: ignore[no-untyped-call]


def _rank(layout: WindowLayout, each: UIElement, containers: Containers) -> tuple[int, int, int]:
    x, y = each.rect.center
    scrolls = bool(_scrolling(each, containers))
    if layout.side.left <= x and (scrolls or y < layout.controls.top) and layout.side.width:
        part = 0 if scrolls else 1
    elif x < layout.levels.right and (scrolls or y < layout.controls.top):
        part = 4 if scrolls else 3
    else:
        part = 2 if y >= layout.controls.top else 5
    return part, each.rect.y, each.rect.x


def _containers(manager: UIManager) -> Containers:
    """Return the scrolling containers, by the ids of their contents."""
    every = manager.get_sprite_group().sprites()
    found = [each for each in every if isinstance(each, UIScrollingContainer)]
    return {id(each.scrollable_container): each for each in found}


def _scrolling(each: UIElement, containers: Containers) -> list[UIScrollingContainer]:
    """Return the containers in which a widget scrolls, the innermost first."""
    found = []
    container: object = each.ui_container
    while isinstance(container, UIElement):
        if id(container) in containers:
            found.append(containers[id(container)])
        beyond: object = container.ui_container
        container = None if beyond is container else beyond  # the outermost contains itself
    return found


def _show(container: UIScrollingContainer, each: UIElement) -> None:
    """Scroll a widget to the middle, unless it is visible."""
    view, place = container.rect, each.rect
    if place.top < view.top or place.bottom > view.bottom:
        scroll_to(container, scroll_position(container) + place.centery - view.centery)


def _move_slider(slider: UIHorizontalSlider, direction: int) -> None:
    """Move a slider by a step, as if its knob had been dragged."""
    low, high = slider.value_range
    value = min(max(slider.get_current_value() + direction * slider.increment, low), high)
    slider.set_current_value(value)
    pygame.event.post(pygame.Event(UI_HORIZONTAL_SLIDER_MOVED, ui_element=slider, value=value))


def _text_of(each: UIElement) -> str:
    """Return the text of a button, or the type of another widget."""
    return str(getattr(each, "text", "")) if isinstance(each, UIButton) else type(each).__name__
