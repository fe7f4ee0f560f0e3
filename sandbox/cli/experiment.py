"""`experiment`: many runs of a level, measured, stored and drawn."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

from sandbox import parallel_processes
from sandbox.cli import argument_parsing
from sandbox.cli.accuracy_option import Choice, settled
from sandbox.cli.argument_parsing import UsageError
from sandbox.model.atomic_file_writing import folder_of_files
from sandbox.model.errors import MisuseError, SandboxError, brief
from sandbox.model.level_parts import Fault
from sandbox.model.loading import choose
from sandbox.model.translatable_message import Message
from sandbox.optional_packages import needed_for

if TYPE_CHECKING:
    from sandbox.experiments.executors import Executor
    from sandbox.experiments.experiment_folder import Store
    from sandbox.experiments.plan import Plan


class ExperimentRequest(NamedTuple):
    """The experiment as typed."""

    argument: str
    vary: Sequence[str]
    measure: Sequence[str]
    set: Sequence[str]
    others: Mapping[str, Any]
    """draws, method, seed, duration, until, rate and scheme, if given"""


def experiment(
    request: ExperimentRequest, output: Path, jobs: int | None, address: str | None
) -> None:
    """Run an experiment, store it in a folder, and write its report."""
    if jobs is not None and not 1 <= jobs <= 1024:
        raise UsageError(f"--jobs {jobs}: must be from 1 to 1024")
    if jobs is not None and address is not None:
        raise UsageError("--jobs and --cluster: the cluster's workers say how many there are")
    if address is None and (jobs or os.cpu_count() or 1) > 1:
        parallel_processes.prepare("sandbox.experiments.row_runs")
    with needed_for("an experiment", "experiment"):
        from sandbox.experiments import report
        from sandbox.experiments.experiment_folder import Store
    plan = _plan(request)
    store = Store(output, plan)
    missing = sum(stop - start for start, stop in store.missing()) if not store.complete else 0
    if missing < plan.runs:
        typer.echo(f"{output}: {plan.runs - missing:,} of {plan.runs:,} runs are done already")
    began = perf_counter()
    _run(plan, store, missing, jobs, address)
    seconds = perf_counter() - began
    page = report.write(plan, store.results, output)  # before printing, which may fail
    typer.echo(f"{store.results}: {plan.runs:,} runs" + (f" in {seconds:.3g} s" if missing else ""))
    for line in page.remarks:
        typer.echo(line)
    typer.echo(f"{page.path}: the page of it")


def _run(plan: "Plan", store: "Store", missing: int, jobs: int | None, address: str | None) -> None:
    """Run the missing rows of a plan; however that ends, print what is kept."""
    from sandbox.experiments.batch_scheduling import conduct

    done = 0
    try:
        with _executor(jobs, address, missing) as executor, _progress(missing) as bar:

            def tell(rows: int) -> None:
                nonlocal done
                done = rows
                bar(rows)

            conduct(plan, store, executor, tell)
    except SystemExit:  # Ctrl-C, or a request to end
        typer.echo(f"ended: {_kept(plan, missing - done)}", err=True)
        raise
    except SandboxError as error:
        message = Message("{error}; {kept}", error=error.message, kept=_kept(plan, missing - done))
        kind = type(error)
        raise kind(message) if kind in (SandboxError, MisuseError) else error from error


def _kept(plan: "Plan", missing: int) -> str:
    status = f"{plan.runs - missing:,} of {plan.runs:,} runs are kept"
    return f"{status}, and the same command goes on from there"


def fit(request: ExperimentRequest, names: Sequence[str], data: Path | None, output: Path) -> None:
    """Fit parameters of a level to measured data, and write the result."""
    if request.vary or request.measure or set(request.others) - {"rate", "scheme"}:
        raise UsageError("--fit: nothing is varied, drawn or measured beside it")
    if not names or data is None:
        raise UsageError(
            "--fit NAME and --data FILE.csv: both are needed, what to find and from what"
        )
    with needed_for("a fit", "experiment"):
        from sandbox.experiments import fit_report
        from sandbox.experiments import measured_data as measured
        from sandbox.experiments.parameter_estimation import fit
    source, level = argument_parsing.open_level(request.argument)
    values = choose(level, argument_parsing.settings(request.set))
    choice = Choice(request.others.get("rate"), request.others.get("scheme"))
    stepping = settled(level, values, choice)
    found_data = measured.read(data, level)
    with folder_of_files(output):
        with Console(stderr=True).status(f"Fitting {source} ..."):
            found = fit(level, values, names, found_data, stepping)
        page = fit_report.write(level, source, found_data, found, output)
    for parameter in found.parameters:
        bound = ": the end of the level's range" if parameter.bound else ""
        typer.echo(f"{parameter.name} = {fit_report.with_uncertainty(parameter)}{bound}")
    typer.echo(f"{page}: the page of it")


def _plan(request: ExperimentRequest) -> "Plan":
    from sandbox.experiments import catalog
    from sandbox.experiments.experiment_file import parsed
    from sandbox.experiments.plan_validation import make

    if not (request.vary or request.measure):
        if request.set or request.others:
            raise UsageError(
                "an experiment's file says all of it: --vary and --measure make one of a level"
            )
        return catalog.open_plan(catalog.find(request.argument))
    source, level = argument_parsing.open_level(request.argument)
    options = {
        "level": source,
        "vary": _pairs(request.vary),
        "measure": list(request.measure),
        "set": argument_parsing.settings(request.set),
        **request.others,
    }
    found, faults = parsed(options)
    if found:
        plan, faults = make(found, source, level)
        if not faults:
            return plan
    raise UsageError("\n".join(_message(fault, options) for fault in faults))


def _pairs(texts: Sequence[str]) -> dict[str, str]:
    found: dict[str, str] = {}
    for text in texts:
        name, equals, values = (part.strip() for part in text.partition("="))
        if not equals or not name:
            raise UsageError(f"--vary {brief(text)}: must be NAME=VALUES, such as angle=5:85:81")
        if name in found:
            raise UsageError(f"--vary {brief(text)}: '{brief(name)}' is varied twice")
        found[name] = values
    return found


def _message(fault: Fault, options: Mapping[str, object]) -> str:
    """Return the message of a fault, with the option that has it."""
    name, *inside = fault.path or ("vary",)
    where = f"--{name}"
    part = options.get(str(name))
    if inside and isinstance(part, dict) and inside[0] in part:
        where += f" {inside[0]}={brief(str(part[str(inside[0])]))}"
    elif inside and isinstance(part, list) and isinstance(inside[0], int):
        where += f" {brief(str(part[inside[0]]))}"
    return f"{where}: {fault.rule}"


@contextmanager
def _executor(jobs: int | None, address: str | None, runs: int) -> Iterator["Executor"]:
    from sandbox.experiments.executors import cluster, local

    if address is None or not runs:
        yield local(min(jobs or os.cpu_count() or 1, max(runs, 1)))
    else:
        with cluster(address) as found:
            yield found


@contextmanager
def _progress(runs: int) -> "Iterator[Callable[[int], None]]":
    columns = (BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=runs)
        yield lambda rows: bar.update(task, completed=rows)
