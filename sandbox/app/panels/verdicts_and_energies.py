"""The footer of the side panel: the verdicts of the checks, and the energies."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Literal

import pygame
from pygame_gui import UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton, UIImage

from sandbox.app.cards.energy import energy, ledger, total
from sandbox.app.drawing import energy_graph
from sandbox.app.drawing.text import Pen
from sandbox.app.keymap import tip
from sandbox.app.runs.session import Session
from sandbox.app.widgets.scrolling_area import MARGIN, Sheet
from sandbox.app.words.language import later, plural, say
from sandbox.physics.measuring.grading import Verdict

View = Literal["graph", "bars", "total"]
"""The display of the energy: over time, by account, or only the total."""

FIRST: View = "graph"
"""The default view, if there is room."""

FOLDED: View = "total"
"""The view with the smallest height."""

NEXT: Mapping[View, tuple[View, str]] = {
    "graph": ("bars", later("Bars")),
    "bars": ("total", later("Fold")),
    "total": ("graph", later("Graph")),
}
"""The view after each view, and the caption of the button that leads there."""

HIGH = 66, 120  # px, the least and the largest height of the graph
CAPTION = 82  # px, the height of the captions above and below the graph
SWITCH = 22  # px, the height of the button that leads to the next view
PADDING = 22  # px, beside its caption, left and right together
VERDICTS = 24  # px, the height of the line that counts the checks
SIZE = 13  # of the letters in that line
LAST = 8  # px, the margin at the bottom


class VerdictsAndEnergies:
    """The footer below every page."""

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, session: Session, view: View
    ) -> None:
        self._pen, self._session = pen, session
        self.view = view
        """The view of the energy."""
        self.books = view == "bars"
        """Whether it shows where energy comes from and goes."""
        px = pen.px
        self._width = rect.width - 2 * px(MARGIN) - px(10)
        height = min(max(rect.height // 5 - px(CAPTION), px(HIGH[0])), px(HIGH[1]))
        self._graph_size = self._width, height
        drawn = self._drawn()
        checks = bool(session.readings())
        self.top = max(rect.bottom - drawn.height - px(LAST) - checks * px(VERDICTS), rect.top + 1)
        """Its upper edge [px]."""
        place = drawn.get_rect(topleft=(rect.x + px(MARGIN), self.top + checks * px(VERDICTS)))
        self.verdicts: UIButton | None = None
        """The button that counts the checks and leads to them; None for a level without any."""
        if checks:
            line = pygame.Rect(rect.x + px(MARGIN - 8), self.top, self._width + px(8), px(VERDICTS))
            self.verdicts = UIButton(
                line, self._summary(), manager, tool_tip_text=tip("checks"),
                object_id=ObjectID(class_id="@section"),
            )  # fmt: skip
        caption = say(NEXT[view][1])
        switch = pen.write(caption).width + px(PADDING), px(SWITCH)
        self._energy = UIImage(place, drawn, manager)
        self.switch = UIButton(
            pygame.Rect((place.right - switch[0], place.top + px(4)), switch),
            caption, manager, tool_tip_text=tip("energy"),
        )  # fmt: skip
        """The button that leads to the next view of the energy."""

    def kill(self) -> None:
        """Remove all widgets."""
        for widget in (self.verdicts, self._energy, self.switch):
            if widget is not None:
                widget.kill()  # type: ignore[no-untyped-call]

    def pressed(self, element: object) -> str | None:
        """Return the command of a widget; None if it is not in the footer."""
        commands = {id(self.switch): "energy", id(self.verdicts): "checks"}
        return commands.get(id(element))

    def update(self) -> None:
        """Update the verdicts and the energies."""
        if self.verdicts is not None:
            self.verdicts.set_text(self._summary())
        Sheet.replace(self._energy, self._drawn())

    def _summary(self) -> str:
        """Return the summary of the checks; where the footer is too narrow, without its title."""
        summary = check_summary(self._session)
        if self._pen.write(summary, SIZE).width > self._width:
            summary = summary.partition(": ")[2]
        return self._pen.shorten(summary, self._width, SIZE)

    def _drawn(self) -> pygame.Surface:
        session, books = self._session, self._session.books
        if self.books:
            return ledger(self._pen, self._width, books.balance, books.covered)
        if self.view == "total":
            return total(self._pen, self._width, books.start, books.energies)
        drawn = energy_graph.energies(self._graph_size, books.history, session.duration)
        return energy(self._pen, self._width, books.start, books.energies, drawn)


def check_summary(session: Session) -> str:
    """Return a summary of the checks of a run."""
    if session.changes:
        return say("Checks: not judged, effects are changed")
    if session.world.disturbed:
        return say("Checks: not judged, changed by hand")
    verdicts = [reading.result.verdict for reading in session.readings()]
    return say("Checks: {verdicts}", verdicts=counts_in_words(verdicts))


def counts_in_words(verdicts: Sequence[Verdict]) -> str:
    """Return the numbers of checks with each verdict, in words."""
    found = Counter(verdicts)
    words: Mapping[Verdict, str] = {
        "passed": plural("{count} holds", "{count} hold", found["passed"]),
        "failed": plural("{count} fails", "{count} fail", found["failed"]),
        "waiting": plural("{count} waits", "{count} wait", found["waiting"]),
        "not applicable": plural(
            "{count} does not apply", "{count} do not apply", found["not applicable"]
        ),
    }
    return ", ".join(word for verdict, word in words.items() if found[verdict])
