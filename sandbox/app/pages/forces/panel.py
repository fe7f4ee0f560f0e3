"""The page Forces: the diagram, the choice of axes, and what else the stage can show."""

from collections.abc import Iterable, Iterator

import pygame
from pygame_gui import UI_BUTTON_PRESSED
from pygame_gui.elements import UIButton

from sandbox.app.cards.text_column import heading
from sandbox.app.pages.forces.card import forces
from sandbox.app.pages.forces.component_axes import Axes
from sandbox.app.pages.page import Desk
from sandbox.app.stage.overlays.register import OVERLAYS
from sandbox.app.widgets.scrolling_area import Sheet, below, in_rows
from sandbox.app.widgets.widget_states_and_scrolling import show_pressed
from sandbox.app.words.language import say

HEIGHT = 26  # px, of a button
GAP = 6  # px, between buttons


class ForcesPage:
    """Shows the forces on a body, with components along the chosen axes."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._axes = desk.worker(Axes)
        half = sheet.width // 2 - 2
        across = pygame.Rect(0, 0, half, sheet.px(HEIGHT))
        along = across.move(half + 4, 0)
        self.level = sheet.button(
            across, say("Along x and y"), say("components along the plane's axes")
        )
        tip = say("components along and across the surface that it touches, or else its path")
        self.inclined = sheet.button(along, say("Along its surface"), tip)
        self._image = sheet.image(self._drawn(), sheet.px(HEIGHT) + sheet.margin // 2)
        whole = pygame.Rect(0, 0, sheet.width, sheet.px(HEIGHT))
        tip = say("see it from the selected body, the centre of mass, or the ground")
        self.observer = sheet.button(whole, say("Change the observer"), f"{tip} (4)")
        self._title = sheet.image(heading(sheet.pen, sheet.width, say("On the stage")), 0)
        self._shown = desk.shown
        switched = [each for each in OVERLAYS if each.caption and each.on is not None]
        places = self._rows(say(each.caption) for each in switched)
        self._overlays = {
            each.name: sheet.button(
                place, say(each.caption), f"{say(each.text)} ({each.key.upper()})"
            )
            for each, place in zip(switched, places, strict=True)
        }
        self._update_buttons()
        sheet.set_content_height(self._place(below(self._image) + 4))

    def command_of(self, button: object) -> str | None:
        """Return the command of a button; None if it is not one of these."""
        pressed = (name for name, each in self._overlays.items() if each is button)
        return "observe" if button is self.observer else next(pressed, None)

    def overlay(self, name: str) -> UIButton:
        """Return the button that shows or hides an overlay of the stage."""
        return self._overlays[name]

    @property
    def _buttons(self) -> tuple[tuple[UIButton, bool], ...]:
        return (self.level, False), (self.inclined, True)

    def process(self, event: pygame.event.Event) -> str | None:
        """Choose the axes."""
        if event.type != UI_BUTTON_PRESSED:
            return None
        for button, inclined in self._buttons:
            if event.ui_element is button:
                if self._axes.inclined is not inclined:
                    self._axes.switch()
                return ""
        return None

    def update(self) -> None:
        """Draw the forces again."""
        self._update_buttons()
        self._sheet.replace(self._image, self._drawn())
        y = below(self._image) + 4
        if y != self._title.relative_rect.y:
            self._sheet.set_content_height(self._place(y))

    def _update_buttons(self) -> None:
        for button, inclined in self._buttons:
            show_pressed(button, self._axes.inclined is inclined)
        for name, button in self._overlays.items():
            show_pressed(button, self._shown[name])

    def _rows(self, captions: Iterable[str]) -> Iterator[pygame.Rect]:
        """Return the places of buttons in rows, below each other [px]."""
        sheet = self._sheet
        return in_rows(map(sheet.widest_button, captions), sheet.width, sheet.px(HEIGHT), GAP)

    def _place(self, y: int) -> int:
        """Place what is below the diagram, from a height on, and return the height of its end."""
        sheet = self._sheet
        self._title.set_relative_position((sheet.margin, y))
        y, high = below(self._title), sheet.px(HEIGHT)
        places = self._rows(button.text for button in self._overlays.values())
        for button, place in zip(self._overlays.values(), places, strict=True):
            button.set_dimensions(place.size)
            button.set_relative_position((sheet.margin + place.x, y + place.y))
            end = y + place.bottom
        self.observer.set_relative_position((sheet.margin, end + GAP))
        return end + 2 * GAP + high

    def _drawn(self) -> pygame.Surface:
        return forces(self._sheet.pen, self._sheet.width, self._session, self._axes)
