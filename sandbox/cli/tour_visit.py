"""One level of a tour: run, checked and drawn."""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from sandbox.app.level_picture import save_picture
from sandbox.cli import check_report
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import load
from sandbox.physics.advising.remedy_trials import with_advice
from sandbox.physics.energy.balance_check import Closing
from sandbox.physics.measuring.grading import Result, grade
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.run import simulate
from sandbox.physics.state.simulation_errors import SimulationError


@dataclass(slots=True)
class Visit:
    """The results of one level."""

    name: str
    """The level that was visited."""
    level: Level | None = None
    """None if it could not be read."""
    results: tuple[Result, ...] = ()
    """The results of its checks."""
    seconds: float = 0.0
    """The time of the run, without drawing [s]."""
    picture: str | None = None
    """The file name of its picture; None if it could not be drawn."""
    closing: Closing | None = None
    """The balance of its energy; None if it did not run to its end."""
    error: str = ""
    """Why the level could not be read, run or drawn; empty if it could."""

    @property
    def failures(self) -> tuple[Result, ...]:
        """The checks that failed."""
        return tuple(r for r in self.results if check_report.failed(r, complete=True))

    @property
    def passed(self) -> bool:
        """Whether all is well."""
        return not (self.error or self.failures)


def visit(name: str, folder: Path) -> Visit:
    """Run and grade a level, and draw its picture into a folder."""
    found = Visit(name)
    try:
        _fill(found, folder)
    except SandboxError as error:
        found.error = str(error)
    return found


def _fill(found: Visit, folder: Path) -> None:
    found.level = level = load(level_catalog.find(found.name))
    start = perf_counter()
    trace = _run(level)
    found.results = grade(trace)
    found.seconds = perf_counter() - start
    found.closing = trace.closing
    picture = f"{found.name.replace('/', '-')}.png"
    save_picture(level, level.defaults, folder / picture)
    found.picture = picture


def _run(level: Level) -> Trace:
    """Run a level with its energy balance; if it has to stop, print the remedies."""
    try:
        return simulate(level, books=True)
    except SimulationError as error:
        raise with_advice(error, level, level.defaults, level.stepping) from error
