"""How much of the cores an experiment uses: `python -m tests.endurance.efficiency`.

Each is run by one process, by two, and some by a local Dask cluster of two workers, in turns.
Printed is the time of one over twice the time of two: the median of some rounds, and the least and
the most of them. It takes half an hour, and says something on an idle machine of two cores only.
"""

import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from statistics import median
from typing import NamedTuple

import typer

from tests.experiments.machines import Machines

WORKERS, ROUNDS = 2, 3


class Case(NamedTuple):
    """An experiment, as it is typed, and whether a cluster runs it, too."""

    name: str
    command: tuple[str, ...]
    clustered: bool = False


CASES = (
    Case(
        "projectile, 60,001 throws",
        ("kinematics/projectile", "--vary", "angle=5:85:60001", "--measure", "t@landing"),
        clustered=True,
    ),
    Case(
        "trebuchet, 31 shots of 1 s",
        ("machines/trebuchet", "--vary", "M=200:500:31", "--measure", "stone.position.x@end",
         "--duration", "1"),
    ),
    Case(
        "double pendulum, 1,600 runs of 1 s",
        ("lagrange/double-pendulum", "--vary", "angle=100:150:1600", "--duration", "1",
         "--measure", "lower.position.x@end"),
    ),
)  # fmt: skip


def seconds(case: Case, where: list[str]) -> float:
    """Run an experiment in a folder of its own, and return how long its runs took [s]."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["-m", "sandbox", "experiment", *case.command, *where, "--output", folder]
        done = subprocess.run(
            [sys.executable, *command], capture_output=True, text=True, check=True
        )
    found = re.search(r"runs in ([\d.e+]+) s", done.stdout)
    assert found, done.stdout
    return float(found[1])


def on_cluster(case: Case) -> float:
    """Run an experiment on a cluster that has loaded what it needs; return how long it took [s]."""
    machines = Machines()
    try:
        where = ["--cluster", machines.address]
        seconds(Case("few", (*case.command[:2], "angle=5:85:50", *case.command[3:])), where)
        return seconds(case, where)
    finally:
        machines.end()


def in_turns(case: Case) -> dict[str, list[float]]:
    """Run an experiment everywhere, some times; return by place which shares of it were used."""
    shares: dict[str, list[float]] = {}
    for _ in range(ROUNDS):
        alone = seconds(case, ["--jobs", "1"])
        took = {f"{WORKERS} processes": seconds(case, ["--jobs", str(WORKERS)])}
        if case.clustered:
            took["Dask"] = on_cluster(case)
        for where, time in took.items():
            shares.setdefault(where, []).append(alone / (WORKERS * time))
    return shares


def told(shares: Sequence[float]) -> str:
    """Write the median of some shares, and their range."""
    return f"{median(shares):.2f} ({min(shares):.2f} to {max(shares):.2f})"


def main() -> None:
    """Run all, and print their efficiencies."""
    for case in CASES:
        for where, shares in in_turns(case).items():
            typer.echo(f"{case.name} on {where}: {told(shares)}")


if __name__ == "__main__":
    typer.run(main)
