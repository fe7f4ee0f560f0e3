"""The page Graph: lists to choose from, and the values under the mouse."""

from collections.abc import Callable
from functools import partial

import pygame
from pygame_gui import (
    UI_BUTTON_PRESSED,
    UI_SELECTION_LIST_DROPPED_SELECTION,
    UI_SELECTION_LIST_NEW_SELECTION,
    UI_TEXT_ENTRY_CHANGED,
)
from pygame_gui.elements import UIButton

from sandbox.app.cards.text_column import heading
from sandbox.app.drawing import theme
from sandbox.app.pages.accuracy.background_study import BackgroundStudy
from sandbox.app.pages.graph.card import graphs, span_of
from sandbox.app.pages.graph.chosen_quantities import Choice, offered, words_for_search
from sandbox.app.pages.graph.matplotlib_figure import figure
from sandbox.app.pages.graph.zoom import NOTCH, SHIFT, WHOLE, Zooming
from sandbox.app.pages.page import Desk
from sandbox.app.pages.share import saving
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.widgets.text_field import TextField
from sandbox.app.words.language import say
from sandbox.model.quantities import TIME

LISTS = 168, 92  # px, the heights of the two lists
BUTTON = 26  # px, the height of a button
GAP = 6  # px, between buttons
FIELD = 26  # px
LOW = 380  # px, the height of a page below which the buttons stand after the lists


