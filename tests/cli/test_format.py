"""`format`: which levels are rewritten, and which are left alone."""

import json

import pytest

from sandbox.model import level_catalog
from sandbox.model.level_writing import text
from sandbox.model.loading import load
from tests.cli.helpers import Run, Write, fall


def test_a_level_is_laid_out_and_says_the_same(run: Run, write: Write) -> None:
    path = write()
    path.write_text(json.dumps(fall(), ensure_ascii=False, indent=4), "utf-8")
    before = load(path)

    outcome = run("format", path)

    assert outcome == (0, f"{path}: laid out anew\n1 of 1 level changed\n", "")
    assert '"effects": {"gravity": {"acceleration": [0, "-g"]}},' in path.read_text("utf-8")
    assert load(path) == before
    assert run("format", path) == (0, "0 of 1 level changed\n", "")


def test_check_says_what_would_change_and_writes_nothing(run: Run, write: Write) -> None:
    path, done = write(), write("done.json")
    done.write_text(text(fall()), "utf-8")
    before = path.read_bytes()

    outcome = run("format", "--check", path, done)

    assert outcome == (1, f"{path}: would change\n1 of 2 levels would change\n", "")
    assert path.read_bytes() == before
    assert run("format", "--check", done).status == 0


@pytest.mark.sweep
def test_no_level_that_ships_would_change(run: Run) -> None:
    names = level_catalog.names()

    outcome = run("format", "--check", *names)

    assert outcome == (0, f"0 of {len(names)} levels would change\n", "")


def test_a_level_with_mistakes_is_told_and_left_as_it_is(run: Run, write: Write) -> None:
    wrong, good = write("wrong.json", duration=0), write()
    before = wrong.read_bytes()

    outcome = run("format", wrong, good)

    assert outcome.status == 1
    assert outcome.err.startswith(f"{wrong}:1:")
    assert outcome.err.endswith("1 of 2 levels cannot be laid out\n")
    assert wrong.read_bytes() == before
    assert len(good.read_text("utf-8").splitlines()) > 10


def test_a_file_that_is_no_level_is_left_as_it_is(run: Run, write: Write) -> None:
    path = write()
    path.write_text(json.dumps({"name": "something else"}))

    assert run("format", path).status == 1
    assert path.read_text() == '{"name": "something else"}'


def test_a_level_that_cannot_be_written_is_told(
    run: Run, write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write()
    before = path.read_bytes()
    monkeypatch.setattr("sandbox.model.atomic_file_writing.os.access", lambda *_: False)

    outcome = run("format", path)

    assert outcome.status == 1
    assert "is read-only" in outcome.err
    assert path.read_bytes() == before
