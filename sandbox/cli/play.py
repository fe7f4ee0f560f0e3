"""`play`: the window, on one level or on all of them."""

import gc
import os
from collections.abc import Sequence
from pathlib import Path

import typer

from sandbox.cli import argument_parsing
from sandbox.cli.accuracy_option import asking, find_out
from sandbox.cli.render import go_headless
from sandbox.model.errors import SandboxError
from sandbox.model.loading import choose

TOUR = Path("out", "tour")
"""The folder of the tour that is made if there is no display."""


class DisplayError(SandboxError):
    """No display on which to open a window."""


def open_sandbox() -> int:
    """Open the window with the choice of levels, or make the tour if there is no display."""
    _quiet()
    from sandbox.app.main import has_display, run

    if has_display():
        run()
        return 0
    gc.enable()
    typer.echo(f"There is no display to open a window on. The tour goes to {TOUR} instead.")
    from sandbox.cli.tour import tour

    return tour(TOUR)


def play(
    argument: str,
    pairs: Sequence[str],
    accuracy: float | None = None,
    *,
    racing: bool = False,
    once: bool = False,
) -> None:
    """Open the window on a level; with `once` only until its first frame, whose time is printed."""
    settings = argument_parsing.settings(pairs)
    _, level = argument_parsing.open_level(argument)
    values = choose(level, settings)  # report a mistake before a window opens
    find_out(asking(level, accuracy), values)
    _quiet()
    from sandbox.app.main import first_picture, has_display, run

    displayed = has_display()
    if once:
        if not displayed:
            go_headless()
        typer.echo(first_picture(argument, settings, accuracy, racing=racing))
        return
    if not displayed:
        raise DisplayError(
            "there is no display to open a window on; 'render' draws a level without one,"
            " 'simulate' runs it"
        )
    run(argument, settings, accuracy, racing=racing)


def _quiet() -> None:
    """Set up no sound, since the sandbox makes none, and suppress pygame's greeting."""
    os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
    os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"
