"""The card with the results of a level's checks."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import pygame

from sandbox.app.cards.text_column import GAP, TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.checks_of_unfinished_run import Reading
from sandbox.app.words import formatting
from sandbox.app.words.language import later, say
from sandbox.app.words.level_translation import Say, title
from sandbox.model.level import Check

if TYPE_CHECKING:
    from sandbox.physics.accuracy.error_causes_and_costs import ErrorBudget

NOTHING: Mapping[int, "ErrorBudget"] = {}
TOUCHED = later("This run was moved or changed by hand: no formula describes it.")


def checks(
    pen: Pen,
    width: int,
    readings: Sequence[Reading],
    words: Say = str,
    disturbed: bool = False,
    left_out: int = 0,
    splits: Mapping[int, "ErrorBudget"] = NOTHING,
) -> pygame.Surface:
    """Draw the results of a level's checks, and the number of checks that are left out.

    Where the numerical error of a check is known (`splits`, by index), only the digits that it
    leaves certain are shown. If the run was `disturbed` by hand, no formula describes it.
    """
    card = TextColumn(pen, width)
    card.heading(say("Checks"))
    if disturbed:
        card.text(say(TOUCHED), 14, theme.NOTICE)
        card.text(say("Restart (R) to check again."), 13, theme.DIM)
    elif not readings:
        card.text(say("This level states no closed form."), 14, theme.DIM)
    else:
        heads = (say("measured"), say("expected"), say("error"))
        card.columns([(head, theme.DIM) for head in heads], 12)
        for index, reading in enumerate(readings):
            card.y += GAP
            _check(card, reading, words, splits.get(index))
    if left_out:
        card.text(say("and {count} more", count=left_out), 12, theme.DIM, indent=card.indent)
    return card.drawn()


def unjudged(pen: Pen, width: int) -> pygame.Surface:
    """Draw a note that the formulas do not apply to a run with changed effects."""
    card = TextColumn(pen, width)
    card.heading(say("Checks"))
    message = say("The effects are changed: the formulas do not describe this run.")
    card.text(message, 14, theme.NOTICE)
    card.text(say("The tab Effects shows the difference (X)."), 13, theme.DIM)
    return card.drawn()


def _check(card: TextColumn, reading: Reading, words: Say, split: "ErrorBudget | None") -> None:
    result = reading.result
    check = result.check
    color = _color(result.verdict)
    card.put(_badge(card.pen, result.verdict, color), 0, card.pen.px(2))
    _check_title(card, check, words)
    if result.verdict == "not applicable":
        source = check.valid_if.source if check.valid_if else ""
        message = say("does not apply: it needs {condition}", condition=source)
        card.text(message, 12, theme.DIM, indent=card.indent)
    elif reading.measured is None:
        message = say("waiting for {moment}", moment=formatting.moment_in_words(check))
        card.text(message, 12, color, indent=card.indent)
    elif reading.expected is None or result.error is None:
        ahead = reading.expected
        expected = "–" if ahead is None else formatting.quantity(ahead, result.unit)
        until = (formatting.event_in_words(check), color)
        now = formatting.quantity(reading.measured, result.unit)
        card.columns(((now, theme.DIM), (expected, theme.TEXT), until), 13)
    else:
        expected = formatting.quantity(reading.expected, result.unit)
        measured = (
            formatting.measured(reading.measured, reading.expected, result.unit)
            if split is None
            else formatting.trusted_value(reading.measured, split.difference, result.unit)
        )
        error = formatting.error(result.error)
        card.columns(((measured, theme.TEXT), (expected, theme.TEXT), (error, color)), 13)
        if split is not None:
            off = formatting.quantity(split.difference, result.unit, 1)
            message = say("± {off} by halving the step", off=off)
            card.text(message, 12, theme.DIM, indent=card.indent)
    if result.verdict == "failed" and result.t is not None:
        worst = say(
            "worst at {t}; {error} is allowed",
            t=formatting.seconds(result.t),
            error=formatting.error(check.tolerance),
        )
        card.text(worst, 12, color, indent=card.indent)


def _color(verdict: str) -> Color:
    return {"passed": theme.PASSED, "failed": theme.FAILED}.get(verdict, theme.WAITING)


def _check_title(card: TextColumn, check: Check, words: Say) -> None:
    """Add the check's title, and the quantity's name beside it where there is room."""
    lines = card.pen.paragraph(title(check, words), card.width - card.indent, 14, bold=True)
    name = card.pen.write(check.quantity if check.label else "", 12, theme.DIM)
    for line in lines:
        card.put(line, card.indent)
        card.y += line.height
    if lines[-1].width + name.width + 12 <= card.width - card.indent:
        card.put(name, card.width - name.width, -lines[-1].height + 2)


def _badge(pen: Pen, verdict: str, color: Color) -> pygame.Surface:
    """Draw a verdict as a symbol, so that it does not depend on colour alone."""
    sign = pygame.Surface((17, 17), pygame.SRCALPHA)
    if verdict in ("passed", "failed"):
        pygame.draw.aacircle(sign, color, (8, 8), 8)
    else:
        pygame.draw.aacircle(sign, color, (8, 8), 8, 2)
    ink = theme.STAGE
    if verdict == "passed":
        pygame.draw.lines(sign, ink, False, [(4, 8), (7, 11), (12, 5)], 2)
    elif verdict == "failed":
        pygame.draw.line(sign, ink, (5, 5), (11, 11), 2)
        pygame.draw.line(sign, ink, (11, 5), (5, 11), 2)
    elif verdict == "waiting":
        pygame.draw.lines(sign, color, False, [(8, 4), (8, 8), (11, 10)], 2)
    else:
        pygame.draw.line(sign, color, (5, 8), (11, 8), 2)
    return pygame.transform.smoothscale_by(sign, pen.scale) if pen.scale != 1 else sign
