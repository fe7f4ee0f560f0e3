"""Somebody who builds a level: every act is an event, and every click is counted."""

import json
from typing import Any

import pygame
from pygame_gui.core import UIElement

from sandbox.app.building.editor import Editor
from sandbox.app.pages.build.panel import BuildPage
from sandbox.app.widgets.widget_states_and_scrolling import scroll_position, scroll_to
from sandbox.model.shapes import XY
from tests.app.person import Person


class Builder:
    """A person at the Build page.

    Attributes
    ----------
    clicks
        How often a button of the mouse was pressed, on the stage and on the page; drags count.
    """

    def __init__(self, person: Person) -> None:
        self.person = person
        self.clicks = 0
        person.press(pygame.K_b, "b")

    @property
    def page(self) -> BuildPage:
        return self.person.page(BuildPage)

    @property
    def editor(self) -> Editor:
        return self.person.window.workers.of(Editor)

    @property
    def document(self) -> Any:  # noqa: ANN401 (whatever JSON holds)
        return json.loads(self.editor.work.draft.text)

    def new(self) -> None:
        """Begin an empty scene."""
        self.click(self.page.palette.button("New").rect)

    def click(self, place: XY | pygame.Rect) -> None:
        """Click on a widget, or on a pixel of the window."""
        self.clicks += 1
        self.person.click(place)

    def at(self, *point: float) -> None:
        """Click on a point of the plane [m]."""
        self.click(self.person.on_screen((point[0], point[1])))

    def drag(self, start: XY, end: XY) -> None:
        """Drag from a point of the plane to another [m]."""
        self.clicks += 1
        self.person.drag(self.person.on_screen(start), self.person.on_screen(end))

    def tool(self, name: str) -> None:
        """Take a tool in hand, or a joint."""
        self.click(self.page.palette.button(name).rect)

    def act(self, caption: str) -> None:
        """Press a button below the tools."""
        self.reach(self.page.button(caption))
        self.click(self.page.button(caption).rect)

    def reach(self, widget: UIElement) -> None:
        """Scroll with the wheel until a widget can be clicked."""
        container, place = self.page._sheet.container, widget.rect
        if not container.rect.contains(place):
            scroll_to(
                container, scroll_position(container) + place.centery - container.rect.centery
            )
            self.person.wait(0.1)

    def fill(self, typed: str, *path: str | int) -> None:
        """Type into the field of a place in the level, and press Enter."""
        field = self.page.inspector.field(*path)
        self.reach(field)
        self.click(field.rect)
        self.key(pygame.K_a, mod=pygame.KMOD_LCTRL)
        for letter in typed:
            pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=letter))
        self.person.wait(0.05)
        self.key(pygame.K_RETURN, "\r")
        self.person.wait(0.1)

    def pick(self, choice: str, *path: str | int) -> None:
        """Press the button of a choice, at a place in the level."""
        choices = self.page.inspector._lines[path].choices
        button = next(button for button, means in choices.items() if means == choice)
        self.reach(button)
        self.click(button.rect)
        self.person.wait(0.1)

    def open(self, *path: str | int) -> None:
        """Open a section of the fields, if it is not open."""
        inspector = self.page.inspector
        if inspector._opened(path):
            return
        heading = next(button for button, its in inspector._headings.items() if its == path)
        self.reach(heading)
        self.click(heading.rect)
        self.person.wait(0.1)

    def key(self, key: int, text: str = "", mod: int = 0) -> None:
        """Press a key."""
        self.person.press(key, text, mod)

    def control(self, letter: str, mod: int = 0) -> None:
        """Press a key together with Ctrl."""
        self.person.press(pygame.key.key_code(letter), "", pygame.KMOD_LCTRL | mod)
