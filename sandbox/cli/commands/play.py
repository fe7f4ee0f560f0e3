"""The command `play`."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

from sandbox.cli.commands.options import (
    AccuracyOption,
    FirstPictureOption,
    LevelArgument,
    RaceOption,
    SetOption,
)


@contextmanager
def uncollected() -> Iterator[None]:
    """Look for no garbage up to the first picture, before which nothing is lost.

    Then `Window.look_through` looks for it, and from there on it is looked for as ever.
    """
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def command(
    level: LevelArgument,
    set_: SetOption = None,
    accuracy: AccuracyOption = None,
    race: RaceOption = False,
    first_picture: FirstPictureOption = False,
) -> None:
    """Open a level in the window."""
    searching = accuracy is not None  # then many worlds are made and lost before the window opens
    with nullcontext() if searching else uncollected():
        from sandbox.cli.play import play

        play(level, set_ or [], accuracy, racing=race, once=first_picture)
