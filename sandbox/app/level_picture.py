"""A still picture of a level, drawn without a window."""

from collections.abc import Callable
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import pygame

from sandbox.app.cards.checks import checks
from sandbox.app.cards.energy import energy
from sandbox.app.drawing import energy_graph, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.effects import switching_effects
from sandbox.app.pages.level.card import clock, header, settings
from sandbox.app.pages.register import runs_beside
from sandbox.app.pages.scheme_race import scheme_comparison
from sandbox.app.runs.companion_runs import Changes
from sandbox.app.runs.session import Session
from sandbox.app.stage import run_legend
from sandbox.app.stage.stage import Stage
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import say
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.levels_with_changed_effects import Variation

SIZE = (1280, 720)  # px
TELLING = 0.4
"""The default time of a picture, as a fraction of the level's duration."""

SIDE = 340  # px, the width of the text column
MARGIN = 16  # px
GRAPH = 90  # px, the height of the graph


@dataclass(frozen=True, slots=True)
class ComparisonRun:
    """Another run, drawn dashed over the picture's own for comparison."""

    level: Level
    """the same bodies, with more or fewer effects"""
    variations: tuple[Variation, ...]
    """the changes from it to the picture's own level"""


def render(
    level: Level,
    values: Values,
    at: float | None = None,
    size: tuple[int, int] = SIZE,
    beside: ComparisonRun | None = None,
    *,
    racing: bool = False,
) -> pygame.Surface:
    """Run a level up to a time and draw it, with its checks.

    Parameters
    ----------
    level
        The level to draw.
    values
        The parameters of the level.
    at
        The time [s], rounded up to a step; by default `TELLING` of the duration.
    size
        The size of the picture [px].
    beside
        The run for comparison; then the differences are drawn in place of the checks.
    racing
        Whether to draw runs with the level's other schemes, too.

    Raises
    ------
    SandboxError
        If the run fails before that time.
    """
    pygame.font.init()
    pen = Pen()
    session = _session(level, values, beside, racing)
    picture = pygame.Surface(size)
    picture.fill(theme.PANEL)
    stage = Stage(pen, (size[0] - SIDE, size[1]))
    stage.use(session.world)
    stage.fit()
    _run(session, session.duration * TELLING if at is None else at, stage.note_speeds)
    drawn = picture.subsurface((0, 0, size[0] - SIDE, size[1]))
    stage.draw(drawn, session.trail, session.milestones(), session.companions)
    run_legend.draw(drawn, pen, runs_beside(session)[1], view=stage.view)
    _write(picture, session, pen)
    return picture


def _session(level: Level, values: Values, beside: ComparisonRun | None, racing: bool) -> Session:
    session = Session(beside.level if beside else level, values)
    if beside:
        switching_effects.play_over(
            session, beside.level, level, Changes(effects=beside.variations)
        )
    if racing:
        scheme_comparison.toggle(session)
    return session


def save_picture(
    level: Level,
    values: Values,
    path: Path,
    at: float | None = None,
    size: tuple[int, int] = SIZE,
    beside: ComparisonRun | None = None,
    *,
    racing: bool = False,
) -> None:
    """Draw a level into a PNG file, completely or not at all; see `render`.

    Raises `SandboxError` if the run fails before that time, or the file cannot be written.
    """
    write_atomically(path, png(render(level, values, at, size, beside, racing=racing)))


def png(picture: pygame.Surface) -> bytes:
    """Return a picture encoded as PNG."""
    encoded = BytesIO()
    pygame.image.save(picture, encoded, "x.png")
    return encoded.getvalue()


def _run(session: Session, at: float, each: Callable[[], None]) -> None:
    for _ in range(session.world.stepping.steps(at)):
        session.step()
        if session.failure is not None:
            raise session.failure
        each()


def _write(picture: pygame.Surface, session: Session, pen: Pen) -> None:
    """Fill the text column, with the energy at its foot."""
    width, left = SIDE - 2 * MARGIN, picture.width - SIDE + MARGIN
    level, y = session.level, MARGIN
    when = say(
        "t = {now} of {whole}",
        now=formatting.seconds(session.t),
        whole=formatting.seconds(session.duration),
    )
    parts = [header(pen, width, level), clock(pen, width, when)]
    if level.parameters:
        parts.append(settings(pen, width, level, session.values))
    for part in parts:
        picture.blit(part, (left, y))
        y += part.height + 8
    drawn = energy_graph.energies((width, GRAPH), session.books.history, session.duration)
    foot = energy(pen, width, session.books.start, session.books.energies, drawn)
    end = picture.height - foot.height - MARGIN
    picture.blit(_comparison_or_checks(session, pen, width, end - y), (left, y))
    picture.fill(theme.PANEL, (left, end, width, picture.height - end))
    picture.blit(foot, (left, end))


def _comparison_or_checks(session: Session, pen: Pen, width: int, room: int) -> pygame.Surface:
    """Draw a page's comparison of the runs, or the checks."""
    page, _ = runs_beside(session)
    if page is not None and page.card is not None:
        return page.card(pen, width, session)
    return _checks(session, pen, width, room)


def _checks(session: Session, pen: Pen, width: int, room: int) -> pygame.Surface:
    """Draw as many checks as there is room for."""
    readings, words = session.readings(), level_translation.of(session.original)
    drawn = checks(pen, width, readings, words)
    for count in range(len(readings) - 1, 0, -1):
        if drawn.height <= room:
            break
        drawn = checks(pen, width, readings[:count], words, left_out=len(readings) - count)
    return drawn
