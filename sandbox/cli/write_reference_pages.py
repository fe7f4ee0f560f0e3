"""Generates the reference pages of the documentation from the code's declarations.

`python -m sandbox.cli.write_reference_pages` writes them to `docs/reference`.
"""

import json
import sys
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from pathlib import Path
from typing import Any

import typer

from sandbox import program
from sandbox.cli.commands import app
from sandbox.model import joints, level_catalog, quantities
from sandbox.model.atomic_file_writing import generate, write_atomically
from sandbox.model.effects import EFFECTS
from sandbox.model.loading import parse
from sandbox.model.write_json_schema import schema

FOLDER = Path("docs") / "reference"
"""The folder of the pages, within a checkout."""

Schema = Mapping[str, Any]

LEVEL_FORMAT = """\
# Level format

Every key of a level's file, in SI units. [Write a level](../how-to/write-a-level.md) explains them.
A *formula* is a text such as `"m*g*sin(angle*deg)"`. A member of a list, or of a part whose members
have names, may [repeat](../how-to/write-a-level.md#writing-less). This page is written by
`make docs`."""

QUANTITIES = """\
# Quantities

Checks, `--record`, graphs and Python use these names. A vector has the components `.x` and `.y`;
without one, its name stands for its magnitude. `ball` and `box` stand for any body, `ball.tip` for
a point that the body declares, `gate` for a sensor, `joint` for any joint. This page is written by
`make docs`."""

OVER_TIME = """\
## Since the start

A suffix gives a statistic of a quantity since the start of the run, such as `string.tension.max`.
`t` has none."""

ACCOUNTS = """\
## Accounts

The ledger accounts for where energy comes from and where it goes. The changes that no account
explains are `system.unexplained_energy`, `system.unexplained_momentum` (a vector) and
`system.unexplained_angular_momentum`."""

COMMANDS = """\
# Commands

`python -m sandbox COMMAND --help` says the same. Exit status: 0 if all is well, 1 if a check, a
level, or reading or writing a file failed, 2 for wrong usage.
[Validation](../explanation/validation.md) has the commands of
`python -m validation`. This page is written by `make docs`."""

SAMPLE = """{
  "format": 1, "title": "Sample", "duration": 1, "effects": {"contact": {}},
  "bodies": {
    "ball": {"shape": {"type": "disc", "radius": 1}, "mass": 1, "points": {"tip": [1, 0]}},
    "box": {"shape": {"type": "box", "width": 1, "height": 1}, "mass": 1, "position": [5, 0]},
    "gate": {"type": "static", "sensor": true, "shape": {"type": "disc", "radius": 1}}
  }
}"""
"""A level that has every quantity of bodies."""

OF_SENSORS = (quantities.WITHIN, quantities.COUNT)
"""The quantities that only sensors have, which share all others with bodies."""

SHORTHAND = ("Each", "Repeat")
"""Definitions that may stand anywhere in a level, and are described only once."""


def level_format() -> str:
    """Return the page about every key of a level, from the JSON Schema for editors."""
    whole = schema()
    parts = ((name, part) for name, part in whole["$defs"].items() if name not in SHORTHAND)
    sections = (["", f"## {name}", "", _meaning(part), "", *_keys(part)] for name, part in parts)
    return _page(LEVEL_FORMAT, "", "## Level", "", *_keys(whole), *chain.from_iterable(sections))


def _page(*lines: str) -> str:
    return "\n".join(lines) + "\n"


