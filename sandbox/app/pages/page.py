"""The declaration of a page of the side panel, from which everything else about it is derived."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any, NamedTuple, Protocol, TypeVar, runtime_checkable

import pygame

from sandbox.app.drawing.text import Pen
from sandbox.app.files.preferences import WindowPreferences
from sandbox.app.frame_budget import Load
from sandbox.app.runs.session import Session
from sandbox.app.stage.run_legend import LegendRow
from sandbox.app.stage.stage import Stage
from sandbox.app.widgets.scrolling_area import Panel, Sheet, below
from sandbox.app.widgets.text_field import TextField
from sandbox.app.window_keys import Binding
from sandbox.model.level import Level


class Worker(Protocol):
    """The background work of a page; each window has one, whatever it shows."""

    @property
    def news(self) -> object:
        """An object that differs whenever the display must change."""

    @property
    def running(self) -> bool:
        """Whether work is under way."""

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Let time pass [s], every frame; return a message, None if there is none.

        `watched` is whether its page is the chosen one.
        """

    def cancel(self) -> None:
        """Cancel the work."""


class IdleWorker:
    """A worker without background work, which only remembers something for its page."""

    running = False

    def __init__(self) -> None:
        self.news = object()

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Do nothing, as there is no work."""

    def cancel(self) -> None:
        """Do nothing, as there is no work."""


W = TypeVar("W", bound=Worker)


class FindWorker(Protocol):
    """Returns the worker of a kind; raises `LookupError` if no page declares it."""

    def __call__(self, kind: type[W]) -> W:
        """Return the worker of a kind."""


@runtime_checkable
class OnStage(Protocol):
    """A worker that handles mouse and keys on the stage first, while its page is open.

    It replaces the hand that grabs bodies, and may draw in place of the run.
    """

    def command(self, command: str, session: Session) -> bool:
        """Handle a command of the window, and return whether the window must not execute it."""

    def key(self, event: pygame.event.Event, session: Session) -> bool:
        """Handle a pressed key, and return whether it has a meaning here."""

    def process(
        self, event: pygame.event.Event, area: pygame.Rect, stage: Stage, session: Session
    ) -> bool:
        """Handle a mouse event, and return whether it has a meaning here."""

    def draw(self, surface: pygame.Surface, stage: Stage, pen: Pen, session: Session) -> bool:
        """Draw on the stage, and return whether that replaces the run."""

    def draw_over(self, surface: pygame.Surface, stage: Stage, pen: Pen) -> None:
        """Draw over the run, if it is drawn."""


@runtime_checkable
class ZoomablePage(Protocol):
    """A page with a part that the wheel zooms, instead of scrolling the page."""

    def wheel(self, notches: float, pixel: tuple[int, int]) -> bool:
        """Zoom about the mouse if it is over the part, and return whether it is."""

    def home(self) -> bool:
        """Reset the zoom, and return whether there was one."""


@runtime_checkable
class CommandPage(Protocol):
    """A page with buttons for commands of the window."""

    def command_of(self, button: object) -> str | None:
        """Return the command of a button; None if it is not one of these."""


@runtime_checkable
class AskingPage(Protocol):
    """A page that asks for a number."""

    @property
    def awaited(self) -> TextField | None:
        """The field that awaits the answer; None while there is no question."""


class Desk(NamedTuple):
    """The objects with which pages work."""

    session: Session
    worker: FindWorker
    """returns the worker of a kind, its page's own or another's"""
    load: Load
    comfort: WindowPreferences
    shown: Mapping[str, bool]
    """whether each overlay of the stage is drawn, by name"""


def imported(module: str, name: str) -> Callable[..., Any]:
    """Return a function that imports what it stands for when it is first called.

    The first picture of the window needs the names of all pages, but the contents of one. What a
    page consists of is therefore imported when it is opened, or after the first picture.
    """
    return lambda *arguments: getattr(import_module(module), name)(*arguments)


class PageCommand(NamedTuple):
    """A command of a page, available in the whole window."""

    name: str
    character: str
    """its key; a capital letter is that letter with Shift; none if empty"""
    text: str
    """its description in the help"""
    act: Callable[[Desk], str | None]
    """executes it, and returns a message, if any; a `SandboxError` is shown as one"""
    control: int | None = None
    """its key together with Ctrl"""

    @property
    def binding(self) -> Binding:
        """Its key."""
        letter = self.character
        shown = f"Shift {letter}" if letter.isupper() else letter.upper()
        if self.control is not None:
            with_control = f"Ctrl {pygame.key.name(self.control).upper()}"
            shown = f"{shown} or {with_control}" if shown else with_control
        controls = () if self.control is None else (self.control,)
        return Binding(self.name, shown, self.text, (), letter, controls)


@dataclass(frozen=True, slots=True)
class Page:
    """The declaration of a page, in the `__init__.py` of its folder.

    Raises `ValueError` if a part is missing.
    """

    name: str
    """the name of its folder"""
    caption: str
    """the caption of its tab"""
    text: str
    """its description, in the help and the tooltip of its tab"""
    key: str = ""
    """the character that opens it; if empty, only its tab and the key for the next page do"""
    card: Callable[[Pen, int, Session], pygame.Surface] | None = None
    """draws its contents with a width [px]; a page without a panel shows only this"""
    panel: Callable[[Sheet, Desk], Panel] | None = None
    """makes its widgets"""
    worker: Callable[[], Worker] | None = None
    """makes its background worker"""
    commands: tuple[PageCommand, ...] = ()
    own_keys: Callable[[], Sequence[tuple[str, str]]] = tuple
    """returns the keys that have a meaning only while it is open, and their descriptions in the
    help"""
    energy: bool = True
    """whether the energies are shown below it"""
    books: bool = False
    """whether it shows where energy or momentum comes from and goes, recorded while it is open"""
    suits_level: Callable[[Level], bool] | None = None
    """whether a level is opened with this page, instead of the first"""
    shows_recorded_states: bool = False
    """whether it shows the recorded state while the run is still on its way there"""
    overlay: str = ""
    """an overlay of the stage that is drawn while the page is shown, even if switched off"""
    superimposed_runs: Callable[[Session], Sequence[LegendRow]] | None = None
    """the runs that the page superimposes on the stage, that of the session first; empty if none.
    A still picture then shows the page's card in place of the checks."""

    def __post_init__(self) -> None:
        for part in ("name", "caption", "text"):
            if not getattr(self, part):
                raise ValueError(self._lacks(f"a {part}"))
        if self.card is None and self.panel is None:
            raise ValueError(self._lacks("a card or a panel: it would show nothing"))
        if self.card is None and self.superimposed_runs is not None:
            raise ValueError(self._lacks("a card, which a picture shows of what runs beside"))

    def _lacks(self, part: str) -> str:
        return (
            f"page '{self.name}' lacks {part}; say it in sandbox/app/pages/{self.name}/__init__.py"
        )

    @property
    def command(self) -> str:
        """The command that opens the page."""
        return f"{self.name} page"

    @property
    def bindings(self) -> tuple[Binding, ...]:
        """Its keys: the one that opens it, and those of its commands."""
        taken = {command.character for command in self.commands}
        opening = "".join(c for c in dict.fromkeys((self.key, self.key.upper())) if c not in taken)
        return (
            *(
                [Binding(self.command, self.key.upper(), self.text, (), opening)]
                if self.key
                else []
            ),
            *(command.binding for command in self.commands),
        )

    def open(self, sheet: Sheet, desk: Desk) -> Panel:
        """Make its contents on a sheet."""
        if self.panel is not None:
            return self.panel(sheet, desk)
        assert self.card is not None
        return CardPanel(sheet, desk.session, self.card)

    def runs(self, session: Session) -> Sequence[LegendRow]:
        """Return the runs that the page superimposes on the stage."""
        return self.superimposed_runs(session) if self.superimposed_runs is not None else ()


class CardPanel:
    """A page with a card only, without widgets."""

    def __init__(
        self, sheet: Sheet, session: Session, card: Callable[[Pen, int, Session], pygame.Surface]
    ) -> None:
        self._sheet, self._session, self._card = sheet, session, card
        self._image = sheet.image(self._drawn(), self._sheet.margin // 2)
        self.update()

    def process(self, _event: pygame.event.Event) -> str | None:
        """Return None, as there are no widgets."""
        return None

    def update(self) -> None:
        """Draw the card again."""
        self._sheet.replace(self._image, self._drawn())
        self._sheet.set_content_height(below(self._image) + 2)

    def _drawn(self) -> pygame.Surface:
        return self._card(self._sheet.pen, self._sheet.width, self._session)
