"""What is told in words and numbers about a run: title, parameters, checks, energy."""

from collections.abc import Mapping, Sequence

import pygame

from sandbox.app import race, theme, wording
from sandbox.app.grading import Reading
from sandbox.app.race import Lane
from sandbox.app.session import Energies
from sandbox.app.text import Pen
from sandbox.app.theme import Color
from sandbox.model.expressions import Values
from sandbox.model.level import Check, Level, Parameter, Scheme
from sandbox.physics.comparison import Difference
from sandbox.physics.ledger import Balance
from sandbox.physics.study import Split

NOTHING: Mapping[int, Split] = {}
GAP = 3  # px
INDENT = 24  # px
LABEL = 108  # px, left of a bar
NUMBER = 92  # px, right of it
COLUMNS = (0.4, 0.4, 0.2)
"""How wide measured, expected and error are."""

TOUCHED_ONE = "A hand has touched this run, and not the other: they are two different things now."
TOUCHED = "A hand has touched this run: the formulas no longer describe it."
_REMARKS: Mapping[Scheme, str] = {
    "symplectic-euler": "pymunk as it comes",
    "explicit-euler": "deliberately bad",
}
_COLORS: dict[str, Color] = {
    "passed": theme.PASSED,
    "failed": theme.FAILED,
    "waiting": theme.WAITING,
    "not applicable": theme.WAITING,
}


class Card:
    """A column of text and pictures that grows downwards."""

    def __init__(self, pen: Pen, width: int) -> None:
        self.pen = pen
        self.width = width
        self.y = 0
        self._parts: list[tuple[pygame.Surface, tuple[int, int]]] = []

    def text(
        self, text: str, size: int = 14, color: Color = theme.TEXT, bold: bool = False,
        indent: int = 0,
    ) -> None:  # fmt: skip
        """Add a wrapped paragraph."""
        for line in self.pen.paragraph(text, self.width - indent, size, color, bold):
            self.put(line, indent)
            self.y += line.height

    def put(self, part: pygame.Surface, x: int, y: int = 0) -> None:
        """Put a picture at the present height, without moving on."""
        self._parts.append((part, (x, self.y + y)))

    def heading(self, text: str) -> None:
        """Add a heading under a line."""
        line = pygame.Surface((self.width, 1))
        line.fill(theme.EDGE)
        self.put(line, 0)
        self.y += 8
        self.text(text, 14, theme.ACCENT, bold=True)
        self.y += 4

    def columns(self, cells: Sequence[tuple[str, Color]], size: int) -> None:
        """Add a row of what was measured, what was expected, and the error."""
        x = float(INDENT)
        for (text, color), share in zip(cells, COLUMNS, strict=True):
            self.put(self.pen.write(text, size, color), round(x))
            x += share * (self.width - INDENT)
        self.y += self.pen.height(size)

    def drawn(self, background: Color = theme.PANEL) -> pygame.Surface:
        """Return the card as it stands."""
        surface = pygame.Surface((self.width, max(self.y, 1)))
        surface.fill(background)
        surface.blits(self._parts)
        return surface


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


def heading(pen: Pen, width: int, text: str) -> pygame.Surface:
    """Draw a heading under a line."""
    card = Card(pen, width)
    card.heading(text)
    return card.drawn()


def clock(pen: Pen, width: int, text: str) -> pygame.Surface:
    """Draw the time."""
    card = Card(pen, width)
    card.text(text, 14, bold=True)
    return card.drawn()


def settings(pen: Pen, width: int, level: Level, values: Values) -> pygame.Surface:
    """Draw the parameters with their values."""
    card = Card(pen, width)
    card.heading("Parameters")
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


def checks(
    pen: Pen,
    width: int,
    readings: Sequence[Reading],
    disturbed: bool = False,
    left_out: int = 0,
    splits: Mapping[int, Split] = NOTHING,
) -> pygame.Surface:
    """Draw how the checks stand, and how many are left out.

    Of a check whose numerical error is known, only the digits that survive it are shown.
    """
    card = Card(pen, width)
    card.heading("Checks")
    if disturbed:
        card.text(TOUCHED, 14, theme.NOTICE)
        card.text("Restart (R) to check again.", 13, theme.DIM)
    elif not readings:
        card.text("This level states no closed form.", 14, theme.DIM)
    else:
        card.columns([(name, theme.DIM) for name in ("measured", "expected", "error")], 12)
        for index, reading in enumerate(readings):
            card.y += GAP
            _check(card, reading, splits.get(index))
    if left_out:
        card.text(f"and {left_out} more", 12, theme.DIM, indent=INDENT)
    return card.drawn()


