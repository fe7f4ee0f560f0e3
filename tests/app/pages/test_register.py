"""Every registered page: its tab, its keys, its commands, and what it shows."""

from collections.abc import Callable
from pathlib import Path

import pygame
import pytest

import sandbox.app.pages
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import PANEL
from sandbox.app.pages import register
from sandbox.app.pages.page import Desk, Page
from sandbox.app.pages.register import PAGES
from sandbox.app.pages.worker_registry import Workers
from sandbox.app.panels import tabs
from sandbox.app.runs.session import Session
from sandbox.app.stage.run_legend import LegendRow
from sandbox.app.widgets.scrolling_area import Panel, Sheet
from tests.app import scenes
from tests.app.person import Person

SIZES = [(900, 600), (1280, 800)]
LEVELS = ["kinematics/projectile", "energy/two-bodies", "newton/atwood", "momentum/billiard-break"]
FOLDER = Path(sandbox.app.pages.__file__).parent


def card(pen: Pen, width: int, session: Session) -> pygame.Surface:
    """Draw a card that says how many bodies there are."""
    return pen.write(f"{len(session.level.bodies)} bodies in {width} px")


def fake(name: str, key: str = "y", caption: str = "", **parts: object) -> Page:
    return Page(name, caption or name.capitalize(), f"the page {name}", key, card, **parts)  # type: ignore[arg-type]


def test_every_folder_of_pages_is_registered_and_every_page_has_its_folder() -> None:
    folders = {path.parent.name for path in FOLDER.glob("*/__init__.py")}
    names = {page.name for page in PAGES}

    forgotten = folders - names
    assert not forgotten, f"name {forgotten} in PAGES, sandbox/app/pages/register.py"
    assert not names - folders, f"a page is called as its folder in sandbox/app/pages: {names}"


def each_with_a_level() -> list[object]:
    """Return every page with every level; the quick tests open each page with one of them."""
    ways = [(page, i, level) for i, page in enumerate(PAGES) for level in range(len(LEVELS))]
    return [
        pytest.param(
            page, LEVELS[level], id=f"{page.name}-{LEVELS[level]}",
            marks=() if level == i % len(LEVELS) else pytest.mark.sweep,
        )
        for page, i, level in ways
    ]  # fmt: skip


def turn_to(person: Person, page: Page) -> None:
    """Press a page's key; a page without one is reached by turning from page to page."""
    if page.key:
        person.press(pygame.key.key_code(page.key), page.key)
        return
    for _ in PAGES:
        if person.window.panels.page != page.command:
            person.press(pygame.K_PAGEDOWN, mod=pygame.KMOD_LCTRL)


@pytest.mark.parametrize(("page", "level"), each_with_a_level())
def test_a_page_is_opened_by_its_key_and_by_its_tab_while_time_runs(
    person: Person, page: Page, level: str
) -> None:
    person.window.open_level(level)
    turn_to(person, page)
    by_key = person.side.page
    elsewhere = next(other for other in PAGES if other is not page)
    turn_to(person, elsewhere)
    assert type(person.side.page) is not type(by_key)

    person.click(person.side.tab(page.command).rect)
    person.press(pygame.K_SPACE, " ")
    person.wait(0.1)

    assert type(person.side.page) is type(by_key)
    assert person.window.panels.page == page.command
    sheet = person.window.surface.subsurface(person.side._sheet.container.rect)
    assert (pygame.surfarray.array3d(sheet) != PANEL).any()


COMMANDS = [(page, command) for page in PAGES for command in page.commands]


@pytest.mark.parametrize(("page", "name"), [(page, command.name) for page, command in COMMANDS])
def test_a_command_of_a_page_is_called_for_by_its_key_and_shows_the_page(
    person: Person, page: Page, name: str
) -> None:
    person.window.open_level(LEVELS[0])
    command = next(command for command in page.commands if command.name == name)
    letter = command.character
    key = pygame.key.key_code(letter.lower()) if letter else command.control
    held = pygame.KMOD_LSHIFT if letter else pygame.KMOD_LCTRL
    assert key is not None

    person.press(key, letter, held)

    assert person.window.panels.page == page.command
    person.press(key, letter, held)
    person.wait(0.1)
    person.window.close()


