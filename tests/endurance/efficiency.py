"""How much of the cores an experiment uses: `python -m tests.endurance.efficiency`.

Each is run by one process, by two, and some by a local Dask cluster of two workers, one right after
the other. Printed is the time of one over twice the time of two. It takes two minutes, and says
something on an idle machine of two cores only.
"""

import re
import subprocess
import sys
import tempfile
from typing import NamedTuple

import typer

from tests.experiments.machines import Machines

WORKERS = 2


class Case(NamedTuple):
    """An experiment, as it is typed, and whether a cluster runs it, too."""

    name: str
    command: tuple[str, ...]
    clustered: bool = False


CASES = (
    Case(
        "projectile, 6,001 throws",
        ("kinematics/projectile", "--vary", "angle=5:85:6001", "--measure", "t@landing"),
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


def clustered(case: Case) -> float:
    """Run an experiment on a cluster that has loaded what it needs; return how long it took [s]."""
    machines = Machines()
    try:
        where = ["--cluster", machines.address]
        seconds(Case("few", (*case.command[:2], "angle=5:85:50", *case.command[3:])), where)
        return seconds(case, where)
    finally:
        machines.end()


def main() -> None:
    """Run all, and print their efficiencies."""
    for case in CASES:
        alone = seconds(case, ["--jobs", "1"])
        told = {f"{WORKERS} processes": seconds(case, ["--jobs", str(WORKERS)])}
        if case.clustered:
            told["Dask"] = clustered(case)
        for where, took in told.items():
            share = alone / (WORKERS * took)
            typer.echo(f"{case.name}: {alone:.1f} s alone, {took:.1f} s on {where}: {share:.2f}")


if __name__ == "__main__":
    typer.run(main)
