"""`list` and `check`, and how a level is named."""

from pathlib import Path

import pytest
from rich.console import Console

from sandbox.cli import listing
from sandbox.cli.usage import open_level
from sandbox.model import catalog
from tests.cli.helpers import Run, Write


@pytest.mark.usefixtures("chapters")
def test_elsewhere_than_on_a_terminal_a_level_is_one_line_with_tabs(run: Run) -> None:
    outcome = run("list")

    assert outcome == (0, "motion/fall\tFall\tgravity\tA ball falls.\n", "")


def test_the_list_names_every_level(run: Run) -> None:
    names = [line.split("\t")[0] for line in run("list").out.splitlines()]

    assert names == catalog.names()


def test_on_a_terminal_of_80_columns_names_are_whole(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def terminal(*, highlight: bool) -> Console:
        return Console(width=80, force_terminal=True, color_system=None, highlight=highlight)

    monkeypatch.setattr(listing, "Console", terminal)

    lines = run("list").out.splitlines()

    assert set(catalog.names()) <= {line.split(" ")[0] for line in lines}
    assert max(map(len, lines)) <= 80


@pytest.mark.parametrize("text", ["", "{", "[]", '{"title": 3}', '{"title": "x", "effects": 1}'])
def test_a_level_that_cannot_be_read_does_not_spoil_the_list(
    run: Run, chapters: Path, text: str
) -> None:
    (chapters / "motion" / "bad.json").write_text(text)

    outcome = run("list")

    assert outcome.status == 0
    assert [line.split("\t")[0] for line in outcome.out.splitlines()] == [
        "motion/bad",
        "motion/fall",
    ]
    assert "'check motion/bad' says why" in outcome.out


@pytest.mark.usefixtures("chapters")
def test_a_level_may_be_named_or_be_a_file(run: Run, write: Write) -> None:
    outcome = run("check", "motion/fall", "fall", write())

    assert outcome == (0, "3 levels well formed\n", "")


def test_every_mistake_of_every_level_is_told(run: Run, write: Write) -> None:
    good = write("good.json")
    first = write("first.json", effects={"gravty": {}}, duration=0)
    second = write("second.json", title="")

    outcome = run("check", first, good, second, "nowhere/at-all")

    places = [line.partition(": ")[0] for line in outcome.err.splitlines()]
    assert outcome.status == 1
    assert sum(place.startswith(f"{first}:1:") for place in places) == 2
    assert sum(place.startswith(f"{second}:1:") for place in places) == 1
    assert places[-2] == "nowhere/at-all"
    assert places[-1] == "3 of 4 levels cannot be used"
    assert outcome.out == ""


def test_check_needs_a_level(run: Run) -> None:
    assert run("check").status == 2


@pytest.mark.usefixtures("chapters")
def test_a_level_of_the_catalog_is_called_by_its_whole_name(write: Write) -> None:
    path = str(write())

    assert open_level("fall")[0] == "motion/fall"
    assert open_level(path)[0] == path