@pytest.mark.parametrize("page", [p for p in PAGES if p.card], ids=lambda page: page.name)
def test_a_card_is_as_wide_as_it_is_asked_to_be(pen: Pen, page: Page) -> None:
    session = Session(scenes.level())
    assert page.card is not None
    assert page.card(pen, 276, session).width == 276


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("more_pages", [0, 4])
def test_no_caption_of_a_tab_is_cut(
    person: Person, monkeypatch: pytest.MonkeyPatch, size: tuple[int, int], more_pages: int
) -> None:
    names = ("Acceleration", "Table of all", "Sound", "Time")[:more_pages]
    more = [fake(name.lower(), caption=name) for name in names]
    pages = (*PAGES, *more)
    monkeypatch.setattr(register, "PAGES", pages)
    monkeypatch.setattr(tabs, "tip", lambda command: command)
    person.window.open_level(LEVELS[0])

    person.resize(size)

    rects = [person.side.tab(page.command).rect for page in pages]
    across = person.window.panels.layout.side
    pen = Pen()
    for page, rect in zip(pages, rects, strict=True):
        assert pen.write(page.caption, tabs.SIZE).width + 8 <= rect.width, page.caption
        assert across.contains(rect)
        assert len(rect.collidelistall(rects)) == 1
    assert person.side._sheet.container.rect.height >= 240  # the energies fold to make room
    assert person.side._sheet.container.rect.y >= max(rect.bottom for rect in rects)


def test_a_page_that_is_a_card_needs_no_panel(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(register, "PAGES", (*PAGES, fake("forces")))
    monkeypatch.setattr(tabs, "tip", lambda command: command)
    person.window.open_level(LEVELS[0])

    person.window.commands.open_page("forces page")
    person.wait()

    sheet = person.side._sheet.container.rect
    assert (pygame.surfarray.array3d(person.window.surface.subsurface(sheet)) != PANEL).any()


@pytest.mark.parametrize(
    ("make", "part"),
    [
        (lambda: Page("momentum", "", "the momenta", "y", card), "a caption"),
        (lambda: Page("momentum", "Momentum", "", "y", card), "a text"),
        (lambda: Page("momentum", "Momentum", "the momenta"), "a card or a panel"),
        (
            lambda: Page("momentum", "Momentum", "x", panel=_panel, superimposed_runs=lambda _: ()),
            "a card",
        ),
    ],
)
def test_a_part_that_is_forgotten_is_named_and_where_it_belongs(
    make: Callable[[], Page], part: str
) -> None:
    with pytest.raises(ValueError, match=f"'momentum' lacks {part}") as caught:
        make()

    assert "sandbox/app/pages/momentum/__init__.py" in str(caught.value)


def _panel(_sheet: Sheet, _desk: Desk) -> Panel:
    raise AssertionError


def _none(_session: Session) -> list[LegendRow]:
    return []


def test_a_worker_that_no_page_declares_is_named() -> None:
    class Nobody:
        news: object = None
        running = False

        def follow(self, _session: Session, _seconds: float, *, watched: bool) -> str | None:
            return str(watched)

        def cancel(self) -> None: ...

    with pytest.raises(LookupError, match="no page declares Nobody"):
        Workers(PAGES).of(Nobody)


def test_every_page_is_reached_by_the_key_of_the_next_one(person: Person) -> None:
    person.window.open_level(LEVELS[0])
    first, seen = person.window.panels.page, []
    for _ in PAGES:
        person.press(pygame.K_PAGEDOWN, mod=pygame.KMOD_LCTRL)
        seen.append(person.window.panels.page)
    assert seen == [*[page.command for page in PAGES[1:]], first]

    person.press(pygame.K_PAGEUP, mod=pygame.KMOD_LCTRL)
    assert person.window.panels.page == PAGES[-1].command


def test_a_page_needs_no_key_of_its_own() -> None:
    page = fake("sound", key="")

    assert page.bindings == ()
    assert page.command == "sound page"
