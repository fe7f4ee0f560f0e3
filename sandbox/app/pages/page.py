"""The declaration of a page of the side panel, from which everything else about it is derived."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol, TypeVar, runtime_checkable

import pygame

from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.files.preferences import Comfort
from sandbox.app.frame_time import Load
from sandbox.app.keys import Binding
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.widgets.sheet import Panel, Sheet, below
from sandbox.model.level import Level

Row = tuple[Color | None, str]
"""A colour (None for the run that is played), and what is drawn in it."""


class Worker(Protocol):
    """What a page finds out in the background; there is one a window, whatever is shown."""

    @property
    def news(self) -> object:
        """Another object whenever something else is to be shown."""
        ...

    @property
    def running(self) -> bool:
        """Whether something is being worked on."""
        ...

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Let some time pass [s], every frame; return a message, None if there is none.

        `watched` says whether its page is the one that is chosen.
        """
        ...

    def cancel(self) -> None:
        """End the work."""
        ...


W = TypeVar("W", bound=Worker)


@runtime_checkable
class OnStage(Protocol):
    """What mouse and keys are for on the stage while its page is open, before all others.

    A page's worker that is one takes the hand's place, and may draw in place of the run.
    """

    def command(self, command: str, session: Session) -> bool:
        """Do what a command of the window means here; return whether it means something else."""
        ...

    def key(self, event: pygame.event.Event, session: Session) -> bool:
        """Do what a pressed key means here, and return whether it means anything."""
        ...

    def process(
        self, event: pygame.event.Event, area: pygame.Rect, stage: Stage, session: Session
    ) -> bool:
        """Do what the mouse asks for, and return whether that was for this."""
        ...

    def draw(self, surface: pygame.Surface, stage: Stage, pen: Pen, session: Session) -> bool:
        """Draw what is made on the stage's surface; return whether that stands for the run."""
        ...

    def draw_over(self, surface: pygame.Surface, stage: Stage, pen: Pen) -> None:
        """Draw over the run, where that is drawn."""
        ...


@runtime_checkable
class Zoomed(Protocol):
    """What a page shows that the wheel zooms, before it scrolls the page."""

    def wheel(self, notches: float, pixel: tuple[int, int]) -> bool:
        """Zoom about the mouse, if it is over that, and return whether it is."""
        ...

    def home(self) -> bool:
        """Show all of it, and return whether that was not the case."""
        ...


@runtime_checkable
class Leading(Protocol):
    """A page with buttons that call for a command of the window."""

    def leads(self, button: object) -> str | None:
        """Return the command that a button of its calls for; None if it is another one."""
        ...


class Desk(NamedTuple):
    """What a page works with."""

    session: Session
    workers: Sequence[Worker]
    load: Load
    comfort: Comfort

    def worker(self, kind: type[W]) -> W:
        """Return the worker of a kind."""
        return worker(self.workers, kind)


def worker(workers: Sequence[Worker], kind: type[W]) -> W:
    """Return the worker of a kind.

    Raises
    ------
    LookupError
        If no page declares it.
    """
    for each in workers:
        if isinstance(each, kind):
            return each
    raise LookupError(f"no page declares {kind.__name__} as its worker")


class PageCommand(NamedTuple):
    """A command that a page understands, from anywhere in the window."""

    name: str
    character: str
    """the key that calls for it; a capital letter is that letter with Shift; none if empty"""
    text: str
    """what the help says"""
    act: Callable[[Desk], str | None]
    """does it, and returns what is to be told; a `SandboxError` is told, too"""
    control: int | None = None
    """a key that calls for it together with Ctrl"""

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
    """The declaration of a page. It stands in its folder's `__init__.py`.

    Raises
    ------
    ValueError
        If a part is missing.
    """

    name: str
    """the name of its folder"""
    caption: str
    """of its tab"""
    text: str
    """what the help and its tab's tool tip say"""
    key: str = ""
    """the letter or sign that opens it; without one its tab does, and the key of the next page"""
    card: Callable[[Pen, int, Session], pygame.Surface] | None = None
    """draws what it tells, so wide [px]; a page without a panel shows this and nothing else"""
    panel: Callable[[Sheet, Desk], Panel] | None = None
    """makes what can be clicked on"""
    worker: Callable[[], Worker] | None = None
    """makes what it finds out in the background"""
    commands: tuple[PageCommand, ...] = ()
    keys: tuple[tuple[str, str], ...] = ()
    """keys and what they do while it is open, and not otherwise: what the help tells then"""
    energy: bool = True
    """whether the energies stand below it"""
    books: bool = False
    """whether it tells where energy or momentum come from and go: it is booked while it is open"""
    suits: Callable[[Level], bool] | None = None
    """which levels it is made for: with those it is opened, and with others the first page is"""
    recalls: bool = False
    """whether it tells what was recorded, while the run itself is on its way there"""
    overlay: str = ""
    """an overlay of the stage that is drawn while the page is shown, also if it is switched off"""
    beside: Callable[[Session], Sequence[Row]] | None = None
    """what runs over each other on the stage for its sake, the run that is played first; empty
    where nothing does. A still picture shows the page's card then, in place of the checks."""

    def __post_init__(self) -> None:
        for part in ("name", "caption", "text"):
            if not getattr(self, part):
                raise ValueError(self._lacks(f"a {part}"))
        if self.card is None and self.panel is None:
            raise ValueError(self._lacks("a card or a panel: it would show nothing"))
        if self.card is None and self.beside is not None:
            raise ValueError(self._lacks("a card, which a picture shows of what runs beside"))

    def _lacks(self, part: str) -> str:
        return (
            f"page '{self.name}' lacks {part}; say it in sandbox/app/pages/{self.name}/__init__.py"
        )

    @property
    def command(self) -> str:
        """The command that opens it."""
        return f"{self.name} page"

    @property
    def bindings(self) -> tuple[Binding, ...]:
        """Its keys: one opens it, the others call for what it understands."""
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
        """Put what it shows on a sheet."""
        if self.panel is not None:
            return self.panel(sheet, desk)
        assert self.card is not None
        return CardPanel(sheet, desk.session, self.card)

    def runs(self, session: Session) -> Sequence[Row]:
        """Return what runs over each other on the stage for its sake."""
        return self.beside(session) if self.beside is not None else ()


class CardPanel:
    """A page that is a card, and nothing to click on."""

    def __init__(
        self, sheet: Sheet, session: Session, card: Callable[[Pen, int, Session], pygame.Surface]
    ) -> None:
        self._sheet, self._session, self._card = sheet, session, card
        self._image = sheet.image(self._drawn(), self._sheet.margin // 2)
        self.update()

    def process(self, _event: pygame.event.Event) -> str | None:
        """Return nothing: there is nothing to click on."""
        return None

    def update(self) -> None:
        """Draw the card again."""
        self._sheet.replace(self._image, self._drawn())
        self._sheet.end(below(self._image) + 2)

    def _drawn(self) -> pygame.Surface:
        return self._card(self._sheet.pen, self._sheet.width, self._session)