class GraphPage:
    """Graphs, and lists of the quantities that can be drawn and used as an axis."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._choice, self._studying = desk.worker(Choice), desk.worker(BackgroundStudy)
        self._cursor: float | None = None
        self._zooming = Zooming(self._choice.zoom(desk.session))
        names = self._names = offered(desk.session.level)
        self._graphs = sheet.image(self._drawn(), sheet.margin // 2)
        self._acts: dict[UIButton, Callable[[], str]] = {}
        self._rows = self._buttons()
        self._titles = [
            sheet.image(heading(sheet.pen, sheet.width, text), 0)
            for text in (say("Draw"), say("Against"))
        ]
        self.sought = TextField(
            pygame.Rect(sheet.margin, 0, sheet.width, sheet.px(FIELD)), sheet.manager,
            container=sheet.container,
            placeholder_text=say("letters of a name, such as speed"),
        )  # fmt: skip
        """The field that filters the names in the first list."""
        self._heights = sheet.scaled(LISTS)
        up, across = self._choice.up(desk.session), self._choice.across(desk.session)
        self.up = sheet.choices(names, self._heights[0], up)
        self.across = sheet.choices([TIME.name, *names], self._heights[1], across)
        """The two lists."""
        self.update()

    def process(self, event: pygame.event.Event) -> str | None:
        """Handle buttons, choices in the lists, and the mouse over the graphs."""
        if event.type == UI_BUTTON_PRESSED and event.ui_element in self._acts:
            return self._acts[event.ui_element]()
        if event.type in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
            answer = self._zoomed(self._button(event))
            self._go_to_click()
            return answer
        if event.type == pygame.MOUSEMOTION:
            self._follow(event.pos)
            return self._zoomed(self._zooming.move(self._inside(event.pos)))
        kinds = (UI_SELECTION_LIST_NEW_SELECTION, UI_SELECTION_LIST_DROPPED_SELECTION)
        if event.type == UI_TEXT_ENTRY_CHANGED and event.ui_element is self.sought:
            self._list_matches()
            return None
        if event.type not in kinds:
            return None
        if event.ui_element is self.up:
            self._choose()
        elif event.ui_element is self.across and event.type == UI_SELECTION_LIST_NEW_SELECTION:
            self._choice.against(self._session, str(self.across.get_single_selection()))
            self._cursor = None
        else:
            return None
        return ""

    def _buttons(self) -> list[list[UIButton]]:
        """Make the buttons that zoom, and those that save the visible part."""
        step, px = self._zooming.step, self._sheet.px
        zooming: tuple[tuple[str, str, Callable[[], object]], ...] = (
            ("+", say("zoom in (the wheel over a graph)"), partial(step, NOTCH)),
            ("−", say("show a longer interval"), partial(step, 1 / NOTCH)),
            ("<", say("show earlier times"), partial(step, 1.0, -SHIFT)),
            (">", say("show later times"), partial(step, 1.0, SHIFT)),
            (
                say("All"),
                say("show the whole graph (Home, or a double click on it)"),
                self._show_all,
            ),
        )
        saving = (
            (say("Save picture"), say("save this view as a PNG"), self._save_picture),
            (say("Save CSV"), say("save the values in view"), self._save_table),
        )
        rows: list[list[UIButton]] = []
        for row in (zooming, saving):
            wide = (self._sheet.width - (len(row) - 1) * GAP) // len(row)
            place = pygame.Rect(0, 0, wide, px(BUTTON))
            rows.append([])
            for i, (caption, tip, act) in enumerate(row):
                button = self._sheet.button(place.move(i * (wide + GAP), 0), caption, tip)
                rows[-1].append(button)
                self._acts[button] = partial(self._act, act)
        return rows

    def button(self, caption: str) -> UIButton:
        """Return the button with a caption."""
        return next(button for button in self._acts if button.text == caption)

    def _act(self, act: Callable[[], object]) -> str:
        """Execute the action of a button, and return its message."""
        message = act()
        self._zoomed(changed=True)
        return message if isinstance(message, str) else ""

    def _show_all(self) -> None:
        self._zooming.zoom = WHOLE

    def _save_table(self) -> str:
        session, choice = self._session, self._choice
        up, across = choice.up(session), choice.across(session)
        path = saving.graph_table(session, up, across, choice.zoom(session).across)
        return say("saved {path}", path=path)

    def _save_picture(self) -> str:
        choice, session = self._choice, self._session
        up, across = choice.up(session), choice.across(session)
        found = figure(session, up, across, self._zooming.graphs)
        if found is None:
            return say("There is no graph to save; choose a quantity")
        return choice.draw(found, saving.path_for(session, ".png"))

    def _inside(self, pixel: tuple[int, int]) -> tuple[int, int]:
        """Return the position of a pixel of the window in the picture of the graphs."""
        return pixel[0] - self._graphs.rect.x, pixel[1] - self._graphs.rect.y

    def _is_visible_at(self, pixel: tuple[int, int]) -> bool:
        """Return whether the graphs are visible at a pixel of the window."""
        seen = self._sheet.container.rect.collidepoint(pixel)
        return seen and bool(self._graphs.rect.collidepoint(pixel))

    def _button(self, event: pygame.event.Event) -> bool:
        """Handle a press or release of a mouse button, and return whether it was for the graphs."""
        if event.type == pygame.MOUSEBUTTONUP:
            return self._zooming.release()
        shifted = bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)
        inside = self._inside(event.pos)
        return self._is_visible_at(event.pos) and self._zooming.press(
            inside, event.button, shifted=shifted
        )

    def _go_to_click(self) -> None:
        """Go to the time that was clicked on, if there is one."""
        t, self._zooming.clicked = self._zooming.clicked, None
        if t is None or self._choice.across(self._session) != TIME.name:
            return
        session = self._session
        session.go_to(min(round(t / session.world.dt), session.run.farthest.steps()))

    def wheel(self, notches: float, pixel: tuple[int, int]) -> bool:
        """Zoom about the mouse, if it is over a graph, and return whether it is."""
        shifted = bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)
        inside = self._inside(pixel)
        over = self._is_visible_at(pixel) and self._zooming.wheel(notches, inside, shifted=shifted)
        return self._zoomed(over) is not None

    def home(self) -> bool:
        """Show the whole graphs, and return whether they were zoomed."""
        zoomed = bool(self._zooming.zoom)
        self._show_all()
        return self._zoomed(zoomed) is not None

    def _zoomed(self, changed: bool) -> str | None:
        """Redraw if the visible part has changed; return an empty message then, else None."""
        if not changed:
            return None
        self._choice.set_zoom(self._session, self._zooming.zoom)
        self.update()
        return ""

    def _list_matches(self) -> None:
        """List the names that contain all typed words, with the chosen ones marked."""
        words = self.sought.get_text().casefold().split()
        found = [name for name in self._names if all(w in words_for_search(name) for w in words)]
        chosen = [name for name in self._choice.up(self._session) if name in found]
        place = self.up.relative_rect
        self.up.kill()
        self.up = self._sheet.choices(found, self._heights[0], chosen)
        self.up.set_relative_position(place.topleft)

    def _choose(self) -> None:
        """Choose the marked quantities, and keep chosen ones that are filtered out."""
        listed = [str(item["text"]) for item in self.up.item_list]
        drawn = self._choice.up(self._session)
        others = [name for name in drawn if name not in listed]
        self._choice.choose(self._session, (*others, *self.up.get_multi_selection()))

    def _follow(self, pixel: tuple[int, int]) -> None:
        """Show the values under the mouse while it is over the graphs."""
        place = self._graphs.rect
        before, self._cursor = self._cursor, None
        if place.collidepoint(pixel) and self._choice.up(self._session):
            across = self._choice.across(self._session)
            span = span_of(self._sheet.pen, self._sheet.width, self._session, across)
            span = self._zooming.zoom.visible_scale(span)
            value = span.value(pixel[0] - place.x)
            self._cursor = min(max(value, span.low), span.high)
        if self._cursor != before:
            self.update()

    def update(self) -> None:
        """Draw the graphs again, and place the lists below them."""
        sheet = self._sheet
        sheet.replace(self._graphs, self._drawn())
        y, low = below(self._graphs) + 8, sheet.height < sheet.px(LOW)
        first = self._titles[0] if low else self._rows[0][0]
        if y == first.relative_rect.y:
            return
        if not low:
            y = self._put_rows(y)
        for title, chooser, height in zip(
            self._titles, (self.up, self.across), self._heights, strict=True
        ):
            title.set_relative_position((self._sheet.margin, y))
            y = below(title)
            if chooser is self.up:
                self.sought.set_relative_position((self._sheet.margin, y))
                y += self._sheet.px(FIELD) + 2
            chooser.set_relative_position((self._sheet.margin, y))
            y += height + 8
        sheet.set_content_height(self._put_rows(y) if low else y)

    def _put_rows(self, y: int) -> int:
        """Place the rows of buttons, and return the height of what comes below them [px]."""
        for row in self._rows:
            for button in row:
                button.set_relative_position((button.relative_rect.x, y))
            y += self._sheet.px(BUTTON) + GAP
        return y

    def _drawn(self) -> pygame.Surface:
        sheet, session = self._sheet, self._session
        up, across = self._choice.up(session), self._choice.across(session)
        self._studying.ask_for_trust()
        trust = self._studying.trust(session)
        zooming = self._zooming
        zooming.zoom = self._choice.zoom(session)
        picture, zooming.graphs = graphs(
            sheet.pen,
            sheet.width,
            session,
            up,
            across,
            self._cursor,
            trust,
            zooming.zoom,
            sheet.height,
        )
        if zooming.box is not None:
            pygame.draw.rect(picture, theme.NOTICE, zooming.box, 1)
        return picture
