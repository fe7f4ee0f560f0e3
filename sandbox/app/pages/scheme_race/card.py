"""The card with the standings of the race between schemes."""

from collections.abc import Mapping, Sequence

import pygame

from sandbox.app.cards.text_column import GAP, TextColumn, titled_note
from sandbox.app.drawing import line_styles, lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.pages.scheme_race import scheme_comparison
from sandbox.app.pages.scheme_race.scheme_comparison import Lane
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.app.words.language import later, say
from sandbox.model.level import Scheme

_REMARKS: Mapping[Scheme, str] = {
    "symplectic-euler": later("stock pymunk"),
    "explicit-euler": later("deliberately bad"),
}


def race_intro(pen: Pen, width: int) -> pygame.Surface:
    """Draw a description of the race."""
    text = say("The same scene with up to four schemes at once, at the same rate.")
    return titled_note(pen, width, say("Race of the schemes"), text)


def standing(pen: Pen, width: int, session: Session) -> pygame.Surface:
    """Draw the standings of a session's race; nothing if there is none."""
    found = scheme_comparison.lanes(session) if scheme_comparison.racing(session) else []
    return _lanes(pen, width, found, session.world.stepping.rate)


def _lanes(pen: Pen, width: int, found: Sequence[Lane], rate: float) -> pygame.Surface:
    """Draw the standings of a race: each scheme's error so far, and its computing time."""
    card = TextColumn(pen, width)
    if not found:
        return card.drawn()
    card.heading(say("At {rate:g} steps a second", rate=rate))
    heads = (say("error so far"), say("computing 1 s"), "")
    card.columns([(head, theme.DIM) for head in heads], 12)
    for place, lane in enumerate(found):
        card.y += GAP + 2
        card.put(_swatch(lane.color, place - 1), 0, 8)
        card.text(formatting.scheme(lane.scheme), 14, bold=True, indent=card.indent)
        if remark := _REMARKS.get(lane.scheme):
            card.text(say(remark), 12, theme.DIM, indent=card.indent)
        if lane.failure:
            card.text(say(lane.failure), 12, theme.FAILED, indent=card.indent)
        error = "–" if lane.error is None else formatting.error(lane.error)
        cost = "–" if lane.cost is None else f"{formatting.number(1e3 * lane.cost, 3)} ms"
        card.columns([(error, theme.TEXT), (cost, theme.TEXT), ("", theme.TEXT)], 14)
    return card.drawn()


def _swatch(color: Color | None, lane: int) -> pygame.Surface:
    """Draw a sample of the line of a run, solid for the run that is played."""
    line = pygame.Surface((18, 5))
    line.fill(theme.PANEL)
    if color is None:
        line.fill(theme.ACCENT, (0, 1, 18, 3))
        return line
    for y in (1, 2, 3):
        lines.dashed(line, color, ((0, y), (18, y)), *line_styles.dash(lane))
    return line
