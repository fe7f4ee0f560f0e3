"""`replay`: a saved run, repeated."""

import os
from pathlib import Path

import typer

from sandbox.app.runs import run_file
from sandbox.cli import argument_parsing
from sandbox.physics.measuring.grading import grade


def replay(path: Path) -> int:
    """Repeat a run, print whether it is identical bit by bit, and return the exit status."""
    if not os.path.lexists(path):
        raise argument_parsing.UsageError(f"{path}: there is no such file")
    run = run_file.read(path)
    session = run_file.replay(run)
    same = run_file.is_same(run, session)
    verdict = "the same to the last bit" if same else "its final state differs from the saved one"
    did = f", {len(run.actions)} actions of the user" if run.actions else ""
    typer.echo(f"{session.level.title}: {run.steps} steps to t = {session.t:.6g} s{did}: {verdict}")
    if not session.world.disturbed:
        passed = [result.verdict for result in grade(session.trace)]
        typer.echo(f"checks passed: {passed.count('passed')} of {len(passed)}")
    return int(not same)
