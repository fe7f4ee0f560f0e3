"""The reference agrees with the code: every key, quantity and command, and no old ones."""

import json
from collections.abc import Callable

import pytest

from sandbox.cli import write_reference_pages
from sandbox.cli.commands import COMMANDS
from sandbox.cli.write_reference_pages import FOLDER, PAGES
from sandbox.model import joints, level_catalog
from sandbox.model.effects import EFFECTS
from sandbox.model.errors import MisuseError
from sandbox.model.translatable_message import Message
from sandbox.model.write_json_schema import schema


@pytest.mark.parametrize(("name", "page"), PAGES.items(), ids=PAGES)
def test_the_pages_in_the_docs_are_up_to_date(name: str, page: Callable[[], str]) -> None:
    written = (level_catalog.sources() / FOLDER / name).read_text(encoding="utf-8")

    assert written == page(), "run 'make docs'"


def test_every_key_of_every_part_of_a_level_has_its_row() -> None:
    page, whole = write_reference_pages.level_format(), schema()
    for name, part in whole["$defs"].items():
        if name not in write_reference_pages.SHORTHAND:
            _, _, own = page.partition(f"\n## {name}\n")
            table = own.partition("\n## ")[0]
            keys = set(part.get("properties", {})) - {"repeat"}
            assert all(f"\n| `{key}` | " in table for key in keys), name
    assert " |  |  |" not in page, "a key without a type"


def test_defaults_are_written_as_a_level_writes_them() -> None:
    cells = [
        line.split(" | ")[2].strip()
        for line in write_reference_pages.level_format().splitlines()
        if line.startswith("| `")
    ]
    literals = [cell.strip("`") for cell in cells if cell.startswith("`")]

    assert len(literals) > 40
    for literal in literals:
        json.loads(literal)


def test_every_joint_effect_and_command_is_there() -> None:
    quantities, commands = write_reference_pages.all_quantities(), write_reference_pages.commands()

    assert all(f"\n| {name} | `joint." in quantities for name in joints.KINDS)
    assert all(
        f"\n| {name} | `system." in quantities for name, e in EFFECTS.items() if e.book != "none"
    )
    assert all(f"\n## {one.__name__.rstrip('_')}\n" in commands for one in COMMANDS)


def test_an_installed_package_writes_no_reference(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def sources() -> None:
        raise MisuseError(Message("this is written in a checkout of the project"))

    monkeypatch.setattr(level_catalog, "sources", sources)

    assert write_reference_pages.main() == 2
    assert "a checkout" in capsys.readouterr().err