def compared(
    pen: Pen, width: int, told: str, differences: Sequence[Difference],
    cost: float | None = None, *, disturbed: bool = False,
) -> pygame.Surface:  # fmt: skip
    """Draw what a change of the effects makes of the checks' quantities, and what it costs."""
    card = Card(pen, width)
    card.heading(told[0].upper() + told[1:])
    card.text("dashed: as the level declares it", 12, theme.GHOST)
    if disturbed:
        card.text(TOUCHED_ONE, 14, theme.NOTICE)
        return card.drawn()
    if cost is not None:
        card.text(f"time: {wording.step_cost(cost)}".replace("-", wording.MINUS), 13)
    if all(found.before is found.after is None for found in differences):
        card.text("Play to see what it changes.", 13, theme.DIM)
        return card.drawn()
    card.y += GAP
    card.columns([(name, theme.DIM) for name in ("as declared", "changed", "change")], 12)
    for difference in differences:
        if difference.before is difference.after is None:
            continue  # not yet
        card.y += GAP
        card.text(difference.label or difference.quantity, 14, bold=True, indent=INDENT)
        numbers = (difference.before, difference.after)
        values = ["–" if n is None else wording.quantity(n, difference.unit) for n in numbers]
        part = difference.relative
        values.append("" if part is None else f"{100 * part:+.3g} %")
        card.columns([(value, theme.TEXT) for value in values], 13)
    return card.drawn()


def label(pen: Pen, width: int, text: str) -> pygame.Surface:
    """Draw a few words that introduce what follows."""
    card = Card(pen, width)
    card.text(text, 13, theme.DIM)
    return card.drawn()


def effects_intro(pen: Pen, width: int) -> pygame.Surface:
    """Draw what the switches of the effects are for."""
    card = Card(pen, width)
    card.heading("What if …")
    card.text("Switch an effect off or on, then play: both runs are drawn.", 13, theme.DIM)
    return card.drawn()


def unchanged(pen: Pen, width: int) -> pygame.Surface:
    """Draw that the level runs as it is declared."""
    card = Card(pen, width)
    card.heading("What it changes")
    card.text("All effects are as the level declares them.", 14, theme.DIM)
    return card.drawn()


def unjudged(pen: Pen, width: int) -> pygame.Surface:
    """Draw that the formulas say nothing of a run with other effects."""
    card = Card(pen, width)
    card.heading("Checks")
    card.text("The effects are changed: the formulas do not describe this run.", 14, theme.NOTICE)
    card.text("The tab Effects tells what differs (X).", 13, theme.DIM)
    return card.drawn()


def race_intro(pen: Pen, width: int) -> pygame.Surface:
    """Draw what the race is."""
    card = Card(pen, width)
    card.heading("Race of the schemes")
    text = "The same scene, stepped in up to four ways at once, at the same rate."
    card.text(text, 13, theme.DIM)
    return card.drawn()


def lanes(pen: Pen, width: int, found: Sequence[Lane], rate: float) -> pygame.Surface:
    """Draw how a race stands: for every scheme its error so far, and its clock."""
    card = Card(pen, width)
    if not found:
        return card.drawn()
    card.heading(f"At {rate:g} steps a second")
    card.columns([("error so far", theme.DIM), ("computing 1 s", theme.DIM), ("", theme.DIM)], 12)
    for lane in found:
        card.y += GAP + 2
        card.put(_swatch(lane.color), 0, 8)
        card.text(race.title(lane.scheme), 14, bold=True, indent=INDENT)
        if remark := _REMARKS.get(lane.scheme):
            card.text(remark, 12, theme.DIM, indent=INDENT)
        if lane.failure:
            card.text(lane.failure, 12, theme.FAILED, indent=INDENT)
        error = "–" if lane.error is None else wording.error(lane.error)
        cost = "–" if lane.cost is None else f"{wording.number(1e3 * lane.cost, 3)} ms"
        card.columns([(error, theme.TEXT), (cost, theme.TEXT), ("", theme.TEXT)], 14)
    return card.drawn()


def _swatch(color: Color | None) -> pygame.Surface:
    """Draw a piece of the line that a run is drawn with."""
    line = pygame.Surface((18, 4))
    line.fill(theme.PANEL)
    for x in (0, 7, 14) if color else (0, 4, 8, 12, 16):
        line.fill(color or theme.ACCENT, (x, 0, 4, 3))
    return line


