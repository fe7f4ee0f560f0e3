"""The page Experiment: a curve, lists of parameters and measures, and a button that saves it."""

from typing import TYPE_CHECKING

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UI_SELECTION_LIST_NEW_SELECTION

from sandbox.app.cards.text_column import heading
from sandbox.app.pages.experiment.background_parameter_sweep import Point
from sandbox.app.pages.experiment.card import curve, named, nearest, shown_as, span_of
from sandbox.app.pages.experiment.parameter_curve import CurveWorker, measures
from sandbox.app.pages.experiment.saved_curve import save
from sandbox.app.pages.page import Desk
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.words import formatting
from sandbox.app.words.language import say

if TYPE_CHECKING:
    from pygame_gui.elements import UIButton, UISelectionList

ROW = 20  # px, of a list
HEIGHT = 28  # px, of the button
MOST_ROWS = 4, 8  # visible rows of the two lists


class ExperimentPage:
    """A curve, and lists of the parameters and measures to choose from."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._exploring = desk.worker(CurveWorker)
        self._mouse: Point | None = None
        self._field = pygame.Rect(0, 0, 0, 0)
        self._curve = sheet.image(self._drawn(), sheet.margin // 2)
        self.lists: list[UISelectionList] = []
        self._titles = []
        self._rows: list[dict[str, str]] = []  # of each list: what is shown, and what is chosen
        self.save: UIButton | None = None
        """The button that saves the curve; None without parameters."""
        chosen = self._exploring.chosen(desk.session)
        if chosen is not None:
            caption = say("Save as CSV")
            place = pygame.Rect(0, 0, sheet.widest_button(caption), sheet.px(HEIGHT))
            self.save = sheet.button(place, caption, say("save the points of the curve"))
            for title, rows, now, most in zip(
                (say("Vary"), say("Measure")), self._offers(), chosen, MOST_ROWS, strict=True
            ):
                self._titles.append(sheet.image(heading(sheet.pen, sheet.width, title), 0))
                height = min(len(rows), most) * sheet.px(ROW) + 12
                shown = next(each for each, offered in rows.items() if offered == now)
                self._rows.append(rows)
                self.lists.append(sheet.choices([*rows], height, shown))
        self._seen: object = None
        self.update()

    def _offers(self) -> tuple[dict[str, str], dict[str, str]]:
        """Return the parameters and the measures, by the text that is shown for each."""
        level, original = self._session.level, self._session.original
        offered = measures(self._session)
        titles = [shown_as(original, each) for each in offered]
        named_twice = {title for title in titles if titles.count(title) > 1}
        return {named(level, each): each for each in level.parameters}, {
            each if title in named_twice else title: each
            for title, each in zip(titles, offered, strict=True)
        }

    @property
    def field(self) -> pygame.Rect:
        """The place of the curve in the window."""
        return self._field.move(self._curve.rect.topleft)

    def process(self, event: pygame.event.Event) -> str | None:
        """Choose or save a curve, describe the point under the mouse, or run it at a click."""
        if event.type == pygame.MOUSEMOTION:
            self._follow(event.pos)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            return self._run(event.pos)
        elif event.type == UI_BUTTON_PRESSED and event.ui_element is self.save:
            return self._saved()
        elif event.type == UI_SELECTION_LIST_NEW_SELECTION and event.ui_element in self.lists:
            which = self.lists.index(event.ui_element)
            of = ("parameter", "measure")[which]
            self._exploring.choose(self._session, **{of: self._rows[which][str(event.text)]})
            self._mouse = None
            return ""
        return None

    def _saved(self) -> str:
        """Save the points so far, and return the message."""
        chosen = self._exploring.chosen(self._session)
        if chosen is None or not self._exploring.points:
            return say("the curve has no points yet")
        return say("saved {path}", path=save(self._session, chosen, self._exploring.points))

    def _at(self, pixel: tuple[int, int]) -> Point | None:
        """Return the point nearest to a pixel of the curve; None elsewhere."""
        chosen = self._exploring.chosen(self._session)
        if chosen is None or not self.field.collidepoint(pixel):
            return None
        span = span_of(self._sheet.pen, self._sheet.width, self._session.level, chosen)
        return nearest(self._exploring.points, span.value(pixel[0] - self.field.x))

    def _follow(self, pixel: tuple[int, int]) -> None:
        before, self._mouse = self._mouse, self._at(pixel)
        if self._mouse != before:
            self._show()

    def _run(self, pixel: tuple[int, int]) -> str | None:
        """Restart the run with the parameter of a point, and return the message."""
        point, chosen = self._at(pixel), self._exploring.chosen(self._session)
        if point is None or chosen is None:
            return None
        self._session.restart({chosen.parameter: point.at})
        unit = self._session.level.parameters[chosen.parameter].unit
        value = formatting.quantity(point.at, unit, 4)
        return say("now with {name} = {value}", name=chosen.parameter, value=value)

    def update(self) -> None:
        """Draw the curve again if something has changed."""
        seen = self._exploring.news, self._session.world
        if seen != self._seen:
            self._seen = seen
            self._show()

    def _show(self) -> None:
        """Draw the curve again, and place the button and the lists below it."""
        self._sheet.replace(self._curve, self._drawn())
        y = below(self._curve) + 8
        if self.save is not None:
            self.save.set_relative_position((self._sheet.margin, y))
            y = int(self.save.relative_rect.bottom) + 8
        for title, chooser in zip(self._titles, self.lists, strict=True):
            title.set_relative_position((self._sheet.margin, y))
            chooser.set_relative_position((self._sheet.margin, below(title)))
            y = int(chooser.relative_rect.bottom) + 8
        self._sheet.set_content_height(y)

    def _drawn(self) -> pygame.Surface:
        sheet = self._sheet
        surface, self._field = curve(
            sheet.pen, sheet.width, self._session, self._exploring, self._mouse
        )
        return surface
