"""`list`: the levels that exist."""

from typing import Any, NamedTuple

import typer
from pydantic import BaseModel
from rich.console import Console
from rich.table import Table
from rich.text import Text

from sandbox.model import level_catalog


class _Head(BaseModel):
    """The parts of a level that the list shows; `check` validates the rest."""

    title: str
    summary: str = ""
    effects: dict[str, Any] = {}


class Entry(NamedTuple):
    """A level in the list."""

    name: str
    title: str
    effects: str
    summary: str


def show_levels() -> None:
    """List all levels: as a table on a terminal, with tabs between the columns elsewhere."""
    console = Console(highlight=False)
    entries = [_entry(name) for name in level_catalog.names()]
    if console.is_terminal:
        console.print(_table(entries))
    else:
        for entry in entries:
            typer.echo("\t".join(" ".join(text.split()) for text in entry))


def _entry(name: str) -> Entry:
    try:
        head = _Head.model_validate_json((level_catalog.root() / f"{name}.json").read_bytes())
    except (OSError, ValueError):
        return Entry(name, "(cannot be read)", "", f"'check {name}' says why.")
    effects = (effect for effect, declared in head.effects.items() if declared is not None)
    return Entry(name, head.title, ", ".join(effects), head.summary)


def _table(entries: list[Entry]) -> Table:
    table = Table(box=None, padding=(0, 2, 1, 0), show_header=False)
    table.add_column(style="cyan", no_wrap=True)
    table.add_column(overflow="fold")
    for entry in entries:
        styled = ((entry.title, "bold"), (entry.summary, ""), (entry.effects, "dim"))
        about = Text("\n").join(Text(text, style) for text, style in styled if text)
        table.add_row(entry.name, about)
    return table
