"""A command beside a fault: what it is given, what comes of it, and what is wrong with that."""

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from sandbox.interrupts import STATUS
from sandbox.standard_streams import UNHEARD
from tests.endurance.command_lines import LONG, SAMPLES, write_samples
from tests.endurance.fault_kinds import INPUTS, ISOLATED, OUTPUTS, SURROUNDINGS, usable
from tests.endurance.sessions import lingering

LINGERS = 20.0  # s, within which a command that is asked to end must end
REFUSED = (1, 2)
OTHERWISE: Mapping[str, Sequence[int]] = {
    "reader gone": (UNHEARD,),
    "full output": (1,),
    "full disk": (1,),
    "few open files": (1,),
    "no working folder": REFUSED,
}
"""The status of a command that cannot do all of its work beside a fault."""

UNHEARD_OF = ("reader gone", "full output")
PLAIN = "exec PYTHON -m COMMAND"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a command."""

    status: int
    out: str
    err: str
    asked: bool = False
    """whether it was still at work, and was asked to end"""
    hangs: bool = False
    left: Sequence[int] = ()
    """its processes that did not end with it"""


@dataclass(frozen=True, slots=True)
class Trial:
    """A command beside a fault."""

    command: str
    line: str
    kind: str
    fault: str
    concerns: str = ""
    """the file with the fault"""

    @property
    def name(self) -> str:
        """Its name in the table."""
        return " ".join((self.command, self.line, f"[{self.kind}: {self.fault} {self.concerns}]"))


@dataclass(slots=True)
class Place:
    """A folder of a command, with the files that it reads, and one for those that it writes."""

    folder: Path
    given: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        write_samples(self.folder)
        self.out.mkdir()

    @property
    def out(self) -> Path:
        """The folder of what is written."""
        return self.folder / "out"

    def spoil(self, trial: Trial) -> None:
        """Put the fault of a trial where the command will meet it."""
        if trial.kind == "input":
            path = self.folder / SAMPLES[trial.concerns][1]
            path.rename(path.with_name(f"aside-{path.name}"))
            INPUTS[trial.fault](path)
        if trial.kind == "output":
            (self.folder / "its").mkdir()
            OUTPUTS[trial.fault](self.folder / "its" / trial.concerns.rstrip("/"))

    def arguments(self, trial: Trial) -> str:
        """Return the arguments of a trial's command."""
        found = []
        for word in trial.line.split():
            if word.startswith("@"):
                found.append(str(self.folder / SAMPLES[word[1:]][0]))
            elif word.startswith("%"):
                own = trial.kind == "output" and word[1:] == trial.concerns
                found.append(f"{'../its' if own else '.'}/{word[1:].rstrip('/')}")
            else:
                found.append(word)
        return shlex.join(found)

    def files(self) -> list[str]:
        """Return what has been written."""
        return sorted(path.name for path in self.out.rglob("*") if path.name != "h")

    def parts(self) -> list[str]:
        """Return what has been written half."""
        return [path.name for path in self.folder.rglob("*.part")]


@dataclass(frozen=True, slots=True)
class Result:
    """What came of a trial."""

    outcome: Outcome
    made: Sequence[str]
    """the files that it has written"""
    parts: Sequence[str]
    """those that it has written half"""


def _people() -> list[str]:
    """Return the beginning of a command by which even root may not read everything."""
    if os.geteuid() == 0 and shutil.which("setpriv"):
        return ["setpriv", "--bounding-set", "-dac_override,-dac_read_search"]
    return []


def _environment(root: Path, home: Path) -> dict[str, str]:
    kept = {name: value for name, value in os.environ.items() if not name.startswith("XDG_")}
    silent = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    places = {"PYTHONPATH": root, "HOME": home, "TMPDIR": home.parent}
    return {**kept, **silent, **{name: str(place) for name, place in places.items()}}


def run(
    line: str, root: Path, folder: Path, limit: float, signal_after: tuple[int, float] | None = None
) -> Outcome:
    """Run a line of a shell, end it if it takes too long, and return what came of it."""
    process = subprocess.Popen(
        [*_people(), "bash", "-c", line], cwd=folder, start_new_session=True, text=True,
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        encoding="utf-8", errors="replace",
        env=_environment(root, folder.parent / "home"),
    )  # fmt: skip
    asked = hangs = False
    if signal_after:
        number, delay = signal_after
        time.sleep(delay)
        with suppress(ProcessLookupError):
            (os.kill if number == signal.SIGTERM else os.killpg)(process.pid, number)
    try:
        out, err = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        asked = True
        os.killpg(process.pid, signal.SIGTERM)
        try:
            out, err = process.communicate(timeout=LINGERS)
        except subprocess.TimeoutExpired:
            hangs = True
            os.killpg(process.pid, signal.SIGKILL)
            out, err = process.communicate()
    left = lingering(process.pid)
    for each in left:
        with suppress(ProcessLookupError):
            os.kill(each, signal.SIGKILL)
    return Outcome(process.returncode, out, err, asked, hangs, left)


