"""Every command beside every fault: `python -m tests.endurance.faults`.

Each must do its work, or say in a sentence why it cannot, with a status that fits, in time, and
without a traceback, a process or a part of a file that it leaves behind. What it reads is missing,
unreadable, a pipe, a device or no text; what it writes leads nowhere; streams are closed, full or
without a reader; there is no home, no space or no working folder; signals come at moments that
nobody chose. Commands come from the registers of both programs, and from the Makefile.
"""

import shutil
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random

import typer

from sandbox.interrupts import SIGNALS
from tests.elsewhere import ROOT
from tests.endurance.command_lines import LINES, LONG, modules, unnamed
from tests.endurance.fault_kinds import INPUTS, OUTPUTS, SURROUNDINGS
from tests.endurance.fault_trials import Outcome, Trial, attempt, judged

AT_WORK = 12.0  # s, after which a command that takes minutes is asked to end
LIMIT = 60.0  # s, within which any other has to end, though the machine does much else
SLOWER = 6  # and how many times longer than without a fault it may take

MEASURED_ANEW = ("missing", "folder", "folder without access")
"""Faults of what `report --from` reads, for which it measures for minutes."""

Plan = tuple[Trial, tuple[int, float] | None]


def trials(command: str, line: str) -> Iterator[Trial]:
    """Yield a command beside every fault."""
    for word in line.split():
        kind = {"@": "input", "%": "output"}.get(word[0], "")
        for fault in INPUTS if kind == "input" else OUTPUTS if kind == "output" else ():
            if _is_one(fault, word):
                yield Trial(command, line, kind, fault, word[1:])
    for fault in SURROUNDINGS:
        yield Trial(command, line, "surroundings", fault)


def _is_one(fault: str, word: str) -> bool:
    """Whether something is a fault of what stands for a file in a line."""
    if word.startswith("@measurement"):
        return fault not in MEASURED_ANEW
    return not (word.endswith("/") and fault == "folder")


class Table:
    """The trials of all commands, and how many have gone wrong."""

    def __init__(self, jobs: int, signals: int, seed: int) -> None:
        self.tried, self.wrong = Counter[str](), 0
        self._pool, self._signals, self._random = ThreadPoolExecutor(jobs), signals, Random(seed)

    def add(self, command: str, line: str, root: Path, kind: str) -> None:
        """Try a command of the programs in a folder beside all faults of a kind."""
        plain, takes = None, AT_WORK
        if command not in LONG:
            begun = time.monotonic()
            plain = attempt(Trial(command, line, "plain", ""), root, 10 * LIMIT).outcome
            takes = time.monotonic() - begun
            if plain.asked or "Traceback" in plain.err:
                self._complain(Trial(command, line, "plain", ""), plain, ["fails"])
        limit = AT_WORK if command in LONG else max(LIMIT, SLOWER * takes)
        plans: list[Plan] = [(trial, None) for trial in trials(command, line)]
        for number in SIGNALS * self._signals:
            delay = self._random.uniform(0.1, takes)
            plans.append((Trial(command, line, "signal", number.name), (number, delay)))
        plans = [(trial, signal) for trial, signal in plans if kind in trial.kind]
        begun_trials = [
            (trial, self._pool.submit(attempt, trial, root, limit, signal))
            for trial, signal in plans
        ]
        for trial, future in begun_trials:
            self.tried[trial.kind] += 1
            if found := list(judged(trial, result := future.result(), plain)):
                self._complain(trial, result.outcome, found)
        typer.echo(f"{command} {line}: {len(plans)}, {self.wrong} wrong so far")

    def _complain(self, trial: Trial, outcome: Outcome, found: Sequence[str]) -> None:
        self.wrong += 1
        told = f"status {outcome.status}: {outcome.out[-200:]!r} {outcome.err[-400:]!r}"
        typer.echo(f"{trial.name}: {'; '.join(found)}\n    {told}", err=True)


def main(only: str = "", kind: str = "", jobs: int = 2, signals: int = 1, seed: int = 0) -> None:
    """Try every command beside every fault, and report what is wrong."""
    if missing := list(unnamed()):
        raise SystemExit(f"not in command_lines.py: {', '.join(missing)}")
    table = Table(jobs, signals, seed)
    with tempfile.TemporaryDirectory() as name:
        copy = Path(name) / "project"  # since modules write into the project
        for part in ("sandbox", "validation", "levels", "experiments", "docs"):
            shutil.copytree(ROOT / part, copy / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "pyproject.toml", copy)
        todo = [(command, line, ROOT) for command, lines in LINES.items() for line in lines]
        todo += [(module, "", copy) for module in modules()]
        for command, line, root in todo:
            if only in command:
                table.add(command, line, root, kind)
    each = ", ".join(f"{count:,} of {kind}" for kind, count in table.tried.items())
    typer.echo(f"{table.tried.total():,} trials ({each}), {table.wrong} wrong")
    raise typer.Exit(table.wrong > 0)


if __name__ == "__main__":
    typer.run(main)
