"""Whatever is dropped on the window, it says why that is no level, and goes on."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import pygame
import pytest

from tests.app.person import Person
from tests.model.levels import bare


def pipe(path: Path) -> None:
    if not hasattr(os, "mkfifo"):
        pytest.skip("the system has no pipes")
    os.mkfifo(path)


def sparse(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(200_000_000)


ODD: dict[str, Callable[[Path], object]] = {
    "is not an ordinary file": pipe,
    "is a folder": Path.mkdir,
    "larger than": sparse,
    "Too many levels of symbolic links": lambda path: path.symlink_to(path),
    "there is no such file": lambda path: path.symlink_to(path.with_name("nothing.json")),
    "U+0000": lambda path: path.write_bytes(bytes(1000)),
    "is not UTF-8": lambda path: path.write_bytes(b"\xff\xfe{\0}\0"),
    "must not be longer": lambda path: path.write_text(json.dumps(bare() | {"title": "x" * 10**6})),
}


@pytest.mark.skipif(os.name == "nt", reason="not everybody may make links there")
@pytest.mark.parametrize("told", ODD)
def test_an_odd_file_that_is_dropped_is_refused_with_the_reason(
    person: Person, tmp_path: Path, told: str
) -> None:
    path = tmp_path / "odd.json"
    ODD[told](path)

    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
    person.wait()
    person.window.go_home()
    person.wait()
    person.window.go_home()
    person.wait()

    assert person.window.session is None
    assert person.window.panels.refusal is not None
    assert told in person.window.panels.refusal.text


@pytest.mark.parametrize("name", ["picture.png", "text.txt", "folder", "broken.run.json", "gone"])
def test_what_is_no_level_leaves_the_run_where_it_is(
    person: Person, tmp_path: Path, name: str
) -> None:
    """Dropped by mistake, it took the place of the run, which was lost."""
    person.window.open_level("newton/atwood")
    person.session.step()
    session, path = person.session, tmp_path / name
    if name == "folder":
        path.mkdir()
    elif name != "gone":
        path.write_bytes(b"\x89PNG\r\n")

    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))
    person.wait()

    assert person.window.session is session
    assert session.world.steps == 1
    assert person.window.path is not None
    assert person.window.path.stem == "atwood"
    assert name in person.window.banner._note
    assert not person.window.files.recent.paths
