"""pygame_gui's manager, with a theme that looks up a widget's style directly."""

import io
import os
from collections.abc import Sequence
from typing import Any, ClassVar, cast

import pygame
from pygame_gui import PackageResource, UIManager
from pygame_gui.core import UIAppearanceTheme, UIElement
from pygame_gui.elements import UIButton, UIImage

from sandbox.app.widgets.appearance_cache import AppearanceCache
from sandbox.app.widgets.widget_states_and_scrolling import Row

Ids = list[str | None] | None
"""The ids of a widget and of its containers, from the outermost inwards."""


class Manager(UIManager):
    """Manages the widgets of a window."""

    _touched: Sequence[UIElement] = ()
    """the plain widgets that the mouse was over in the last frame, or holds"""
    _pressed: UIElement | None = None
    """the widget that was pressed, until the mouse leaves it"""

    def process_events(self, event: pygame.Event) -> bool:
        """Pass an event to the widgets, and return whether one has used it."""
        if event.type == pygame.MOUSEBUTTONDOWN:
            self._pressed = next((each for each in self._touched if each.hovered), None)
        return super().process_events(event)

    def update(self, time_delta: float) -> None:
        """Update the widgets after some time [s].

        pygame_gui stores the rectangles of removed widgets without ever using them; they are
        cleared here.
        """
        super().update(time_delta)
        self.get_sprite_group().lostsprites.clear()

    def _handle_hovering(self, time_delta: float) -> None:
        """Find the topmost widget under the mouse, the only one that is hovered.

        pygame_gui checks all widgets layer by layer. Here plain widgets are left out unless the
        mouse is or was over them; there are some hundred.
        """
        every = cast("list[UIElement]", self.get_sprite_group().sprites())
        mouse = pygame.Rect(self.mouse_position, (1, 1))
        touched = [each for each in self._touched if each.hovered or getattr(each, "held", False)]
        near = {id(each) for each in (*touched, *mouse.collideobjectsall(every))}
        hovered = [each for each in every if type(each) not in _PLAIN or id(each) in near]
        self._touched = [each for each in hovered if type(each) in _PLAIN]
        handled = False
        for element in reversed(hovered):
            if element.visible and element.check_hover(time_delta, handled):
                self.hovering_any_ui_element = element is not self.root_container
                handled = handled or self.hovering_any_ui_element
        self._hold_back_tip()

    def _hold_back_tip(self) -> None:
        """Show no tip on a widget that was pressed: it would cover what came of it."""
        pressed = self._pressed
        if pressed is None or not (pressed.hovered or getattr(pressed, "held", False)):
            self._pressed = None
        else:
            pressed.hover_time = 0.0

    def create_new_theme(
        self,
        theme_path: str | os.PathLike[str] | io.StringIO | PackageResource | dict[str, Any]
        | None = None,
    ) -> UIAppearanceTheme:  # fmt: skip
        """Return the theme of the widgets."""
        theme = _Theme(self.resource_loader, self._locale)
        theme.shape_cache = AppearanceCache()
        if theme_path is not None:
            theme.load_theme(theme_path)
        return theme


_PLAIN = UIButton, UIImage, Row
"""The widgets that are under the mouse only if it is inside their rectangle, or if they are
held."""


class _Theme(UIAppearanceTheme):
    """A theme that caches the names of a widget's style, by the ids of it and its containers.

    pygame_gui caches them by a text that joins all these ids. Its length grows with the product of
    four lengths, and making it takes longer than finding the names.
    """

    _names: ClassVar[dict[tuple[tuple[str | None, ...] | None, ...], list[str]]] = {}

    def build_all_combined_ids(
        self,
        element_base_ids: Ids,
        element_ids: list[str] | None,
        class_ids: Ids,
        object_ids: Ids,
    ) -> list[str]:
        """Return the names of a widget's style, the most specific first."""
        ids = (element_base_ids, element_ids, class_ids, object_ids)
        key = tuple(None if each is None else tuple(each) for each in ids)
        if key not in self._names:
            self._names[key] = super().build_all_combined_ids(*ids)
        return self._names[key]