def _check(card: Card, reading: Reading, split: Split | None) -> None:
    result = reading.result
    check = result.check
    color = _COLORS[result.verdict]
    card.put(_badge(result.verdict, color), 0, 2)
    _check_title(card, check)
    if result.verdict == "not applicable":
        source = check.valid_if.source if check.valid_if else ""
        card.text(f"does not apply: it needs {source}", 12, theme.DIM, indent=INDENT)
    elif reading.measured is None:
        card.text(f"waiting for {wording.moment(check)}", 12, color, indent=INDENT)
    elif reading.expected is None or result.error is None:
        ahead = reading.expected
        expected = "–" if ahead is None else wording.quantity(ahead, result.unit)
        until = (wording.occasion(check), color)
        now = wording.quantity(reading.measured, result.unit)
        card.columns(((now, theme.DIM), (expected, theme.TEXT), until), 13)
    else:
        expected = wording.quantity(reading.expected, result.unit)
        measured = wording.measured(reading.measured, reading.expected, result.unit)
        if split is not None:
            digits = wording.surviving(reading.measured, split.off)
            measured = wording.quantity(reading.measured, result.unit, digits)
        error = wording.error(result.error)
        card.columns(((measured, theme.TEXT), (expected, theme.TEXT), (error, color)), 13)
        if split is not None:
            off = wording.quantity(split.off, result.unit, 1)
            card.text(f"± {off} by halving the step", 12, theme.DIM, indent=INDENT)
    if result.verdict == "failed" and result.t is not None:
        worst = f"worst at {wording.seconds(result.t)}; {wording.error(check.tolerance)} is allowed"
        card.text(worst, 12, color, indent=INDENT)


def _check_title(card: Card, check: Check) -> None:
    """Write what is checked, and beside it, where there is room, the quantity's name."""
    lines = card.pen.paragraph(check.label or check.quantity, card.width - INDENT, 14, bold=True)
    name = card.pen.write(check.quantity if check.label else "", 12, theme.DIM)
    for line in lines:
        card.put(line, INDENT)
        card.y += line.height
    if lines[-1].width + name.width + 12 <= card.width - INDENT:
        card.put(name, card.width - name.width, -lines[-1].height + 2)


def _badge(verdict: str, color: Color) -> pygame.Surface:
    """Draw a verdict as a sign, for it must not be told by its colour alone."""
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
    return sign


def energy(
    pen: Pen, width: int, start: Energies, now: Energies, graph: pygame.Surface
) -> pygame.Surface:
    """Draw the energies above a graph of them, and what has become of their sum."""
    card = Card(pen, width)
    card.heading("Energy")
    rows = (
        ("kinetic", now.kinetic, theme.KINETIC),
        ("potential", now.potential, theme.POTENTIAL),
        ("total", now.total, theme.TOTAL),
    )
    _legend(card, rows)
    card.put(graph, 0)
    card.y += graph.height + 3
    drift = now.total - start.total
    relative = f"  ({wording.share(drift / abs(start.total))})" if start.total else ""
    text = pen.write(f"{wording.quantity(drift, 'J', 3)}{relative}", 13)
    card.put(pen.write("change", 13, theme.DIM), 0)
    card.put(text, width - text.width)
    card.y += text.height
    return card.drawn()


def ledger(pen: Pen, width: int, books: Balance) -> pygame.Surface:
    """Draw as bars where the energy is, where it came from and went, and what has no cause."""
    card = Card(pen, width)
    card.heading("Energy")
    rows = [
        ("kinetic", books.kinetic, theme.KINETIC),
        *((name, value, theme.POTENTIAL) for name, value in books.potential.items()),
        ("total", books.energy, theme.TOTAL),
        *((f"work: {name}", value, theme.ACCENT) for name, value in books.work.items()),
        *((f"lost: {name}", value, theme.NOTICE) for name, value in books.loss.items()),
        ("unexplained", books.unexplained, theme.FAILED),
    ]
    scale = max(abs(value) for _, value, _ in rows)
    for name, value, color in rows:
        card.put(pen.write(name, 13, theme.DIM), 0)
        text = pen.write(wording.quantity(value, "J", 4), 13)
        card.put(text, width - text.width)
        bar = _bar(max(width - LABEL - NUMBER, 20), value / scale if scale else 0.0, color)
        card.put(bar, LABEL, 5)
        card.y += pen.height(13) + 1
    return card.drawn()


def _legend(card: Card, rows: Sequence[tuple[str, float, Color]]) -> None:
    """Add the energies beside each other, in the colours of their lines."""
    pen, column = card.pen, card.width // len(rows)
    for i, (name, value, color) in enumerate(rows):
        card.put(pen.write(name, 12, color), i * column)
        card.put(pen.write(wording.quantity(value, "J", 4), 13), i * column, pen.height(12) - 2)
    card.y += pen.height(12) + pen.height(13)


def _bar(width: int, share: float, color: Color) -> pygame.Surface:
    """Draw a bar from the middle: to the right if positive, to the left if negative."""
    bar = pygame.Surface((width, 10))
    bar.fill(theme.RAISED)
    middle = width // 2
    length = round(min(abs(share), 1.0) * middle)
    bar.fill(color, (middle if share >= 0 else middle - length, 0, length, 10))
    bar.fill(theme.AXIS, (middle, 0, 1, 10))
    return bar
