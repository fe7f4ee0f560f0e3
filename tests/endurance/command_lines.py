"""A short line for every command of both programs, with the files that it reads and writes.

`@level` stands for a file that the command reads, `%out.csv` for one that it writes, `%made/` for a
folder of its own. Whether a line is missing, or a file in one, is found out from the register.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import typer.main

from sandbox.app.runs import run_file
from sandbox.app.runs.session import Session
from sandbox.cli import commands as playing
from sandbox.model.loading import load
from tests.cli.helpers import fall
from tests.elsewhere import ROOT
from validation import cli as validating
from validation.output import environment

LINES = {
    "sandbox play": ["@level --first-picture"],
    "sandbox list": [""],
    "sandbox new": ["%mine.json --from @level"],
    "sandbox check": ["@level"],
    "sandbox format": ["@level", "@level --check"],
    "sandbox migrate": ["@level"],
    "sandbox simulate": ["@level --output %out.csv"],
    "sandbox describe": ["@level --forces"],
    "sandbox effects": ["@level"],
    "sandbox experiment": [
        "@level --vary g=8,9,10 --measure t@end --jobs 2 --output %made/",
        "@experiment --jobs 1 --output %made/",
        "@level --fit g --data @measured --output %made/",
    ],
    "sandbox render": ["@level --at 0.1 --output %picture.png"],
    "sandbox replay": ["@run"],
    "sandbox generate": ["pile --bodies 20 --output %pile.json"],
    "sandbox tour": ["--output %made/"],
    "sandbox bench": ["@level --seconds 0.1 --json %bench.json"],
    "validation run": ["@level", "kinematics/free-fall --jobs 2 --json %run.json"],
    "validation compose": ["--count 2 --jobs 2 --json %scenes.json --output %made/"],
    "validation cost": ["@level --quick --json %cost.json --output %made/"],
    "validation requests": ["--count 1 --jobs 1 --json %requests.json"],
    "validation pace": ["@level --json %pace.json"],
    "validation effects": ["--quick --json %effects.json"],
    "validation report": [
        "--from @measurements --figures --output %made/",
        "--from @measurement --output %made/",
    ],
    "validation stability": ["--quick --json %stability.json"],
    "validation fuzz": ["--count 1 --seed 1 --json %fuzz.json --samples %made/"],
}

LONG = {"sandbox tour", "validation requests", "validation effects", "validation stability"}
"""Commands that work for minutes at least: they are asked to end after a while."""

_PLACES = re.compile(r"LEVEL|FILE|DIR|TEMPLATE")
"""What the help calls files, and folders, that are read or written."""


def unnamed() -> Iterator[str]:
    """Yield every command, and each of its files, that no line names."""
    for program, register in (("sandbox", playing.app), ("validation", validating.app)):
        for name, command in typer.main.get_command(register).commands.items():  # type: ignore[attr-defined]
            lines = " ".join(LINES.get(f"{program} {name}", ()))
            if f"{program} {name}" not in LINES:
                yield f"{program} {name}"
            for parameter in command.params:
                if not _PLACES.search(str(parameter.metavar or "")):
                    continue
                given = "@" if parameter.param_type_name == "argument" else parameter.opts[-1]
                if given not in lines:
                    yield f"{program} {name}: {parameter.metavar}"


def modules() -> list[str]:
    """Return the modules of the programs that the Makefile runs to write something anew."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    return sorted(set(re.findall(r"-m ((?:sandbox|validation)\.[\w.]+)", makefile)))


SAMPLES = {
    "level": ("level.json", "level.json"),
    "experiment": ("experiment.json", "experiment.json"),
    "measured": ("measured.csv", "measured.csv"),
    "run": ("short.run.json", "short.run.json"),
    "measurements": ("measurements", "measurements"),
    "measurement": ("measurements", "measurements/run.json"),
}
"""What is given to a command, and which of it a fault concerns."""


def write_samples(folder: Path) -> None:
    """Write a file of each kind that commands read."""
    (folder / "level.json").write_text(json.dumps(fall()), encoding="utf-8")
    varied = {"level": "level.json", "vary": {"g": "8, 9"}, "measure": ["t@end"]}
    (folder / "experiment.json").write_text(json.dumps(varied), encoding="utf-8")
    rows = [f"{t / 10},{10 - 4.9 * (t / 10) ** 2}" for t in range(10)]
    (folder / "measured.csv").write_text("\n".join(["t,ball.position.y", *rows, ""]))
    session = Session(load(folder / "level.json"))
    session.do_again((), 30)
    run_file.save(run_file.run_of(session), folder / "short.run.json")
    (folder / "measurements").mkdir()
    empty: dict[str, dict[str, object]] = {
        "run": {"cases": []},
        "cost": {"levels": [], "requests": []},
        "stability": {"cases": []},
        "effects": {"levels": [], "costs": [], "growth": []},
    }
    for name, content in empty.items():
        whole = json.dumps({"environment": environment(), **content})
        (folder / "measurements" / f"{name}.json").write_text(whole, encoding="utf-8")
