"""`simulate`: a run as a CSV file."""

from collections.abc import Iterable, Sequence
from math import ceil
from pathlib import Path

import typer
from rich.console import Console

from sandbox.app.words import formatting as telling
from sandbox.cli import argument_parsing, check_report, effect_options
from sandbox.cli.accuracy_option import Choice, asking, settled
from sandbox.cli.effect_options import Varied, vary
from sandbox.model.atomic_file_writing import check_writable, write_atomically
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import choose
from sandbox.model.quantities import quantities, quantity
from sandbox.physics import run as runs
from sandbox.physics.accuracy.compared_runs import at_least_lasting
from sandbox.physics.advising.remedy_trials import (
    SECONDS_OF_A_COMMAND,
    creep_warning,
    leaning_warning,
    with_advice,
)
from sandbox.physics.measuring.csv_export import to_csv
from sandbox.physics.measuring.grading import grade
from sandbox.physics.measuring.recording import Trace, needed
from sandbox.physics.measuring.run_comparison import Difference, differences
from sandbox.physics.run import costs
from sandbox.physics.state.simulation_errors import SimulationError


def simulate(
    argument: str,
    output: Path,
    pairs: Sequence[str],
    duration: float | None,
    choice: Choice,
    record: Sequence[str],
    off: Sequence[str] = (),
    on: Sequence[str] = (),
    accuracy: float | None = None,
) -> int:
    """Run a level, write it, print the results of its checks, and return the exit status.

    With effects switched off or on, that run is written, and compared with the unchanged level.
    """
    settings = argument_parsing.settings(pairs)
    check_writable(output)
    if duration is not None:
        argument_parsing.positive(duration, "--duration")
    source, level = argument_parsing.open_level(argument)
    values = choose(level, settings)
    names = chosen(level, record)
    requested = at_least_lasting(asking(level, accuracy, choice), values, duration)
    stepping = settled(requested, values, choice, names if record else ())
    varied = vary(level, off, on, stepping)
    if duration is not None:
        argument_parsing.payable(duration, stepping, "--duration")
    with Console(stderr=True).status(f"Simulating {source} ..."):
        recorded = dict.fromkeys([*names, *needed(level)])
        trace = _run(level, values, duration, recorded, stepping)
        if varied:
            changed = _run(varied.level, values, duration, recorded, stepping)
            cost = costs((level, varied.level), values, stepping)
    if varied:
        write_atomically(output, to_csv(changed, source, names, change=varied.change))
        _say(output, f"{source} {varied.change.description}", changed, names)
        _compare(varied, differences(trace, changed), cost[1] - cost[0])
        _close(changed)
        return 0
    write_atomically(output, to_csv(trace, source, names))
    _say(output, source, trace, names)
    status = report(trace)
    _close(trace)
    return status


def _run(
    level: Level,
    values: Values,
    duration: float | None,
    recorded: Iterable[str],
    stepping: Stepping,
) -> Trace:
    """Run a level; if it has to stop, print the remedies."""
    try:
        return runs.simulate(level, values, duration, recorded, stepping, books=True)
    except SimulationError as error:
        advised = with_advice(error, level, values, stepping, duration, SECONDS_OF_A_COMMAND)
        raise advised from error


def _say(output: Path, source: str, trace: Trace, names: Sequence[str]) -> None:
    steps = f"{len(trace.t) - 1} steps at {trace.stepping.rate:g} Hz to t = {trace.t[-1]:.6g} s"
    typer.echo(f"{output}: {source}, {steps}, {len(names) + 1} columns")


def _close(trace: Trace) -> None:
    """Print the run's energy balance, whether a pile may lean, and whether an impact was missed."""
    if trace.may_lean:
        typer.echo(f"contacts: {leaning_warning(trace.level, trace.values, trace.stepping)}")
    elif creeps := creep_warning(trace, SECONDS_OF_A_COMMAND):
        typer.echo(f"contacts: {creeps}")
    if trace.missed_passages:
        rate, subject = trace.missed_passages[0]
        typer.echo(
            f"contacts: {subject} moved further than its own width in a step, and may have passed"
            f" through others; impacts that are located, or {ceil(rate):,} Hz, miss none"
        )
    if trace.closing:
        typer.echo(f"energy: {trace.closing.text}")


def _compare(varied: Varied, found: Sequence[Difference], cost: float) -> None:
    """Print the changes that effects make to the quantities of the checks, and their cost."""
    if found:
        for line in effect_options.differences(found):
            typer.echo(line)
    lines = [*telling.summary(found, str), telling.step_cost(cost)]
    typer.echo(f"{varied.change.description}: {'; '.join(lines)}")


def chosen(level: Level, record: Sequence[str]) -> list[str]:
    """Return the quantities to write; raise `QuantityError` if the level has no such quantity."""
    if record:
        each = [quantity(name, level).name for name in record if name != "all"]
        names = [found.name for found in quantities(level)] if "all" in record else each
    else:
        names = [*needed(level), *_motion(level)]
    return [name for name in dict.fromkeys(names) if name != "t"]


def _motion(level: Level) -> list[str]:
    """Return the names of the dynamic bodies' positions and velocities."""
    dynamic = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    vectors = [f"{name}.{vector}" for name in dynamic for vector in ("position", "velocity")]
    return [f"{vector}.{component}" for vector in vectors for component in ("x", "y")]


def report(trace: Trace) -> int:
    """Print the results of a run's checks, and return the exit status.

    Checks apply to the level's own duration: anything later is not graded, and a shorter run is
    graded as far as it goes.
    """
    for line in check_report.challenge_lines(trace):
        typer.echo(line)
    if not trace.level.checks:
        typer.echo("the level states no checks")
        return 0
    duration = trace.level.duration(trace.values)
    complete = trace.complete
    results = grade(trace.until(duration))
    for line in check_report.lines(results, complete=complete):
        typer.echo(line)
    if not complete:
        typer.echo(
            f"the run is shorter than the level's {duration:.6g} s: graded as far as it goes"
        )
    return int(any(check_report.failed(result, complete=complete) for result in results))
