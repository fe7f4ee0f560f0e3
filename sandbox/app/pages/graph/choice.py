"""The quantities chosen for the graphs, level by level, as long as the window is open."""

from itertools import chain, islice
from pathlib import Path

from sandbox.app.background import Background
from sandbox.app.pages.graph.figure import Figure, saved
from sandbox.app.pages.graph.zoom import WHOLE, Zoom
from sandbox.app.runs.session import Session
from sandbox.app.words.language import say
from sandbox.model.level import Level
from sandbox.model.quantities import TIME, momentary

MOST = 400
"""How many quantities can be chosen from; in a crowd, those of its first bodies."""


def offered(level: Level) -> list[str]:
    """Return the quantities that can be drawn: all that follow from a state alone.

    Those of bodies that never move come last.
    """
    static = {name for name, body in level.bodies.items() if body.type == "static"}
    moving = (found.name for found in momentary(level) if found.subject not in static)
    still = (found.name for found in momentary(level) if found.subject in static)
    return list(islice(chain(moving, still), MOST))


class Choice:
    """Remembers the chosen quantities, and draws them into a file.

    Attributes
    ----------
    news
        Another object whenever something else is chosen.
    """

    def __init__(self) -> None:
        self.news = object()
        self._work = Background()
        self._up: dict[str, tuple[str, ...]] = {}
        self._across: dict[str, str] = {}
        self._zooms: dict[str, Zoom] = {}
        self._offered: tuple[Level, list[str]] | None = None

    def up(self, session: Session) -> tuple[str, ...]:
        """Return what is drawn: at first what the first check measures, or the first speed."""
        names = self._names(session.level)
        checked = (c.quantity for c in session.original.checks if c.quantity in names)
        speeds = (name for name in names if name.endswith(".speed"))
        first = next(checked, next(speeds, names[0]))
        chosen = self._up.get(session.original.title, (first,))
        return tuple(name for name in chosen if name in names)

    def across(self, session: Session) -> str:
        """Return against what: the time, at first."""
        chosen = self._across.get(session.original.title, TIME.name)
        return chosen if chosen in self._names(session.level) else TIME.name

    def _names(self, level: Level) -> list[str]:
        """Return what is offered of a level, which is the same as long as it is shown."""
        if self._offered is None or self._offered[0] is not level:
            self._offered = level, offered(level)
        return self._offered[1]

    def choose(self, session: Session, up: tuple[str, ...]) -> None:
        """Draw other quantities; of those that stay, the same part."""
        self._up[session.original.title] = up
        self.news = object()

    def against(self, session: Session, name: str) -> None:
        """Draw them against another quantity, all of it."""
        self._across[session.original.title] = name
        self.look(session, WHOLE)

    def zoom(self, session: Session) -> Zoom:
        """Return the visible part of the graphs: at first, all of them."""
        return self._zooms.get(session.original.title, WHOLE)

    def look(self, session: Session, zoom: Zoom) -> None:
        """Look at another part of them."""
        self._zooms[session.original.title] = zoom
        self.news = object()

    @property
    def running(self) -> bool:
        """Whether a picture is being drawn."""
        return self._work.running

    def draw(self, found: Figure, path: Path) -> str:
        """Draw a picture of graphs into a file, and return the message for it."""
        self._work.start(saved, found, path)
        return say("drawing ...")

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:  # noqa: ARG002
        """Return where the picture is once it is drawn."""
        return next(iter([*self._work.found()][-1:]), None)

    def cancel(self) -> None:
        """End the work; there is no picture then."""
        self._work.cancel()
