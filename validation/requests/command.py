"""`python -m validation requests`."""

import os
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import typer

from sandbox.processes import spread
from validation import output
from validation.environment import environment
from validation.requests.accuracy_request import Trial, trial


def measure(count: int, seed: int, json_file: Path | None, jobs: int | None) -> bool:
    """Request accuracies, print the missed ones, and return whether all promises hold.

    The seed is that of the first request. The outcomes go to the JSON file, if any. By default
    there are as many processes as cores. Raises `SandboxError` if the file cannot be written.
    """
    seeds = range(seed, seed + count)
    found = dict(
        output.progress(spread(trial, seeds, jobs or os.cpu_count() or 1), "Asking", count)
    )
    trials = [found[number] for number in range(count)]
    with output.written(content(trials), json_file):
        typer.echo(summary(trials))
        output.complain(complaints(trials))
    return all(each.kept and each.honest for each in trials if each.looked_at)


def content(trials: Sequence[Trial]) -> dict[str, object]:
    """Return all outcomes as the content of the JSON file."""
    requests = [{**output.finite(asdict(each)), "values": dict(each.values)} for each in trials]
    return {"environment": environment(), "requests": requests}


def summary(trials: Sequence[Trial]) -> str:
    """Return a line that says how many accuracies were delivered."""
    seen = [each for each in trials if each.looked_at]
    refused = sum(each.refused for each in trials)
    return (
        f"{len(trials)} accuracies requested: {refused} refused, {len(seen)} compared; "
        f"of these {sum(each.kept for each in seen)} delivered, "
        f"{sum(each.honest for each in seen)} with the stated error, "
        f"{sum(not each.cheaper for each in seen)} at up to three times the least cost"
    )


def complaints(trials: Sequence[Trial]) -> list[str]:
    """Return messages about broken promises."""
    found = []
    for each in trials:
        if each.looked_at and not (each.kept and each.honest and not each.cheaper):
            at = ", ".join(f"{name}={value:.6g}" for name, value in each.values.items())
            instead = f"; cheaper: {each.cheaper}" if each.cheaper else ""
            found.append(
                f"seed {each.seed}: {each.level} ({at}): {each.answer}; delivered "
                f"{each.delivered:.1e}{instead}"
            )
    return found
