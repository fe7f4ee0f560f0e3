"""The card that shows the results of switching effects."""

from collections.abc import Sequence

import pygame

from sandbox.app.cards.text_column import GAP, TextColumn, titled_note
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.effects import switching_effects
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import later, say
from sandbox.app.words.level_translation import Say
from sandbox.physics.measuring.run_comparison import Difference

TOUCHED_ONE = later("Only this run was changed by hand: the two can no longer be compared.")


def compared(
    pen: Pen, width: int, message: str, differences: Sequence[Difference],
    words: Say, cost: float | None = None, *, disturbed: bool = False,
) -> pygame.Surface:  # fmt: skip
    """Draw the change of the checks' quantities by a change of the effects, and its cost."""
    card = TextColumn(pen, width)
    card.heading(message[0].upper() + message[1:])
    card.text(say("dashed: as the level declares it"), 12, theme.GHOST)
    if disturbed:
        card.text(say(TOUCHED_ONE), 14, theme.NOTICE)
        return card.drawn()
    if cost is not None:
        message = say(
            "time: {cost}", cost=formatting.step_cost(cost).replace("-", formatting.MINUS)
        )
        card.text(message, 13)
    if all(found.first is found.second is None for found in differences):
        card.text(say("Play to see what changes."), 13, theme.DIM)
        return card.drawn()
    card.y += GAP
    heads = (say("as declared"), say("changed"), say("change"))
    card.columns([(head, theme.DIM) for head in heads], 12)
    for difference in differences:
        if difference.first is difference.second is None:
            continue  # not yet
        card.y += GAP
        card.text(words(difference.label) or difference.quantity, 14, bold=True, indent=card.indent)
        numbers = (difference.first, difference.second)
        values = ["–" if n is None else formatting.quantity(n, difference.unit) for n in numbers]
        part = difference.relative
        values.append("" if part is None else f"{100 * part:+.3g} %")
        card.columns([(value, theme.TEXT) for value in values], 13)
    return card.drawn()


def changed(pen: Pen, width: int, session: Session) -> pygame.Surface:
    """Draw the differences between a session and its level as declared."""
    if not session.changes:
        return unchanged(pen, width)
    words = level_translation.of(session.original)
    return compared(pen, width, session.changes.label, switching_effects.compared(session), words)


def effects_intro(pen: Pen, width: int) -> pygame.Surface:
    """Draw the purpose of the switches."""
    message = say("Switch an effect off or on, then play: both runs are drawn.")
    return titled_note(pen, width, say("What if …"), message)


def unchanged(pen: Pen, width: int) -> pygame.Surface:
    """Draw the note that the level runs as declared."""
    message = say("All effects are as the level declares them.")
    return titled_note(pen, width, say("What it changes"), message, 14)
