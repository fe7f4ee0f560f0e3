"""The card with the energy of a run, and its balance."""

from collections.abc import Sequence

import pygame

from sandbox.app.cards.text_column import GAP, TextColumn, bar
from sandbox.app.drawing import energy_graph, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.energy_history_and_balance import Energies
from sandbox.app.words import formatting
from sandbox.app.words.language import later, say, say_in
from sandbox.physics.energy.balance import Balance

LABEL = 108  # px, left of a bar; more if a name needs it
LEAST = 24  # px, the least width of a bar
NUMBER = 92  # px, right of a bar


def energy(
    pen: Pen, width: int, start: Energies, now: Energies, drawn: pygame.Surface
) -> pygame.Surface:
    """Draw the energies, a graph of them, and the change of the total energy."""
    card = TextColumn(pen, width)
    card.heading(say("Energy"))
    rows = (
        (say("kinetic"), now.kinetic, theme.KINETIC),
        (say_in("energy", "potential"), now.potential, theme.POTENTIAL),
        (say("total"), now.total, theme.TOTAL),
    )
    _legend(card, rows)
    card.put(drawn, 0)
    card.y += drawn.height + 3
    text = pen.write(_change(start, now), 13)
    card.put(pen.write(say("change"), 13, theme.DIM), 0)
    card.put(text, width - text.width)
    card.y += text.height
    return card.drawn()


def total(pen: Pen, width: int, start: Energies, now: Energies) -> pygame.Surface:
    """Draw only the total energy and its change, in one line with room for a button."""
    card = TextColumn(pen, width)
    line = pygame.Surface((width, 1))
    line.fill(theme.EDGE)
    card.put(line, 0)
    card.y += pen.px(6)
    title = pen.write(say("Energy"), 14, theme.ACCENT, True)
    card.put(title, 0)
    scale = max(abs(now.kinetic), abs(now.potential))
    whole = formatting.quantity(formatting.without_rounding(now.total, scale), "J", 4)
    change = now.total - start.total
    text = formatting.quantity(change, "J", 3)
    if start.total:
        text = formatting.share(change / abs(start.total))
    x = title.width + pen.px(8)
    card.put(pen.write(f"{whole}, Δ {text}", 13), x, 1)
    card.y += title.height + pen.px(2)
    return card.drawn()


def ledger(pen: Pen, width: int, books: Balance, covered: str) -> pygame.Surface:
    """Draw the balance as bars: energies, work, losses, and the unexplained rest.

    The text `covered` above them tells the period of the balance.
    """
    card = TextColumn(pen, width)
    card.heading(say("Energy"))
    card.text(covered, 12, theme.DIM)
    rows = [
        (say("kinetic"), books.kinetic, theme.KINETIC),
        *((say(name), value, theme.POTENTIAL) for name, value in books.potential.items()),
        (say("total"), books.energy, theme.TOTAL),
        *(
            (_named(later("work: {account}"), name), value, theme.ACCENT)
            for name, value in books.work.items()
        ),
        *(
            (_named(later("lost: {account}"), name), value, theme.NOTICE)
            for name, value in books.loss.items()
        ),
        (say("unexplained"), books.unexplained, theme.FAILED),
    ]
    scale = max(abs(value) for _, value, _ in rows)
    widest = max(pen.write(name, 13).width for name, _, _ in rows) + pen.px(GAP)
    left = min(max(widest, pen.px(LABEL)), width - pen.px(NUMBER + LEAST))
    for name, value, color in rows:
        card.put(pen.write(pen.shorten(name, left - pen.px(GAP), 13), 13, theme.DIM), 0)
        text = pen.write(formatting.quantity(value, "J", 4), 13)
        card.put(text, width - text.width)
        length = width - left - pen.px(NUMBER)
        drawn = bar(length, value / scale if scale else 0.0, color, pen.px(10))
        card.put(drawn, left, pen.px(5))
        card.y += pen.height(13) + 1
    return card.drawn()


def _named(kind: str, account: str) -> str:
    """Return the name of an account of work or losses."""
    return say(kind, account=say(account))


def _change(start: Energies, now: Energies) -> str:
    """Return the change of the total energy as text, absolute and relative."""
    change = now.total - start.total
    share = f"  ({formatting.share(change / abs(start.total))})" if start.total else ""
    return f"{formatting.quantity(change, 'J', 3)}{share}"


def _legend(card: TextColumn, rows: Sequence[tuple[str, float, Color]]) -> None:
    """Add the energies side by side, in the colours of their lines."""
    pen, column = card.pen, card.width // len(rows)
    scale = max(abs(value) for _, value, _ in rows)
    for i, (name, value, color) in enumerate(rows):
        word = pen.write(name, 12, color)
        card.put(word, i * column)
        card.put(
            energy_graph.sample(i, (pen.px(18), word.height)), i * column + word.width + pen.px(5)
        )
        text = formatting.quantity(formatting.without_rounding(value, scale), "J", 4)
        card.put(pen.write(text, 13), i * column, pen.height(12) - 2)
    card.y += pen.height(12) + pen.height(13)
