"""`tour`: every level run, checked and drawn, on one page."""

from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from sandbox import progress_bar
from sandbox.cli import argument_parsing, check_report
from sandbox.cli.render import go_headless
from sandbox.cli.tour_visit import Visit, visit
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import folder_of_files, write_atomically
from sandbox.model.errors import SandboxError

_STYLE = """
body { font: 16px/1.45 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem;
       color: #1b1f24; background: #fff }
article { margin: 3rem 0 } h2 { margin-bottom: 0 } .name, .about { color: #57606a; margin: 0 }
img { width: 100%; height: auto; border: 1px solid #d0d7de; margin-top: .6rem }
pre { overflow-x: auto; font-size: 13px; padding: .6rem; background: #f6f8fa }
.failed { color: #b42318 } .passed { color: #1a7f37 }
"""


def page(visits: Iterable[Visit]) -> str:
    """Return the page, which needs no files but the pictures beside it."""
    articles = "\n".join(_article(visit) for visit in visits)
    return (
        '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>Tour of the levels</title>\n<style>{_STYLE}</style>\n"
        f"<h1>Tour of the levels</h1>\n{articles}\n</html>\n"
    )


def _article(visit: Visit) -> str:
    title, summary = (visit.level.title, visit.level.summary) if visit.level else (visit.name, "")
    verdict = "passed" if visit.passed else "failed"
    parts = [
        f"<h2>{escape(title)}</h2>",
        f'<p class="name"><code>{escape(visit.name)}</code> <b class="{verdict}">{verdict}</b></p>',
        f'<p class="about">{escape(summary)}</p>',
    ]
    if visit.picture:
        parts.append(f'<img src="{escape(visit.picture)}" alt="{escape(title)}" loading="lazy">')
    found = list(check_report.lines(visit.results, complete=True))
    if visit.closing:
        found.append(f"energy: {visit.closing.text}")
    body = visit.error or "\n".join(found)
    parts.append(f"<pre>{escape(body)}</pre>")
    return f'<article id="{escape(visit.name)}">\n' + "\n".join(parts) + "\n</article>"


INDEX = "index.html"


def tour(folder: Path) -> int:
    """Run every level, write pictures and a page into a folder, and return the exit status."""
    with folder_of_files(folder):
        visits = _visits(folder)
        # before printing, which fails if the reader of the output is gone
        unwritten = _write(folder / INDEX, visits)
    Console(highlight=False).print(_table(visits))
    for visited in visits:
        _explain(visited)
    bad = sum(not visited.passed for visited in visits)
    where = "" if unwritten else f"; see {folder / INDEX}"
    typer.echo(f"{argument_parsing.levels(len(visits))}, {bad or 'none'} failed{where}")
    if unwritten:
        typer.echo(unwritten, err=True)
    return int(bad > 0 or unwritten is not None)


def _visits(folder: Path) -> list[Visit]:
    go_headless()
    names = level_catalog.names()
    return progress_bar.consume((visit(name, folder) for name in names), "Tour", len(names))


def _write(path: Path, visits: Sequence[Visit]) -> SandboxError | None:
    """Write the page, or return the error, so that the results are printed in any case."""
    try:
        write_atomically(path, page(visits))
    except SandboxError as error:
        return error
    return None


def _table(visits: list[Visit]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0))
    table.add_column("level", no_wrap=True)
    for title in ("checks", "error / bound", "energy", "seconds"):
        table.add_column(title, justify="right", no_wrap=True)
    table.add_column("verdict")
    for visited in visits:
        worst = check_report.worst(visited.results)
        table.add_row(
            visited.name,
            str(len(visited.results)),
            "-" if worst is None else f"{worst:.2g}",
            _energy(visited),
            f"{visited.seconds:.2f}",
            Text("passed", "green") if visited.passed else Text("failed", "bold red"),
        )
    return table


def _energy(visited: Visit) -> Text:
    """Return the unexplained share of the energy, coloured if it is too large."""
    if visited.closing is None:
        return Text("-")
    return Text(
        f"{visited.closing.unexplained_fraction:.1g}", "" if visited.closing.closes else "yellow"
    )


def _explain(visited: Visit) -> None:
    """Print why a level failed, and whether its energy balance is off."""
    if visited.closing and not visited.closing.closes:
        typer.echo(f"{visited.name}: energy: {visited.closing.text}")
    if visited.error:
        typer.echo(f"{visited.name}: {visited.error}", err=True)
    if visited.failures:
        typer.echo(f"{visited.name}:", err=True)
        for line in check_report.lines(visited.failures, complete=True):
            typer.echo(f"  {line}", err=True)
