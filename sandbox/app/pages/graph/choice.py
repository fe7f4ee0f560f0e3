"""Which quantities a person looks at, level by level, for as long as the window is open."""

from itertools import chain, islice

from sandbox.app.session import Session
from sandbox.model.level import Level
from sandbox.model.quantities import TIME, momentary

MOST = 400
"""How many quantities can be chosen from: of a crowd, those of its first bodies."""


def offered(level: Level) -> list[str]:
    """Return the quantities that can be drawn: all that a state tells by itself.

    Those of bodies that never move come last.
    """
    static = {name for name, body in level.bodies.items() if body.type == "static"}
    moving = (found.name for found in momentary(level) if found.subject not in static)
    still = (found.name for found in momentary(level) if found.subject in static)
    return list(islice(chain(moving, still), MOST))


class Choice:
    """Remembers what was chosen.

    Attributes
    ----------
    news
        Another object whenever something else is chosen.
    """

    running = False

    def __init__(self) -> None:
        self.news = object()
        self._up: dict[str, tuple[str, ...]] = {}
        self._across: dict[str, str] = {}

    def up(self, session: Session) -> tuple[str, ...]:
        """Return what is drawn: at first what the first check measures, or the first speed."""
        names = offered(session.level)
        checked = (c.quantity for c in session.original.checks if c.quantity in names)
        speeds = (name for name in names if name.endswith(".speed"))
        first = next(checked, next(speeds, names[0]))
        chosen = self._up.get(session.original.title, (first,))
        return tuple(name for name in chosen if name in names)

    def across(self, session: Session) -> str:
        """Return against what: the time, at first."""
        chosen = self._across.get(session.original.title, TIME.name)
        return chosen if chosen in offered(session.level) else TIME.name

    def choose(self, session: Session, up: tuple[str, ...]) -> None:
        """Draw other quantities."""
        self._up[session.original.title] = up
        self.news = object()

    def against(self, session: Session, name: str) -> None:
        """Draw them against another quantity."""
        self._across[session.original.title] = name
        self.news = object()

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """There is nothing to find out."""

    def cancel(self) -> None:
        """There is no work that could be ended."""
