"""A still picture of a level, drawn without a window."""

from collections.abc import Callable
from dataclasses import dataclass
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
from sandbox.physics.comparison import differences
from sandbox.physics.trace import needed, simulate

SIZE = (1280, 720)  # px
TELLING = 0.4
"""The share of a level's duration at which it is drawn if nobody says when."""

SIDE = 340  # px, the column of words
MARGIN = 16  # px
GRAPH = 90  # px, its height


@dataclass(frozen=True, slots=True)
class Beside:
    """Another run that is drawn dashed over a picture's own, and held against it."""

    level: Level
    """the same bodies, with effects more or less"""
    told: str
    """what makes the picture's own level differ from it, such as `without drag`"""


def render(
    level: Level,
    values: Values,
    at: float | None = None,
    size: tuple[int, int] = SIZE,
    beside: Beside | None = None,
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
    beside
        What the run is compared with; then the differences stand in place of the checks.

    Raises
    ------
    SandboxError
        If the run has to stop before that time.
    """
    pygame.font.init()
    pen = Pen()
    session = Session(level, values)
    picture = pygame.Surface(size)
    picture.fill(theme.PANEL)
    stage = Stage(pen, (size[0] - SIDE, size[1]))
    stage.use(session.world)
    stage.fit()
    _run(session, session.duration * TELLING if at is None else at, stage.watch)
    stage.shown.ghosts = beside is None
    drawn = picture.subsurface((0, 0, size[0] - SIDE, size[1]))
    stage.draw(drawn, session.trail, () if beside else session.milestones())
    if beside:
        other = Session(beside.level, values)
        _run(other, session.t, stage.watch)
        stage.draw_beside(drawn, other.world, other.trail)
    _write(picture, session, pen, beside)
    return picture


def save_picture(
    level: Level,
    values: Values,
    path: Path,
    at: float | None = None,
    size: tuple[int, int] = SIZE,
    beside: Beside | None = None,
) -> None:
    """Draw a level into a PNG file, whole or not at all; see `render`.

    Raises
    ------
    SandboxError
        If the run has to stop before that time, or the file cannot be written.
    """
    png = BytesIO()
    pygame.image.save(render(level, values, at, size, beside), png, "x.png")
    write_atomically(path, png.getvalue())


def _run(session: Session, at: float, each: Callable[[], None]) -> None:
    for _ in range(ceil(at * session.world.stepping.rate * (1 - 1e-12))):
        session.step()
        if session.failure is not None:
            raise session.failure
        each()


def _write(picture: pygame.Surface, session: Session, pen: Pen, beside: Beside | None) -> None:
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
    checks = _compared(session, pen, width, beside) if beside else None
    picture.blit(checks or _checks(session, pen, width, end - y), (left, y))
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


def _compared(session: Session, pen: Pen, width: int, beside: Beside) -> pygame.Surface:
    """Draw how the run differs from the one beside it, up to now."""
    runs = (
        simulate(level, session.values, session.t, needed(beside.level))
        for level in (beside.level, session.level)
    )
    return cards.compared(pen, width, beside.told, differences(*runs))