def shell_line(template: str, root: Path, command: str, arguments: str) -> str:
    """Return a line of a shell in which Python runs a command."""
    module = command.split()[0]
    isolated = shlex.quote(
        ISOLATED.replace("MODULE", repr(module)).replace("ROOT", repr(str(root)))
    )
    given = " ".join((*command.split()[1:], arguments))
    return (
        re.sub(r"\bPYTHON\b", shlex.quote(sys.executable), template)
        .replace("COMMAND", f"{command} {arguments}")
        .replace("ISOLATED", f"{isolated} {given}")
    )


def attempt(
    trial: Trial, root: Path, limit: float, signal_after: tuple[int, float] | None = None
) -> Result:
    """Run a command of the programs in a folder, for some time [s] at the most."""
    with tempfile.TemporaryDirectory(prefix="faults-") as name:
        place = Place(Path(name))
        place.spoil(trial)
        before = place.files()
        template = SURROUNDINGS.get(trial.fault, PLAIN)
        line = shell_line(template, root, trial.command, place.arguments(trial))
        done = run(line, root, place.out, limit, signal_after)
        made = [file for file in place.files() if file not in before]
        parts = place.parts()
        for path in (place.folder, *place.folder.rglob("*")):
            if path.is_dir() and not path.is_symlink():
                path.chmod(0o700)  # so that it can be removed
    return Result(done, made, parts)


def judged(trial: Trial, result: Result, plain: Outcome | None) -> Iterator[str]:
    """Yield what is wrong; `plain` is what comes of the command without a fault, if known."""
    done = result.outcome
    yield from _left(result, interruptible=trial.fault == "SIGINT" and "." in trial.command)
    if done.asked:
        if trial.command not in LONG or refused(trial):
            yield "takes too long"
        elif not _ended_by(done.status, signal.SIGTERM):
            yield f"status {done.status} after SIGTERM"
    elif trial.kind == "signal":
        if not _ended_by(done.status, signal.Signals[trial.fault]) and _differs(done, plain):
            yield f"status {done.status}"
    elif refused(trial):
        yield from _wrong_refusal(trial, result)
    elif plain:
        yield from _wrong_work(trial, done, plain)


def _left(result: Result, *, interruptible: bool) -> Iterator[str]:
    """Yield what is wrong with any command.

    Ctrl-C is answered by Python itself until a module that is run has been imported; the two
    programs import theirs when they can answer it.
    """
    done = result.outcome
    if done.hangs:
        yield "does not end"
    if done.left:
        yield f"leaves {len(done.left)} processes"
    if result.parts:
        yield f"leaves {result.parts}"
    traceback = any(word in done.err + done.out for word in ("Traceback", "Exception ignored"))
    if traceback and not (interruptible and done.err.endswith("KeyboardInterrupt\n")):
        yield "a traceback"


def refused(trial: Trial) -> bool:
    """Whether a command has to refuse a file."""
    if trial.kind == "input":
        return trial.fault != "link to it"
    return trial.kind == "output" and not usable(trial.fault, trial.concerns)


def _ended_by(status: int, number: int) -> bool:
    """Whether a shell says that a signal has ended a process, which may have been done already."""
    return status in (STATUS + number, -number)


def _differs(done: Outcome, plain: Outcome | None) -> bool:
    return plain is not None and done.status != plain.status


def _wrong_refusal(trial: Trial, result: Result) -> Iterator[str]:
    if result.outcome.status not in REFUSED:
        yield f"status {result.outcome.status}"
    if not result.outcome.err.strip():
        yield "says nothing"
    if result.made and trial.concerns != "measurement":  # the report is made without it
        yield f"leaves {result.made}"


def _wrong_work(trial: Trial, done: Outcome, plain: Outcome) -> Iterator[str]:
    other = OTHERWISE.get(trial.fault, ())
    if trial.fault in UNHEARD_OF and plain.out and done.status not in other:
        yield f"status {done.status}, though nobody has heard of it"
    if done.status != plain.status and done.status not in other:
        yield f"status {done.status}"
    if done.status in REFUSED and done.status != plain.status and not done.err.strip():
        yield "says nothing"
    if done.status == plain.status and not plain.err and done.err and not plain.status:
        yield "says more"
