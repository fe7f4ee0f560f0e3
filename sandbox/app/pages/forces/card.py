"""The forces on a body: a free-body diagram, a table with sums, and a force polygon."""

from math import hypot

import pygame

from sandbox.app.cards.text_column import TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.observing import forces_on_selected_body
from sandbox.app.pages.forces import force_diagrams
from sandbox.app.pages.forces.component_axes import Axes, components
from sandbox.app.runs.session import Session
from sandbox.app.words.formatting import name_in_words, number
from sandbox.app.words.language import later, say
from sandbox.model.shapes import XY
from sandbox.physics.measuring.free_body import FreeBody

DIAGRAM, POLYGON = 170, 130  # px, heights
NUMBER = 48  # px, the width of a column of numbers
MARK = 9  # px, the side of the square that shows a colour
SIZE = 12  # of letters in the table
NOBODY = later("No forces act on anything in this level.")
NOT_YET = later("Forces are known from the first step on.")
STRUCK = later("There is an impact in this step: the forces are means over the step.")
CLOSED = later("One force was computed from the others and m a, so their sum proves nothing here.")


def forces(pen: Pen, width: int, session: Session, axes: Axes) -> pygame.Surface:
    """Draw the forces on the selected body."""
    card, body = TextColumn(pen, width), session.looking.body(session.level)
    on = name_in_words(body) if body else ""
    card.heading(say("Forces on {body}", body=on) if on else say("Forces"))
    found = session.looking.at(session.world)
    if found is None:
        card.text(say(NOT_YET if body else NOBODY), 13, theme.DIM)
        return card.drawn()
    session.looking.note_shown(session.world, found)
    if len(session.level.bodies) > 1:
        card.text(say("Click on another body (or key 9) to see its forces."), SIZE, theme.DIM)
        card.y += 4
    card.put(force_diagrams.free_body(pen, (width, pen.px(DIAGRAM)), found), 0)
    card.y += pen.px(DIAGRAM) + 6
    row = list(session.world.scene.bodies).index(found.body)
    vx, vy = session.world.snapshot.velocity[row].tolist()
    _table(card, found, axes.first(found, (vx, vy)), axes.inclined)
    for holds, text in ((found.struck, STRUCK), (found.is_completed, CLOSED)):
        if holds:
            card.text(say(text), SIZE, theme.NOTICE)
    card.y += 2
    card.put(force_diagrams.polygon(pen, (width, pen.px(POLYGON)), found), 0)
    card.y += pen.px(POLYGON) + 8
    return card.drawn()


def _table(card: TextColumn, found: FreeBody, first: XY, inclined: bool) -> None:
    """Add a row for each force, for their sum, and for mass times acceleration."""
    axes = (say("along"), say("across")) if inclined else ("x", "y")
    _row(card, "N", None, (say("size"), *axes), theme.DIM)
    for acting, title in forces_on_selected_body.titles(found):
        cells = _cell(acting.force, first)
        _row(card, title, forces_on_selected_body.color(acting), cells, theme.TEXT)
    line = pygame.Surface((card.width, 1))
    line.fill(theme.EDGE)
    card.y += 2
    card.put(line, 0)
    card.y += 3
    _row(
        card,
        say("sum"),
        None,
        _cell(forces_on_selected_body.without_rounding(found.net, found), first),
        theme.RESULTANT,
    )
    _row(
        card,
        "m a",
        None,
        _cell(
            forces_on_selected_body.without_rounding(found.mass_times_acceleration, found), first
        ),
        theme.RESULTANT,
    )
    if found.moment:
        card.y += 4
        spin = found.moment * found.angular_acceleration
        x, y = found.center
        levers = (
            a.magnitude * hypot(a.at[0] - x, a.at[1] - y) + abs(a.couple) for a in found.forces
        )
        scale = max(levers, default=0.0)
        for name, value in ((say("torques about the centre"), found.torque), ("I α", spin)):
            torque = number(0.0 if abs(value) < forces_on_selected_body.FAINT * scale else value, 3)
            _row(card, name, None, ("", "", f"{torque} N m"), theme.DIM)
    card.y += 4


def _cell(force: XY, first: XY) -> tuple[str, ...]:
    size = hypot(*force)
    parts = (
        0.0 if abs(part) < forces_on_selected_body.FAINT * size else part
        for part in components(force, first)
    )
    return forces_on_selected_body.newtons(size), *(
        forces_on_selected_body.newtons(part) for part in parts
    )


def _row(
    card: TextColumn, name: str, mark: Color | None, cells: tuple[str, ...], color: Color
) -> None:
    """Add a row: a name, and numbers in columns; what exerts a force may need a line of its own."""
    pen = card.pen
    indent = 0
    if mark is not None:
        square = pygame.Surface((pen.px(MARK), pen.px(MARK)))
        square.fill(mark)
        card.put(square, 0, pen.px(4))
        indent = pen.px(MARK) + 5
    images = [pen.write(cell, SIZE, color) for cell in cells]
    right = card.width
    for image in reversed(images):
        card.put(image, right - image.width)
        right -= max(pen.px(NUMBER), image.width + 6) if image.width else 0
    room, by = right - indent - 4, ""
    if pen.write(name, SIZE).width > room:
        name, _, by = name.partition(", ")
    card.put(pen.write(pen.shorten(name, room, SIZE), SIZE, color), indent)
    card.y += pen.height(SIZE) + 1
    if by:
        by = pen.shorten(by, card.width - indent, SIZE)
        card.put(pen.write(by, SIZE, theme.DIM), indent)
        card.y += pen.height(SIZE) + 1
