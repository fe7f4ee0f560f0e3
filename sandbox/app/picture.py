"""A still picture of a level, drawn without a window."""

from io import BytesIO
from math import ceil
from pathlib import Path

import pygame

from sandbox.app import cards, graph, theme, wording
from sandbox.app.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.text import Pen
from sandbox.model.expressions import Values
from sandbox.model.files import write_atomically
from sandbox.model.level import Level

SIZE = (1280, 720)  # px
TELLING = 0.4
"""The share of a level's duration at which it is drawn if nobody says when."""

SIDE = 340  # px, the column of words
MARGIN = 16  # px
GRAPH = 90  # px, its height


def render(
    level: Level, values: Values, at: float | None = None, size: tuple[int, int] = SIZE
) -> pygame.Surface:
    """Run a level up to a time and draw it, with its checks.

    Parameters
    ----------
    level
        What to draw.
    values
        Its parameters.
    at
        When [s]; a telling moment if left out. The last step is the first not before it.
    size
        Of the picture [px].

    Raises
    ------
    SandboxError
        If the run has to stop before that time.
    """
    pygame.font.init()
    pen = Pen()
    session = Session(level, values)
    _run(session, session.duration * TELLING if at is None else at)
    picture = pygame.Surface(size)
    picture.fill(theme.PANEL)
    stage = Stage(pen, (size[0] - SIDE, size[1]))
    stage.use(session.world)
    stage.fit()
    view = picture.subsurface((0, 0, size[0] - SIDE, size[1]))
    stage.draw(view, session.trail, session.milestones())
    _write(picture, session, pen)
    return picture


def save_picture(
    level: Level,
    values: Values,
    path: Path,
    at: float | None = None,
    size: tuple[int, int] = SIZE,
) -> None:
    """Draw a level into a PNG file, whole or not at all; see `render`.

    Raises
    ------
    SandboxError
        If the run has to stop before that time, or the file cannot be written.
    """
    png = BytesIO()
    pygame.image.save(render(level, values, at, size), png, "x.png")
    write_atomically(path, png.getvalue())


def _run(session: Session, at: float) -> None:
    for _ in range(ceil(at * session.world.stepping.rate * (1 - 1e-12))):
        session.step()
        if session.failure is not None:
            raise session.failure


def _write(picture: pygame.Surface, session: Session, pen: Pen) -> None:
    """Fill the column of words; the energy stands at its foot."""
    width, left = SIDE - 2 * MARGIN, picture.width - SIDE + MARGIN
    level, y = session.level, MARGIN
    when = f"t = {wording.seconds(session.t)} of {wording.seconds(session.duration)}"
    for part in (
        cards.header(pen, width, level),
        cards.clock(pen, width, when),
        cards.settings(pen, width, level, session.values),
    ):
        picture.blit(part, (left, y))
        y += part.height + 8
    drawn = graph.energies((width, GRAPH), session.history, session.duration)
    foot = cards.energy(pen, width, session.start_energies, session.energies(), drawn)
    end = picture.height - foot.height - MARGIN
    picture.blit(_checks(session, pen, width, end - y), (left, y))
    picture.fill(theme.PANEL, (left, end, width, picture.height - end))
    picture.blit(foot, (left, end))


def _checks(session: Session, pen: Pen, width: int, room: int) -> pygame.Surface:
    """Draw as many checks as there is room for."""
    readings = session.readings()
    drawn = cards.checks(pen, width, readings)
    for count in range(len(readings) - 1, 0, -1):
        if drawn.height <= room:
            break
        drawn = cards.checks(pen, width, readings[:count], left_out=len(readings) - count)
    return drawn
