"""Drafts: every step is undone and redone, and files stay whole and are not overwritten."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.editing.draft import MOST_STEPS, Draft
from sandbox.editing.text_patches import put
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.loading import read
from tests.sample import sampled

LEVELS = sorted(level_catalog.root().glob("*/*.json"))
BOM = b"\xef\xbb\xbf"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "level.json"
    path.write_bytes(level_catalog.find("newton/atwood").read_bytes())
    return path


def titled(draft: Draft, title: str) -> str:
    return put(draft.text, ("title",), title)


@pytest.mark.parametrize("path", sampled(LEVELS, "save"))
def test_every_level_that_ships_is_saved_as_it_was_opened(path: Path, tmp_path: Path) -> None:
    draft = Draft.open(path)
    draft.save(tmp_path / "other.json")
    assert (tmp_path / "other.json").read_bytes() == path.read_bytes()


def test_a_new_level_loads() -> None:
    draft = Draft.empty()
    assert draft.level is not None
    assert not draft.changed
    assert not draft.mistakes


def test_mistakes_are_told_with_their_place_and_leave_no_level() -> None:
    draft = Draft.empty()
    draft.change(put(draft.text, ("bodies", "ground", "mass"), 1), "a mass")
    assert draft.level is None
    assert [mistake.path for mistake in draft.mistakes] == ["bodies.ground.mass"]
    assert str(draft.mistakes[0]).startswith("<new level>:")


@pytest.mark.sweep
@given(st.lists(st.text(max_size=8), max_size=12), st.integers(0, 20))
def test_undo_of_all_is_the_first_text_and_redo_of_all_the_last(
    titles: list[str], back: int
) -> None:
    draft = Draft.empty()
    first = draft.text
    for title in titles:
        draft.change(titled(draft, title), title)
    last = draft.text
    for _ in range(back):
        draft.undo()
    while draft.redo() is not None:
        pass
    assert draft.text == last
    while draft.undo() is not None:
        pass
    assert draft.text == first
    assert not draft.changed


def test_a_thousand_steps_are_kept() -> None:
    draft = Draft.empty()
    for number in range(MOST_STEPS + 1):
        draft.change(titled(draft, f"{number}"), "a title")
    while draft.undo() is not None:
        pass
    assert '"title": "0"' in draft.text


def test_a_drag_is_one_step() -> None:
    draft = Draft.empty()
    first = draft.text
    for number in range(5):
        draft.change(titled(draft, f"{number}"), "drag", merge="drag 1")
    draft.change(titled(draft, "x"), "drag", merge="drag 2")
    assert draft.undo() == "drag"
    assert '"title": "4"' in draft.text
    assert draft.undo() == "drag"
    assert draft.text == first
    assert draft.undo() is None


def test_a_drag_back_to_where_it_began_is_no_step() -> None:
    draft = Draft.empty()
    first = draft.text
    draft.change(titled(draft, "x"), "drag", merge="drag")
    draft.change(first, "drag", merge="drag")
    assert draft.undo_description is None


def test_a_drag_goes_on_neither_after_an_undo_nor_after_saving(tmp_path: Path) -> None:
    draft = Draft.empty()
    draft.change(titled(draft, "a"), "drag", merge="drag")
    draft.save(tmp_path / "new.json")
    draft.change(titled(draft, "b"), "drag", merge="drag")
    draft.undo()
    assert not draft.changed
    draft.change(titled(draft, "c"), "drag", merge="drag")
    draft.undo()
    assert not draft.changed


def test_a_change_forgets_what_was_undone() -> None:
    draft = Draft.empty()
    draft.change(titled(draft, "a"), "a")
    draft.undo()
    draft.change(titled(draft, "b"), "b")
    assert draft.redo() is None


def test_a_file_that_was_changed_outside_is_not_overwritten_unasked(file: Path) -> None:
    draft = Draft.open(file)
    draft.change(titled(draft, "mine"), "a title")
    assert not draft.changed_outside()
    theirs = file.read_text("utf-8").replace("Atwood machine", "theirs", 1)
    file.write_text(theirs, "utf-8")
    assert draft.changed_outside()
    with pytest.raises(SandboxError, match="changed outside"):
        draft.save()
    assert file.read_text("utf-8") == theirs
    draft.save(overwrite=True)
    assert '"mine"' in file.read_text("utf-8")
    assert not draft.changed_outside()


def test_what_was_changed_outside_is_read_again_and_that_can_be_undone(file: Path) -> None:
    draft = Draft.open(file)
    draft.change(titled(draft, "mine"), "a title")
    mine = draft.text
    file.write_text(file.read_text("utf-8").replace("Atwood machine", "theirs"), "utf-8")
    draft.reload()
    assert '"theirs"' in draft.text
    assert not draft.changed
    draft.undo()
    assert draft.text == mine
    assert draft.changed


def test_another_file_is_not_overwritten_unasked(file: Path) -> None:
    with pytest.raises(SandboxError, match="already exists"):
        Draft.empty().save(file)


def test_a_new_level_needs_a_file() -> None:
    with pytest.raises(SandboxError, match="choose where"):
        Draft.empty().save()
    with pytest.raises(SandboxError, match="no file"):
        Draft.empty().reload()


def test_a_file_that_is_gone_is_written_again(file: Path) -> None:
    draft = Draft.open(file)
    file.unlink()
    assert not draft.changed_outside()
    draft.save()
    assert read(file) == draft.text


def test_the_mark_that_some_programs_begin_a_file_with_stays(file: Path) -> None:
    file.write_bytes(BOM + file.read_bytes().replace(b"\n", b"\r\n"))
    before = file.read_bytes()
    draft = Draft.open(file)
    draft.save()
    assert file.read_bytes() == before
    draft.change(titled(draft, "mine"), "a title")
    draft.save()
    assert file.read_bytes() == before.replace(b"Atwood machine", b"mine", 1)
