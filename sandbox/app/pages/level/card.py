"""The card of a level: its title, its time, its parameters."""

import pygame

from sandbox.app.cards.text_column import TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import say
from sandbox.model.expressions import Values
from sandbox.model.level import Level


def header(pen: Pen, width: int, level: Level) -> pygame.Surface:
    """Draw a level's title, summary and reference."""
    card, words = TextColumn(pen, width), level_translation.of(level)
    card.text(words(level.title), 20, bold=True)
    card.y += 4
    if level.summary:
        card.text(words(level.summary), 14)
        card.y += 4
    if level.reference:
        card.text(words(level.reference), 12, theme.DIM)
    return card.drawn()


def clock(pen: Pen, width: int, text: str) -> pygame.Surface:
    """Draw the time."""
    card = TextColumn(pen, width)
    card.text(text, 14, bold=True)
    return card.drawn()


def settings(pen: Pen, width: int, level: Level, values: Values) -> pygame.Surface:
    """Draw the parameters with their values."""
    card, words = TextColumn(pen, width), level_translation.of(level)
    card.heading(say("Parameters"))
    for name, parameter in level.parameters.items():
        value = formatting.with_unit(formatting.setting(values[name]), parameter.unit)
        right = pen.write(value, 14, theme.TEXT)
        called = _title(name, words(parameter.label))
        label = pen.write(pen.shorten(called, width - right.width - 8), 14, theme.DIM)
        card.put(label, 0)
        card.put(right, width - right.width)
        card.y += label.height + 2
    return card.drawn()


def _title(name: str, label: str) -> str:
    """Return a parameter's label and its name in formulas."""
    return f"{label}  {name}" if label not in ("", name) else name
