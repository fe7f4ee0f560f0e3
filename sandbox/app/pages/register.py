"""The list of pages of the side panel, from which tabs, keys, help and commands are derived."""

from collections.abc import Sequence
from importlib import import_module
from pkgutil import walk_packages

import sandbox.app.pages
from sandbox.app.pages import (
    accuracy,
    build,
    challenge,
    effects,
    experiment,
    forces,
    graph,
    level,
    momentum,
    predict,
    scheme_race,
    settings,
    share,
    table,
)
from sandbox.app.pages.page import Page
from sandbox.app.runs.session import Session
from sandbox.app.stage.run_legend import LegendRow
from sandbox.model.level import Level

PAGES: tuple[Page, ...] = (
    level.PAGE,
    build.PAGE,
    challenge.PAGE,
    predict.PAGE,
    graph.PAGE,
    table.PAGE,
    forces.PAGE,
    experiment.PAGE,
    momentum.PAGE,
    effects.PAGE,
    scheme_race.PAGE,
    accuracy.PAGE,
    share.PAGE,
    settings.PAGE,
)
"""All pages in the order of their tabs; the first is open at first."""


def page(command: str) -> Page:
    """Return the page that a command opens."""
    return next(page for page in PAGES if page.command == command)


def preload() -> None:
    """Import what all pages consist of, so that opening one does not take that time."""
    for module in walk_packages(sandbox.app.pages.__path__, f"{sandbox.app.pages.__name__}."):
        import_module(module.name)


def opening(level: Level, shown: str) -> str:
    """Return the command of the page with which a level opens, given the page shown before.

    A page made for such levels takes precedence; it closes with the next level that it does not
    suit. Other pages stay.
    """
    made = next(
        (page for page in PAGES if page.suits_level is not None and page.suits_level(level)), None
    )
    if made is not None:
        return made.command
    return PAGES[0].command if page(shown).suits_level is not None else shown


def runs_beside(session: Session) -> tuple[Page | None, Sequence[LegendRow]]:
    """Return the page that superimposes other runs, and their rows; None if there is none."""
    found = ((page, rows) for page in PAGES if (rows := page.runs(session)))
    return next(found, (None, ()))
