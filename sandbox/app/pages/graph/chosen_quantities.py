"""The quantities chosen for the graphs of each level, while the window is open."""

from itertools import chain, islice
from pathlib import Path

from sandbox.app.background_process import BackgroundTask
from sandbox.app.pages.graph.matplotlib_figure import Figure, saved
from sandbox.app.pages.graph.zoom import WHOLE, Zoom
from sandbox.app.runs.session import Session
from sandbox.app.words.formatting import name_in_words
from sandbox.app.words.language import say
from sandbox.model.last_result_cache import of_the_last
from sandbox.model.level import Check, Level
from sandbox.model.level_parts import names_in
from sandbox.model.quantities import TIME, momentary_quantities

MOST = 400
"""The largest number of quantities offered; with many bodies, those of the first."""


@of_the_last
def offered(level: Level) -> list[str]:
    """Return the quantities that can be drawn: all that depend on a single state.

    Those of static bodies come last.
    """
    static = {name for name, body in level.bodies.items() if body.type == "static"}
    moving = (found.name for found in momentary_quantities(level) if found.subject not in static)
    still = (found.name for found in momentary_quantities(level) if found.subject in static)
    return list(islice(chain(moving, still), MOST))


def words_for_search(quantity: str) -> str:
    """Return the words by which a quantity is found: its own, and the body's as it is read."""
    return f"{quantity} {name_in_words(quantity.partition('.')[0])}".casefold()


class Choice(BackgroundTask):
    """Keeps the chosen quantities, and draws them into a file."""

    def __init__(self) -> None:
        super().__init__()
        self._up: dict[str, tuple[str, ...]] = {}
        self._across: dict[str, str] = {}
        self._zooms: dict[str, Zoom] = {}

    def up(self, session: Session) -> tuple[str, ...]:
        """Return the chosen quantities: at first one of a check that changes, or a speed."""
        names = offered(session.level)
        checked = (
            c.quantity for c in session.original.checks if c.quantity in names and _changes(c)
        )
        speeds = (name for name in names if name.endswith(".speed"))
        first = next(checked, next(speeds, names[0]))
        chosen = self._up.get(session.original.title, (first,))
        return tuple(name for name in chosen if name in names)

    def across(self, session: Session) -> str:
        """Return the horizontal quantity: at first, the time."""
        chosen = self._across.get(session.original.title, TIME.name)
        return chosen if chosen in offered(session.level) else TIME.name

    def choose(self, session: Session, up: tuple[str, ...]) -> None:
        """Choose quantities, and keep the zoom."""
        self._up[session.original.title] = up
        self.news = object()

    def against(self, session: Session, name: str) -> None:
        """Choose the horizontal quantity, and reset the zoom."""
        self._across[session.original.title] = name
        self.set_zoom(session, WHOLE)

    def zoom(self, session: Session) -> Zoom:
        """Return the visible part of the graphs: at first, the whole."""
        return self._zooms.get(session.original.title, WHOLE)

    def set_zoom(self, session: Session, zoom: Zoom) -> None:
        """Change the visible part of the graphs."""
        self._zooms[session.original.title] = zoom
        self.news = object()

    def draw(self, found: Figure, path: Path) -> str:
        """Start drawing a picture of the graphs into a file, and return the message."""
        self._work.start(saved, found, path)
        return say("drawing ...")

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:  # noqa: ARG002
        """Return the message with the picture's path once it is saved."""
        return next(iter([*self._work.results()][-1:]), None)


def _changes(check: Check) -> bool:
    """Whether a checked quantity changes in time: a conserved one is a graph of rounding errors."""
    return check.at is not None or TIME.name in names_in(check.formula)
