"""Commands that are killed at any moment: `python -m tests.endurance.kills`.

Each does its work in a process of its own, over what the last one has left, and is killed after a
time that nobody chose. Every file must then be whole, of before or of now; no process may go on
that the command has started; and what was begun to be written must be gone once the command has
been let to its end. The processes are forked from one that has imported everything, so that they
are killed at their work, and not while they start.
"""

import csv
import itertools
import json
import os
import signal
import tempfile
from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from math import inf
from pathlib import Path
from random import Random
from time import monotonic, sleep
from unittest.mock import patch

import typer

from sandbox import interrupts
from sandbox.app import level_picture  # noqa: F401 (imported before anything is forked)
from sandbox.app.files.challenge_stars import ChallengeStars
from sandbox.cli import commands as sandbox_commands
from sandbox.cli import experiment, format, generate, migrate, new, render, simulate, tour  # noqa: A004, F401 (as above)
from sandbox.experiments import batch_scheduling, experiment_folder  # noqa: F401 (as above)
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.loading import load
from sandbox.model.translatable_message import Message
from sandbox.physics.accuracy.calibration_cache import calibrated
from tests.elsewhere import move_home
from tests.endurance.sessions import lingering
from validation import cases, cli
from validation.report import command, measurements  # noqa: F401 (as above)

LEVEL = "newton/atwood"
FEW = (LEVEL, "newton/incline", "kinematics/free-fall")
LENGTHS = ("0.5", "1")  # s, of runs that take turns
EVERY = 50


def _sandbox(*arguments: str) -> None:
    sandbox_commands.app(arguments, standalone_mode=False)


def _validation(*arguments: str) -> None:
    cli.app(arguments, standalone_mode=False)


def _write(turn: int) -> None:
    write_atomically(Path("plain.json"), json.dumps([turn] * 200_000))


def _simulate(turn: int) -> None:
    _sandbox("simulate", LEVEL, "--duration", LENGTHS[turn], "--output", "run.csv")


def _render(turn: int) -> None:
    _sandbox("render", LEVEL, "--at", LENGTHS[turn], "--output", "picture.png")


def _tour(_turn: int) -> None:
    with patch.object(level_catalog, "names", lambda: FEW):
        _sandbox("tour", "--output", "tour")


def _generate(turn: int) -> None:
    _sandbox("generate", "pile", "--bodies", str(50 + turn), "--output", "pile.json")


def _new(_turn: int) -> None:
    Path("mine.json").unlink(missing_ok=True)
    _sandbox("new", "mine")


def _format(turn: int) -> None:
    said = json.loads(level_catalog.find(LEVEL).read_text(encoding="utf-8"))
    write_atomically(Path("level.json"), json.dumps(said, indent=1 + turn))
    _sandbox("format", "level.json")
    _sandbox("migrate", "level.json")


def _experiment(turn: int) -> None:
    varied = ("--vary", "m1=1:2:40", "--measure", "left.position.y@end", "--duration", "0.2")
    _sandbox("experiment", LEVEL, *varied, "--jobs", "2", "--output", f"experiment{turn}")


def _stars(turn: int) -> None:
    progress = ChallengeStars()
    for number in range(200):
        progress.earn(f"challenge {number} {turn}", 1 + number % 3)


def _cache(turn: int) -> None:
    level = load(level_catalog.find(LEVEL))
    calibrated(level, level.defaults, 1e-3 * (1 + turn) * Random().uniform(1, 2))


def _run(_turn: int) -> None:
    few = list(islice(cases.all_cases(), 40))
    with patch("validation.cli.all_cases", lambda: few):
        Path("made").mkdir(exist_ok=True)
        _validation("run", "--jobs", "2", "--json", "made/run.json")


def _report(_turn: int) -> None:
    with patch.object(measurements, "collect", _read_only):
        _validation("report", "--from", "made", "--figures", "--output", "report")


def _read_only(part: measurements.Part, source: Path, *, quick: bool) -> measurements.Content:
    """Return the existing parts of the report: measuring the others takes long."""
    if (source / f"{part.command}.json").exists():
        return COLLECT(part, source, quick=quick)
    raise SandboxError(Message("not measured"))


COLLECT = measurements.collect

DEEDS: Mapping[Callable[[int], None], float] = {
    _write: 20, _simulate: 15, _render: 10, _tour: 5, _generate: 10, _new: 5, _format: 10,
    _experiment: 0.5, _stars: 10, _cache: 5, _run: 2, _report: 5,
}  # fmt: skip
"""What is killed, and how often beside the others: what starts processes takes long."""