def _table(headings: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    headings = tuple(headings)
    for cells in (headings, ("---",) * len(headings), *rows):
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


def _keys(part: Schema) -> Iterator[str]:
    """Yield the table of an object's keys."""
    required = part.get("required", ())
    keys = {key: value for key, value in part.get("properties", {}).items() if key != "repeat"}
    yield from _table(
        ("key", "type", "if left out", "meaning"),
        (
            (
                f"`{key}`",
                _type(value),
                "**needed**" if key in required else _literal(value.get("default")),
                _meaning(value),
            )
            for key, value in keys.items()
        ),
    )


def _meaning(part: Schema) -> str:
    return " ".join(part.get("description", "").split())


def _type(value: Schema) -> str:
    """Return the type of a value, in words."""
    if name := value.get("$ref", "").rpartition("/")[2]:
        return "" if name in SHORTHAND else f"[{name}](#{name.lower()})"
    if "const" in value:
        return f"`{value['const']}`"
    if "enum" in value:
        return " or ".join(f"`{choice}`" for choice in value["enum"])
    if choices := value.get("oneOf", value.get("anyOf")):
        return " or ".join(filter(None, dict.fromkeys(map(_type, choices))))
    return _of_json(value)


def _of_json(value: Schema) -> str:
    """Return the project's name for a JSON type."""
    kind = value.get("type", "")
    if isinstance(kind, list):
        return "number or formula"
    if kind == "array" and "prefixItems" in value:
        return f"[{', '.join(map(_type, value['prefixItems']))}]"
    if kind == "array":
        return f"list of {_type(value.get('items', {}))}"
    if kind == "object":
        members = value.get("patternProperties", {}).values()
        return "".join(f"names, each with {_type(member)}" for member in members) or "object"
    names = {"string": "text", "boolean": "`true` or `false`", "integer": "whole number"}
    return str(names.get(kind, kind))


def _literal(default: object) -> str:
    return "" if default in (None, "") else f"`{json.dumps(_plain(default))}`"


def _plain(value: object) -> object:
    """Return a JSON value, with whole numbers as integers."""
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_plain(one) for one in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def all_quantities() -> str:
    """Return the page about all quantities."""
    of_joints = (
        (name, ", ".join(f"`joint.{what}` [{unit}]" for what, unit in kind.quantities.items()))
        for name, kind in joints.KINDS.items()
    )
    over_time = (
        (f"`.{form}`", f"that of the quantity{' · ' + factor if factor else ''}")
        for form, factor in quantities.OVER_TIME.items()
    )
    accounts = (
        (n, _account(e.book, e.account_name)) for n, e in EFFECTS.items() if e.book != "none"
    )
    return _page(
        *(QUANTITIES, "", "## Bodies, the system, the time", ""),
        *_table(("quantity", "", "unit"), _of_bodies()),
        *("", "## Joints", ""),
        *_table(("joint", "quantities"), of_joints),
        *("", OVER_TIME, ""),
        *_table(("suffix", "unit"), over_time),
        *("", ACCOUNTS, ""),
        *_table(("effect", "account"), accounts),
    )


def _of_bodies() -> Iterator[tuple[str, str, str]]:
    """Yield the quantities of bodies, of pairs of bodies, and of the system."""
    level = parse(SAMPLE, "the sample")
    every = [*quantities.quantities(level), *quantities.mutual(level)]
    vectors = {one.name.removesuffix(".x") for one in every if one.component == "x"}
    for one in every:
        is_new = ("gate" in (one.subject, one.other)) is (one.attribute in OF_SENSORS)
        if one.subject != "box" and is_new and one.component is None and not one.needs_ledger:
            yield f"`{one.name}`", "vector" if one.name in vectors else "", one.unit


def _account(book: str, name: str) -> str:
    return f"`system.{'potential_energy' if book == 'potential' else book}.{name}`"


def commands() -> str:
    """Return the page about every command, from the declarations of its help."""
    found = getattr(typer.main.get_command(app), "commands", {})
    return _page(COMMANDS, *chain.from_iterable(_command(*item) for item in found.items()))


def _command(name: str, command: Any) -> Iterator[str]:  # noqa: ANN401 (typer names no type for it)
    """Yield the description of a command, and of its arguments."""
    yield from ("", f"## {name}", "", *(command.help or "").strip().splitlines())
    if rows := [_argument(parameter) for parameter in command.params if parameter.name != "help"]:
        yield from ("", *_table(("argument", "meaning"), rows))


def _argument(parameter: Any) -> tuple[str, str]:  # noqa: ANN401 (the same)
    """Return an argument, or an option with its value, and its meaning."""
    if parameter.param_type_name == "argument":
        written = parameter.metavar or parameter.name.upper()
    else:
        taken = parameter.metavar if parameter.metavar and not parameter.is_flag else ""
        written = f"{', '.join(parameter.opts)} {taken}".strip()
    return f"`{written}`", " ".join((parameter.help or "").split())


PAGES = {"level-format.md": level_format, "quantities.md": all_quantities, "commands.md": commands}
"""The function that generates each page, by file name."""


def main() -> int:
    """Write the pages, print their paths, and return the exit status."""
    return generate(_write)


def _write() -> Iterator[Path]:
    folder = level_catalog.sources() / FOLDER
    for name, page in PAGES.items():
        write_atomically(folder / name, page())
        yield folder / name


if __name__ == "__main__":
    with program.started():
        sys.exit(main())
