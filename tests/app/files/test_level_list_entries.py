"""What the list says of a file, whatever the file is."""

import json
import os
from pathlib import Path

import pytest

from sandbox.app.files.level_list_entries import LONGEST, Texts, entry
from tests.model.levels import bare


def test_the_texts_of_a_level_are_listed(tmp_path: Path) -> None:
    path = tmp_path / "ball.json"
    path.write_text(json.dumps(bare() | {"title": " A ball ", "summary": "It\nfalls."}))

    found = entry(path, "opened")

    assert (found.title, found.summary) == ("A ball", "It falls.")
    assert {"ball", "a", "falls."} <= set(found.words.split())


def test_a_byte_order_mark_does_not_hide_them(tmp_path: Path) -> None:
    path = tmp_path / "mark.json"
    path.write_text(json.dumps(bare() | {"title": "A ball"}), encoding="utf-8-sig")

    assert entry(path, "opened").title == "A ball"


@pytest.mark.parametrize("text", ["", "{", "[]", "1", "{}", '{"title": [0]}', "[" * 100_000, "\0"])
def test_a_file_without_a_title_is_listed_by_its_name(tmp_path: Path, text: str) -> None:
    path = tmp_path / "ball.json"
    path.write_text(text)

    assert entry(path, "opened").original == Texts("ball")


def test_endless_texts_are_cut(tmp_path: Path) -> None:
    """A list of four million letters took half a second to draw at each change."""
    path = tmp_path / "long.json"
    path.write_text(json.dumps({"title": "x" * 10**6, "summary": "y" * 10**6}))

    found = entry(path, "opened")

    assert len(found.title) == len(found.summary) == LONGEST
    assert len(found.words) < 5 * LONGEST


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes")
def test_what_is_no_ordinary_file_is_not_read(tmp_path: Path) -> None:
    """A pipe that nobody writes to would never end, nor would a device."""
    os.mkfifo(tmp_path / "pipe.json")
    (tmp_path / "zero.json").symlink_to("/dev/zero")
    (tmp_path / "folder.json").mkdir()
    with (tmp_path / "large.json").open("wb") as file:
        file.truncate(200_000_000)

    for name in ("pipe", "zero", "folder", "large", "none"):
        assert entry(tmp_path / f"{name}.json", "opened").title == name