def _table(data: bytes) -> bool:
    rows = list(csv.reader(data.decode().splitlines()))
    numbers = [row for row in rows if row and not row[0].startswith("#")]
    even = len({len(row) for row in numbers}) == 1
    return data.endswith(b"\n") and even and float(numbers[-1][0]) in map(float, LENGTHS)


def _json(data: bytes) -> bool:
    with suppress(ValueError):
        json.loads(data)
        return True
    return False


WHOLE: Mapping[str, Callable[[bytes], bool]] = {
    ".csv": _table,
    ".json": _json,
    ".png": lambda data: data.startswith(b"\x89PNG") and data.endswith(b"IEND\xaeB`\x82"),
    ".svg": lambda data: data.rstrip().endswith(b"</svg>"),
    ".html": lambda data: data.rstrip().endswith(b"</html>"),
    ".parquet": lambda data: data.startswith(b"PAR1") and data.endswith(b"PAR1"),
}
"""What tells that a file is whole, by its ending."""


@dataclass(frozen=True, slots=True)
class Workplace:
    """A folder in which commands work, with a home of its own."""

    folder: Path

    def begin(self, deed: Callable[[int], None], turn: int) -> int:
        """Start a separate process, and return its ID."""
        if pid := os.fork():
            return pid
        status = 1
        try:
            self._enter()
            deed(turn)
            status = 0
        except SystemExit as ended:
            status = int(ended.code or 0)
        except BaseException as error:  # noqa: BLE001 (nothing may return from here)
            os.write(self._errors, f"{deed.__name__}: {error!r}\n".encode())
        os._exit(status)

    @property
    def _errors(self) -> int:
        return os.open(self.folder / "errors", os.O_WRONLY | os.O_CREAT | os.O_APPEND)

    def _enter(self) -> None:
        os.setsid()
        os.chdir(self.folder)
        move_home(self.folder / "home")
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nowhere, stream)
        interrupts.install()

    def broken(self) -> list[Path]:
        """Return the files that are not whole."""
        found = (path for path in self.folder.rglob("[!.]*.*") if path.is_file())
        return [path for path in found if not WHOLE[path.suffix](path.read_bytes())]

    def parts(self) -> list[Path]:
        """Return the unfinished files."""
        return list(self.folder.rglob(".*.part"))


def main(count: int = 1000, seed: int = 0) -> None:
    """Kill a number of commands, and report what was left."""
    random, found = Random(seed), Counter[str]()
    with tempfile.TemporaryDirectory() as name:
        place, takes = Workplace(Path(name)), dict[Callable[[int], None], float]()
        for deed in DEEDS:
            for turn in (0, 1):
                begun = monotonic()
                _, status = os.waitpid(place.begin(deed, turn), 0)
                found[f"failed by itself: {deed.__name__}"] += status != 0
                takes[deed] = min(monotonic() - begun, takes.get(deed, inf))
            typer.echo(f"{deed.__name__[1:]} takes {takes[deed]:.2f} s")
        for number in itertools.count(1):
            (deed,) = random.choices(list(DEEDS), list(DEEDS.values()))
            _kill(place, deed, number % 2, random.uniform(0, takes[deed]), found)
            if number % EVERY == 0:
                typer.echo(f"{number:,}: {_told(found)}")
            if found["killed"] == count:
                break
        for deed in DEEDS:
            os.waitpid(place.begin(deed, 0), 0)
        found["part files at the end"] += len(place.parts())
        errors = place.folder / "errors"
        typer.echo(errors.read_text() if errors.exists() else "", err=True)
        typer.echo(f"{number:,} commands: {_told(found)}")
    bad = found.total() - found["killed"] - found["done before"]
    raise typer.Exit(bad > 0)


def _kill(
    place: Workplace,
    deed: Callable[[int], None],
    turn: int,
    delay: float,
    found: Counter[str],
) -> None:
    """Start a command, kill it after some time [s], and count what is left."""
    pid = place.begin(deed, turn)
    sleep(delay)
    os.kill(pid, signal.SIGKILL)
    _, status = os.waitpid(pid, 0)
    found["killed" if os.WIFSIGNALED(status) else "done before"] += 1
    left = lingering(pid)
    found["orphans"] += len(left)
    for orphan in left:
        os.kill(orphan, signal.SIGKILL)
    broken = place.broken()
    found["files lost"] += len(broken)
    for path in broken:
        typer.echo(f"not whole: {path.name}", err=True)
        path.unlink()


def _told(found: Counter[str]) -> str:
    return ", ".join(f"{times:,} {what}" for what, times in found.items() if times)


if __name__ == "__main__":
    typer.run(main)
