"""The page Predict: the question, a field for the answer, and the result."""

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UI_TEXT_ENTRY_CHANGED, UI_TEXT_ENTRY_FINISHED
from pygame_gui.elements import UIButton, UIImage, UISelectionList

from sandbox.app.drawing import theme
from sandbox.app.pages.page import Desk
from sandbox.app.pages.predict import card
from sandbox.app.pages.predict.prediction_in_progress import PredictionWorker
from sandbox.app.pages.predict.questions import questions, unit_of, when
from sandbox.app.widgets.scrolling_area import Sheet, below
from sandbox.app.widgets.text_field import TextField
from sandbox.app.widgets.widget_states_and_scrolling import show
from sandbox.app.words import level_translation
from sandbox.app.words.language import later, say
from sandbox.model.level import Check

Widget = UIImage | UIButton | TextField | UISelectionList
HEIGHT = 28  # px, of the button
FIELD = 26  # px, its height
UNIT = 84  # px, the room for the unit beside it
ROW = 20  # px, of the list
BESIDE = 24  # px, the margins of the list
MOST = 6
"""The largest number of visible rows of the list."""


CAPTIONS = PREDICT, PUT_OFF, ANOTHER = (
    later("Predict"), later("Put it off"), later("Predict another"),
)  # fmt: skip
TIPS = {
    PREDICT: later("hold the run until you have predicted its result"),
    PUT_OFF: later("let the run go on without a prediction"),
    ANOTHER: later("choose what to predict"),
}
"""The tooltip for each caption."""


class PredictPage:
    """A list of questions; then a field for the answer; then the result."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        self._predicting = desk.worker(PredictionWorker)
        self._predicting.forget_other_sessions(desk.session)
        self._questions: tuple[Check, ...] = ()
        self._head = sheet.image(self._drawn_head(), sheet.margin // 2)
        self.list = self._listed([])
        self.button = sheet.button(
            pygame.Rect((0, 0), (sheet.widest_button(*map(say, CAPTIONS)), sheet.px(HEIGHT))),
            "", say(TIPS[PREDICT]),
        )  # fmt: skip
        place = pygame.Rect(sheet.margin, 0, sheet.width - sheet.px(UNIT), sheet.px(FIELD))
        self.field = TextField(place, sheet.manager, container=sheet.container)
        self.field.set_text_length_limit(60)
        self._unit = sheet.image(sheet.pen.write(" ", 14), 0)
        self._refusal = sheet.image(self._drawn_refusal(), 0)
        self._result = sheet.image(self._drawn_result(), 0)
        self.update()

    def process(self, event: pygame.event.Event) -> str | None:
        """Ask the chosen question, accept the typed answer, or start over."""
        predicting = self._predicting
        if event.type == UI_TEXT_ENTRY_CHANGED and event.ui_element is self.field:
            predicting.typed = self.field.get_text()
            return None
        if event.type == UI_TEXT_ENTRY_FINISHED and event.ui_element is self.field:
            if not self._open:
                return None
            if predicting.answer(self._session, self.field.get_text()):
                self._sheet.manager.set_focus_set(None)
            return ""
        if event.type != UI_BUTTON_PRESSED or event.ui_element is not self.button:
            return None
        if predicting.question is not None:
            predicting.withdraw()
            return ""
        chosen = self._chosen
        if chosen is not None:
            predicting.ask(self._session, chosen)
            self.update()
            self.field.set_text("")
            self._sheet.manager.set_focus_set(self.field.get_focus_set())
        return ""

    @property
    def awaited(self) -> TextField | None:
        """The field for the answer; None while there is no question."""
        return self.field if self._open else None

    @property
    def _open(self) -> bool:
        """Whether an answer is awaited."""
        return self._predicting.question is not None and self._predicting.predicted is None

    @property
    def _chosen(self) -> Check | None:
        name = self.list.get_single_selection()
        return dict(zip(self._names(), self._questions, strict=True)).get(str(name))

    def _names(self) -> list[str]:
        """Return distinct names of the questions."""
        words = level_translation.of(self._session.original)
        titles = [level_translation.title(question, words) for question in self._questions]
        pairs = zip(titles, self._questions, strict=True)
        names = [
            name if titles.count(name) == 1 else f"{name} {when(each.at)}" for name, each in pairs
        ]
        room = self._sheet.width - self._sheet.px(BESIDE)
        short = [self._sheet.pen.shorten(name, room, 14) for name in names]
        return short if len(set(short)) == len(short) else names

    def update(self) -> None:
        """Show the present question and its result."""
        predicting, sheet = self._predicting, self._sheet
        self._offer()
        question, is_open = predicting.question, self._open
        sheet.replace(self._head, self._drawn_head())
        y = below(self._head) + 6
        y = self._put(self.list, y, shown=question is None and bool(self._questions))
        if is_open:
            sheet.replace(self._unit, self._drawn_unit())
            self._unit.set_relative_position((self.field.relative_rect.right + 8, y + 4))
        show(self._unit, is_open)
        y = self._put(self.field, y, shown=is_open)
        if is_open:
            sheet.replace(self._refusal, self._drawn_refusal())
        y = self._put(self._refusal, y, shown=is_open)
        answered = predicting.predicted is not None
        if answered:
            sheet.replace(self._result, self._drawn_result())
        y = self._put(self._result, y, shown=answered)
        self._name_button()
        y = self._put(self.button, y, shown=question is not None or bool(self._questions))
        sheet.set_content_height(y)

    def _offer(self) -> None:
        """List the questions about the present level."""
        found = questions(self._session.level, self._session.values)
        if found == self._questions:
            return
        self._questions = found
        self.list.kill()
        self.list = self._listed(self._names())

    def _listed(self, names: list[str]) -> UISelectionList:
        """Return a list of questions, with the first chosen."""
        height = min(len(names), MOST) * self._sheet.px(ROW) + 6
        return self._sheet.choices(names, height, names[0] if names else None)

    def _name_button(self) -> None:
        """Update the caption and the tooltip of the button."""
        has_question = self._predicting.question is not None
        caption = PUT_OFF if self._open else ANOTHER if has_question else PREDICT
        if self.button.text != (text := say(caption)):
            self.button.set_text(text)
            self.button.tool_tip_text = say(TIPS[caption])

    def _put(self, widget: Widget, y: int, *, shown: bool) -> int:
        """Place a widget at a height if it is shown, and return the height of the next [px]."""
        show(widget, shown)
        if not shown:
            return y
        if widget.relative_rect.y != y:
            widget.set_relative_position((widget.relative_rect.x, y))
        return int(widget.relative_rect.bottom) + 6

    def _drawn_head(self) -> pygame.Surface:
        pen, width, question = self._sheet.pen, self._sheet.width, self._predicting.question
        if question is None:
            return card.intro(pen, width, self._session, possible=bool(self._questions))
        unit = unit_of(question, self._session.level)
        name = level_translation.title(question, level_translation.of(self._session.original))
        since = self._session.t if self._open else None
        return card.question_text(pen, width, question, name, unit, since)

    def _drawn_unit(self) -> pygame.Surface:
        question = self._predicting.question
        unit = unit_of(question, self._session.level) if question is not None else ""
        return self._sheet.pen.write(unit or " ", 14, theme.TEXT)

    def _drawn_refusal(self) -> pygame.Surface:
        return card.refusal_text(self._sheet.pen, self._sheet.width, self._predicting.refusal)

    def _drawn_result(self) -> pygame.Surface:
        predicting = self._predicting
        return card.result(
            self._sheet.pen, self._sheet.width, self._session, predicting.outcome,
            predicting.trials, predicting.trying,
        )  # fmt: skip
