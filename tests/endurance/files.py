"""Files that nobody would write, for all readers: `python -m tests.endurance.files`.

Runs, experiments, tables of measured data, settings, stars, recent files, drafts and levels are
changed at random: values in them, or their bytes. Whoever reads one must take it or refuse it in a
sentence, within some seconds. (What levels do once they are read, `python -m validation fuzz`
tries.)
"""

import json
import tempfile
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from time import process_time

import typer

from sandbox.app.files import challenge_stars, preferences, recent_files
from sandbox.app.home.unfinished_work_strip import summary
from sandbox.app.runs import crash_recovery, run_file
from sandbox.app.runs.session import Session
from sandbox.editing import draft_recovery
from sandbox.editing.draft import Draft
from sandbox.experiments import catalog
from sandbox.experiments.measured_data import read as read_data
from sandbox.model import level_catalog
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.loading import load
from sandbox.physics.state.simulation_errors import BreakdownError
from tests.elsewhere import move_home
from validation.fuzz.mutated_levels import change

LEVEL = "newton/atwood"
STEPS = 30  # of runs that are repeated
PATIENCE = 4.0  # s of computing
NAME = f"{'0' * 32}"

ODD = (
    b"\0", b"\xff", b"\\u0000", "\u202e".encode(), b"NaN", b"9" * 5000, b"x" * 200_000,
    b"[" * 100_000, b'{"a":' * 9000,
)  # fmt: skip
"""What is inserted."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of files: examples, the place of the file, and what reads it."""

    examples: Sequence[str]
    place: Path
    read: Callable[[Path], object]


def _run(path: Path) -> None:
    run = run_file.read(path)
    run_file.replay(run.model_copy(update={"steps": min(run.steps, STEPS)}))


def _left(_: Path) -> None:
    for left in crash_recovery.left_runs(3):
        summary(left)


def _drafts(_: Path) -> None:
    for left in draft_recovery.recoverable():
        summary(left)
        left.draft()


def kinds(folder: Path) -> dict[str, Kind]:
    """Return all kinds of files, by name; those of the home are where the window looks for them."""
    level = load(level_catalog.find(LEVEL))
    session = Session(level)
    session.do_again((), 5)
    session.branch({"m1": 2.0})
    session.do_again(session.run.script, 10)
    run = [run_file.file_content(run_file.run_of(session))]
    text, data = level.text, ["# by hand\nt,left.position.y\n0,0\n0.1,0.01\n0.2,0.04\n"]
    shipped = [catalog.find(name).read_text(encoding="utf-8") for name in catalog.names()]
    draft = draft_recovery.RecoveryFile(
        path=None, saved="{}", text=text, when=1.7e9
    ).model_dump_json()
    chosen = preferences.Preferences(size=100, language="de").model_dump_json()
    return {
        "run": Kind(run, folder / f"x{run_file.SUFFIX}", _run),
        "left run": Kind(run, crash_recovery.folder() / f"{NAME}{run_file.SUFFIX}", _left),
        "draft": Kind([draft], draft_recovery.folder() / f"{NAME}.draft.json", _drafts),
        "experiment": Kind(shipped, folder / "e.json", catalog.open_plan),
        "data": Kind(data, folder / "d.csv", lambda path: read_data(path, level)),
        "settings": Kind([chosen], preferences.file(), lambda _: preferences.WindowPreferences()),
        "stars": Kind(
            ['{"One": 2, "Two": 3}'],
            challenge_stars.file(),
            lambda _: challenge_stars.ChallengeStars(),
        ),
        "recent": Kind(
            ['["/x/a.json", "/y/b.json"]'],
            recent_files.file(),
            lambda _: recent_files.RecentFiles(),
        ),
        "level": Kind([text], folder / "l.json", load),
        "drawing": Kind([text], folder / "l.json", Draft.open),
    }


def spoilt(random: Random, text: str) -> bytes:
    """Return a text with some values changed, or with some bytes."""
    if not text.startswith("#") and random.random() < 0.6:
        data = json.loads(text)
        change(random, data)
        return json.dumps(data).encode()
    data = text.encode()
    i, j = sorted(random.randrange(len(data) + 1) for _ in range(2))
    odd = random.choice(ODD)
    return random.choice((
        data[:i], data[:i] + data[j:], data[:j] + data[i:], data[:i] + odd + data[i:],
        b"\xef\xbb\xbf" + data, text.encode("utf-16"), data + data, b"",
    ))  # fmt: skip


def attempt(kind: Kind, content: bytes) -> str:
    """Return what came of a file: taken, refused, or what should not have come of it."""
    kind.place.parent.mkdir(parents=True, exist_ok=True)
    kind.place.write_bytes(content)
    began, outcome = process_time(), "taken"
    try:
        kind.read(kind.place)
    except SandboxError as error:
        unforeseen = isinstance(error, BreakdownError) or (
            isinstance(error, LevelError) and error.__cause__ is not None
        )
        outcome = f"not foreseen: {error.__cause__!r}" if unforeseen else "refused"
        if not all(c.isprintable() or c == "\n" for c in str(error)):
            outcome = "told in letters that nobody sees"
    except Exception as error:  # noqa: BLE001 (that is what is looked for)
        outcome = f"{type(error).__name__}: {error}"[:200]
    finally:
        kind.place.unlink()
    return outcome if process_time() - began < PATIENCE else "slow"


def main(count: int = 10_000, seed: int = 0) -> None:
    """Try a number of files, and report what came of them."""
    seen, failed = Counter[str](), 0
    with tempfile.TemporaryDirectory() as folder:
        move_home(Path(folder) / "home")
        found = kinds(Path(folder))
        for number in range(count):
            random = Random(f"{seed}-{number}")
            name = random.choice(list(found))
            outcome = attempt(found[name], spoilt(random, random.choice(found[name].examples)))
            seen[f"{name} {outcome}"] += 1
            if outcome not in ("taken", "refused"):
                failed += 1
                typer.echo(f"{number}, {name}: {outcome}", err=True)
    told = ", ".join(f"{times:,} {what}" for what, times in sorted(seen.items()))
    typer.echo(f"{count:,} files: {told}")
    raise typer.Exit(failed > 0)


if __name__ == "__main__":
    typer.run(main)
