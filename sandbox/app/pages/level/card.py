"""What a level is: its title, its time, its parameters."""

import pygame

from sandbox.app import theme, wording
from sandbox.app.cards.card import Card
from sandbox.app.language import say
from sandbox.app.text import Pen
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Parameter


def header(pen: Pen, width: int, level: Level) -> pygame.Surface:
    """Draw a level's title, summary and reference."""
    card = Card(pen, width)
    card.text(level.title, 20, bold=True)
    card.y += 4
    if level.summary:
        card.text(level.summary, 14)
        card.y += 4
    if level.reference:
        card.text(level.reference, 12, theme.DIM)
    return card.drawn()


def clock(pen: Pen, width: int, text: str) -> pygame.Surface:
    """Draw the time."""
    card = Card(pen, width)
    card.text(text, 14, bold=True)
    return card.drawn()


def settings(pen: Pen, width: int, level: Level, values: Values) -> pygame.Surface:
    """Draw the parameters with their values."""
    card = Card(pen, width)
    card.heading(say("Parameters"))
    for name, parameter in level.parameters.items():
        value = wording.with_unit(wording.setting(values[name]), parameter.unit)
        right = pen.write(value, 14, theme.TEXT)
        label = pen.write(
            pen.shorten(_title(name, parameter), width - right.width - 8), 14, theme.DIM
        )
        card.put(label, 0)
        card.put(right, width - right.width)
        card.y += label.height + 2
    return card.drawn()


def _title(name: str, parameter: Parameter) -> str:
    """Return a parameter's label and the name that formulas call it by."""
    return f"{parameter.label}  {name}" if parameter.label not in ("", name) else name
