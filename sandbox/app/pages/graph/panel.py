"""The page of graphs: what is drawn is chosen from lists, and told under the mouse."""

from collections.abc import Sequence

import pygame
from pygame_gui import (
    UI_SELECTION_LIST_DROPPED_SELECTION,
    UI_SELECTION_LIST_NEW_SELECTION,
    UI_TEXT_ENTRY_CHANGED,
)
from pygame_gui.elements import UISelectionList

from sandbox.app.cards.card import heading
from sandbox.app.language import say
from sandbox.app.pages.accuracy.studying import Studying
from sandbox.app.pages.graph.card import graphs, span_of
from sandbox.app.pages.graph.choice import Choice, offered
from sandbox.app.pages.page import Desk
from sandbox.app.widgets.field import Field
from sandbox.app.widgets.sheet import Sheet, below
from sandbox.model.quantities import TIME

LISTS = 168, 92  # px, how high the two lists are
FIELD = 26  # px


class GraphPage:
    """Graphs, and below them the lists of what can be drawn, and against what.

    Attributes
    ----------
    sought
        Where letters are typed that the names in the first list have.
    up, across
        The two lists.
    """

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._choice, self._studying = desk.worker(Choice), desk.worker(Studying)
        self._cursor: float | None = None
        names = self._names = offered(desk.session.level)
        self._graphs = sheet.image(self._drawn(), sheet.margin // 2)
        self._titles = [
            sheet.image(heading(sheet.pen, sheet.width, text), 0)
            for text in (say("Draw"), say("Against"))
        ]
        self.sought = Field(
            pygame.Rect(sheet.margin, 0, sheet.width, sheet.px(FIELD)), sheet.manager,
            container=sheet.container,
            placeholder_text=say("letters of a name, such as speed"),
        )  # fmt: skip
        self._heights = sheet.scaled(LISTS)
        self.up = self._list(
            self._heights[0], names, several=True, chosen=self._choice.up(desk.session)
        )
        across = [TIME.name, *names]
        self.across = self._list(
            self._heights[1], across, several=False, chosen=[self._choice.across(desk.session)]
        )
        self.update()

    def _list(
        self, height: int, names: list[str], *, several: bool, chosen: Sequence[str]
    ) -> UISelectionList:
        """Put a list of quantities, of which one or several can be chosen."""
        rect = pygame.Rect(self._sheet.margin, 0, self._sheet.width, height)
        first: list[str | tuple[str, str]] | str = [*chosen] if several else chosen[0]
        return UISelectionList(
            rect, list(names), self._sheet.manager, container=self._sheet.container,
            allow_multi_select=several, allow_double_clicks=False,
            default_selection=first,
        )  # fmt: skip

    def process(self, event: pygame.event.Event) -> str | None:
        """Draw what was chosen, and follow the mouse."""
        if event.type == pygame.MOUSEMOTION:
            self._follow(event.pos)
            return None
        kinds = (UI_SELECTION_LIST_NEW_SELECTION, UI_SELECTION_LIST_DROPPED_SELECTION)
        if event.type == UI_TEXT_ENTRY_CHANGED and event.ui_element is self.sought:
            self._seek()
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

    def _seek(self) -> None:
        """List the names that have the letters, those that are chosen marked."""
        letters = self.sought.get_text().casefold().strip()
        found = [name for name in self._names if letters in name.casefold()]
        chosen = [name for name in self._choice.up(self._session) if name in found]
        place = self.up.relative_rect
        self.up.kill()
        self.up = self._list(self._heights[0], found, several=True, chosen=chosen)
        self.up.set_relative_position(place.topleft)

    def _choose(self) -> None:
        """Draw what is marked, and what is drawn already and not in the list at present."""
        listed = [str(item["text"]) for item in self.up.item_list]
        drawn = self._choice.up(self._session)
        kept = [name for name in drawn if name not in listed]
        self._choice.choose(self._session, (*kept, *self.up.get_multi_selection()))

    def _follow(self, pixel: tuple[int, int]) -> None:
        """Tell the values under the mouse while it is over the graphs."""
        place = self._graphs.rect
        before, self._cursor = self._cursor, None
        if place.collidepoint(pixel) and self._choice.up(self._session):
            across = self._choice.across(self._session)
            span = span_of(self._sheet.pen, self._sheet.width, self._session, across)
            value = span.value(pixel[0] - place.x)
            self._cursor = min(max(value, span.low), span.high)
        if self._cursor != before:
            self.update()

    def update(self) -> None:
        """Draw the graphs anew, and put the lists below them."""
        sheet = self._sheet
        sheet.replace(self._graphs, self._drawn())
        y = below(self._graphs) + 8
        if y == self._titles[0].relative_rect.y:
            return
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
        sheet.end(y)

    def _drawn(self) -> pygame.Surface:
        sheet, session = self._sheet, self._session
        up, across = self._choice.up(session), self._choice.across(session)
        trust = self._studying.trust(session)
        return graphs(sheet.pen, sheet.width, session, up, across, self._cursor, trust)
