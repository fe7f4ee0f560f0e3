"""`render`: a level as a picture."""

import os
from collections.abc import Sequence
from math import isfinite
from pathlib import Path

import typer

from sandbox.cli import argument_parsing
from sandbox.cli.accuracy_option import asking, find_out
from sandbox.cli.effect_options import vary
from sandbox.model.atomic_file_writing import check_writable
from sandbox.model.loading import choose


def go_headless() -> None:
    """Let pygame draw without a display, sound or greeting."""
    os.environ["SDL_VIDEODRIVER"] = "dummy"
    os.environ["SDL_AUDIODRIVER"] = "dummy"
    os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"


def render(
    argument: str,
    output: Path,
    pairs: Sequence[str],
    at: float | None,
    off: Sequence[str] = (),
    on: Sequence[str] = (),
    accuracy: float | None = None,
    *,
    racing: bool = False,
) -> None:
    """Draw a level at a time; with effects switched off or on, over the unchanged level."""
    if racing and (off or on):
        raise argument_parsing.UsageError(
            "--race: the race is of the level as it is, without --with and such"
        )
    settings = argument_parsing.settings(pairs)
    if output.suffix.lower() != ".png":
        raise argument_parsing.UsageError(
            f"--output {output}: the picture is a PNG; its name must end so"
        )
    check_writable(output)
    if at is not None and not (isfinite(at) and at >= 0):
        raise argument_parsing.UsageError(f"--at {at:g}: must be a finite time, at least 0")
    source, level = argument_parsing.open_level(argument)
    values = choose(level, settings)
    level = asking(level, accuracy)
    stepping = find_out(level, values)
    if at is not None:
        argument_parsing.payable(at, stepping, "--at")
    varied = vary(level, off, on)
    go_headless()
    from sandbox.app.level_picture import ComparisonRun, save_picture

    if varied:
        beside = ComparisonRun(level, varied.variations)
        save_picture(varied.level, values, output, at=at, beside=beside)
    else:
        save_picture(level, values, output, at=at, racing=racing)
    typer.echo(f"{output}: {source}" + (f" {varied.change.description}" if varied else ""))
