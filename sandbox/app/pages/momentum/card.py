"""The momentum of each body and the total, and the impulses that changed it."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pygame

from sandbox.app.cards.text_column import TextColumn, bar
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.runs.session import Session
from sandbox.app.stage import momentum_scale
from sandbox.app.stage.frame_of_reference import FrameOfReference
from sandbox.app.stage.level_labels import seen_from
from sandbox.app.words import formatting
from sandbox.app.words.language import plural, say
from sandbox.model.expressions import Array
from sandbox.physics.stepping.world import World

MOST = 10
"""The largest number of bodies with bars of their own; the others share one."""
LABEL, AXIS, NUMBER = 82, 14, 104  # px, the widths of the name, the axis and the number
COLUMN = 68  # px, the width of the column of y components


class Momentum(NamedTuple):
    """A name, and a momentum: (2,) [kg m/s]."""

    name: str
    value: Array


def bodies(world: World, place: str | None = None) -> list[Momentum]:
    """Return the momenta of all bodies; of many, the largest ones, and the sum of the others.

    They are as seen from a place, see `FrameOfReference`.
    """
    found, every = (
        momentum_scale.bodies_with_momentum(world),
        momentum_scale.momenta(world, world.snapshot, place),
    )
    each = {row: Momentum(formatting.name_in_words(name), every[row]) for row, name in found}
    if len(found) <= MOST:
        return [*each.values()]
    rows = np.array([*each])
    sizes = np.hypot(every[rows, 0], every[rows, 1])
    largest = set(rows[np.argsort(-sizes, kind="stable")[:MOST]].tolist())
    rest = [row for row in each if row not in largest]
    shown = [momentum for row, momentum in each.items() if row in largest]
    return [
        *shown,
        Momentum(plural("{count} other", "{count} others", len(rest)), every[rest].sum(axis=0)),
    ]


def explained_change(session: Session) -> list[Momentum]:
    """Return the change of the total, and the external impulses that explain it."""
    books = session.books.balance
    impulses = [Momentum(say(name), value[:2]) for name, value in books.impulse.items()]
    outside = sum((each.value for each in impulses), np.zeros(2))
    unexplained = books.unexplained_impulse[:2]
    return [
        Momentum(say("change of the total"), outside + unexplained),
        Momentum(say("impulse from outside"), outside),
        *(Momentum(f"  {each.name}", each.value) for each in impulses if len(impulses) > 1),
        Momentum(say("unexplained"), unexplained),
    ]


def momentum(pen: Pen, width: int, session: Session) -> pygame.Surface:
    """Draw momenta as bars along x and y, above the balance of the total."""
    card, world = TextColumn(pen, width), session.world
    place = FrameOfReference(world, session.looking.seen_from).place
    scale = momentum_scale.scale(session, world, session.history.snapshots, place)
    card.heading(say("Momentum"))
    shown = bodies(world, place)
    if not shown:
        card.text(say("Nothing in this level has a momentum."), 13, theme.DIM)
        return card.drawn()
    message = say("nothing has moved yet")
    if scale:
        message = say("a full bar is {size:g} {unit}", size=scale, unit=momentum_scale.UNIT)
    card.text(message, 12, theme.DIM)
    if place is not None:
        card.text(seen_from(place), 12, theme.NOTICE)
    card.y += 4
    total = momentum_scale.momenta(world, world.snapshot, place).sum(axis=0)
    _add_bars(card, Momentum(say("total"), total), scale, (theme.TOTAL, theme.TOTAL))
    if len(shown) > MOST:
        message = say("the largest {count}, and the others together", count=MOST)
        card.text(message, 12, theme.DIM)
    for each in shown:
        _add_bars(card, each, scale, _axes())
    card.y += 4
    card.heading(say("Change"))
    card.text(session.books.covered, 12, theme.DIM)
    if place is not None:  # an accelerated observer sees changes that no impulse explains
        card.text(seen_from(None), 12, theme.NOTICE)
    _add_table(card, explained_change(session), scale)
    return card.drawn()


def _add_bars(card: TextColumn, row: Momentum, scale: float, colors: Sequence[Color]) -> None:
    """Add two bars, for the x and the y component."""
    pen, width = card.pen, card.width
    left = pen.px(LABEL) + pen.px(AXIS)
    length = max(width - left - pen.px(NUMBER), 20)
    card.put(pen.write(pen.shorten(row.name, pen.px(LABEL) - 4, 13), 13), 0)
    for axis, value, color, own in zip("xy", row.value.tolist(), colors, _axes(), strict=True):
        card.put(pen.write(axis, 13, own), pen.px(LABEL))
        drawn = bar(length, value / scale if scale else 0.0, color, pen.px(10))
        card.put(drawn, left, pen.px(5))
        rounded = formatting.without_rounding(value, scale)
        text = pen.write(formatting.quantity(rounded, momentum_scale.UNIT, 4), 13)
        card.put(text, width - text.width)
        card.y += pen.height(13)
    card.y += 3


def _add_table(card: TextColumn, rows: Sequence[Momentum], scale: float) -> None:
    """Add momenta as numbers, in a column for each axis; rounding errors of a scale are zero."""
    pen, ends = card.pen, (card.width - card.pen.px(COLUMN), card.width)
    for axis, color, end in zip("xy", _axes(), ends, strict=True):
        head = pen.write(f"{axis} [{momentum_scale.UNIT}]", 12, color)
        card.put(head, end - head.width)
    card.y += pen.height(12)
    scale = max(scale, *(float(np.hypot(*row.value)) for row in rows))  # another may observe
    for row in rows:
        card.put(pen.write(row.name, 13, theme.DIM), 0)
        for value, end in zip(row.value.tolist(), ends, strict=True):
            rounded = formatting.without_rounding(value, scale)
            text = pen.write(formatting.number(rounded, 3), 13)
            card.put(text, end - text.width)
        card.y += pen.height(13) + 1


def _axes() -> tuple[Color, Color]:
    """Return the colours of x and y."""
    return theme.ACROSS, theme.UPWARDS
