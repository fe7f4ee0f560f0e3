"""`python -m validation compose`."""

import os
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from pathlib import Path

import typer
from rich.table import Table

from sandbox.model.file_writing import check_writable, folder_of_files, write_atomically
from sandbox.model.level_writing import text
from sandbox.processes import spread
from validation import output
from validation.compose.outcome import Outcome, judged, playable
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


TOLD = 20
"""The most failed scenes that are named."""


def by_family(found: Sequence[Outcome]) -> Table:
    """Return a table with a row per family: how many scenes pass, and which judgements fail."""
    table = output.table("Random compositions", "family", ("scenes", "hold", "refused"))
    table.add_column("failed judgements, of all")
    table.add_column("")
    families: dict[str, list[Outcome]] = defaultdict(list)
    for outcome in found:
        families[outcome.family].append(outcome)
    for family, members in sorted(families.items()):
        failing = ", ".join(_counted(members))
        mark = "[red]✗[/]" if failing else "[green]✓[/]"
        counts = (len(members), sum(o.passed for o in members), sum(o.refused for o in members))
        table.add_row(family, *map(str, counts), failing, mark)
    return table


def _counted(members: Sequence[Outcome]) -> Iterator[str]:
    """Yield each judgement that fails, with how often, and out of how many."""
    made = Counter(judgement.name for outcome in members for judgement in outcome.judgements)
    missed = Counter(judgement.name for outcome in members for judgement in outcome.failed)
    for name in made:
        if missed[name]:
            yield f"{name} {missed[name]}/{made[name]}"


def complaints(found: Sequence[Outcome]) -> Iterator[str]:
    """Yield the failed scenes with their judgements, at most `TOLD` of them."""
    failed = [outcome for outcome in found if outcome.failed]
    for outcome in failed[:TOLD]:
        missed = ", ".join(f"{j.name} {j.figure:.1e} of {j.bound:.1e}" for j in outcome.failed)
        yield f"{outcome.name}: {missed}"
    if len(failed) > TOLD:
        yield f"and {len(failed) - TOLD} more"
