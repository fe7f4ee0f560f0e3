"""`python -m validation compose`."""

import os
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

import typer

from sandbox.model.files import check_writable, folder_of_files, write_atomically
from sandbox.model.writing import text
from sandbox.processes import spread
from validation import output
from validation.compose.outcome import Outcome, judged, playable
from validation.compose.report import by_family, complaints
from validation.environment import environment


def measure(
    chosen: Sequence[int], json_file: Path | None, folder: Path | None, jobs: int | None
) -> bool:
    """Judge scenes, print the failures by family, and return whether all judgements hold.

    The outcomes go to the JSON file, and the levels of failed scenes to the folder, if any. By
    default there are as many processes as cores. Raises `SandboxError` if a file cannot be written.
    """
    if json_file:
        check_writable(json_file)
    with folder_of_files(folder) if folder else nullcontext():
        found = outcomes(chosen, jobs)
        with output.written(content(found), json_file):
            _show(found)
        if folder:
            _save([o for o in found if o.failed], folder)
    return not any(o.failed for o in found)


def _show(found: Sequence[Outcome]) -> None:
    output.show(by_family(found))
    output.complain(complaints(found))
    refused = sum(o.refused for o in found)
    typer.echo(f"{sum(o.passed for o in found)} of {len(found)} scenes hold, {refused} refused.")


def outcomes(chosen: Sequence[int], jobs: int | None = None) -> list[Outcome]:
    """Judge scenes, with progress on a terminal, and return the outcomes in the same order."""
    jobs = jobs or os.cpu_count() or 1
    found = output.progress(spread(judged, chosen, jobs), "Judging scenes", len(chosen))
    return [outcome for _, outcome in sorted(found, key=lambda pair: pair[0])]


def content(found: Sequence[Outcome]) -> dict[str, object]:
    """Return outcomes as the content of the JSON file."""
    return {"environment": environment(), "scenes": [outcome.content() for outcome in found]}


def _save(failed: Sequence[Outcome], folder: Path) -> None:
    """Write the levels of failed scenes, so that they can be played."""
    for outcome in failed:
        write_atomically(folder / f"{outcome.name}.json", text(playable(outcome)))
    typer.echo(f"{len(failed)} levels written to {folder}.")
