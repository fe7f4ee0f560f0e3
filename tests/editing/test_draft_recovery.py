"""Recovery: a draft survives the process that edits it, whole, and nothing else is kept."""

import json
import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest

from sandbox.editing import draft_recovery
from sandbox.editing.draft import Draft
from sandbox.editing.draft_recovery import Recovery, recoverable
from sandbox.editing.text_patches import put
from sandbox.model import atomic_file_writing, level_catalog, unsaved_files


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(draft_recovery, "data_folder", lambda: tmp_path)
    return tmp_path


def drawn(title: str = "mine") -> Draft:
    draft = Draft.empty()
    draft.change(put(draft.text, ("title",), title), "a title")
    return draft


def crash(monkeypatch: pytest.MonkeyPatch) -> None:
    """Treat the open drafts as left by a process that has ended."""
    monkeypatch.setattr(unsaved_files, "_OPEN", set())
    monkeypatch.setattr(unsaved_files, "lives", lambda _: False)


def test_a_draft_is_recovered_after_a_crash(monkeypatch: pytest.MonkeyPatch) -> None:
    draft = drawn()
    assert Recovery().keep(draft) == ""
    assert recoverable() == []
    crash(monkeypatch)
    (found,) = recoverable()
    assert found.draft().text == draft.text
    assert found.draft().undo() == "recover what was drawn"
    found.forget()
    assert recoverable() == []


def test_what_is_saved_or_closed_is_not_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    saved, closed = Recovery(), Recovery()
    draft = drawn()
    saved.keep(draft)
    closed.keep(draft)
    draft.save(tmp_path / "level.json")
    saved.keep(draft)
    closed.forget()
    crash(monkeypatch)
    assert recoverable() == []
    assert [path.name for path in tmp_path.glob("drafts/*")] == []


def test_what_has_not_changed_is_not_written_again(own_folder: Path) -> None:
    draft, kept = drawn(), Recovery()
    kept.keep(draft)
    (file,) = own_folder.glob("drafts/*")
    file.unlink()
    kept.keep(draft)
    assert not list(own_folder.glob("drafts/*"))


def test_a_draft_of_a_file_is_recovered_onto_it_unless_it_has_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "level.json"
    path.write_bytes(level_catalog.find("newton/atwood").read_bytes())
    draft = Draft.open(path)
    draft.change(put(draft.text, ("title",), "mine"), "a title")
    Recovery().keep(draft)
    crash(monkeypatch)
    (found,) = recoverable()
    again = found.draft()
    assert (again.path, again.text) == (path, draft.text)
    assert again.changed
    path.write_text(draft.text.replace("mine", "theirs"), "utf-8")
    (found,) = recoverable()
    assert (found.draft().path, found.draft().text) == (None, draft.text)


def test_what_another_window_draws_is_left_to_it(monkeypatch: pytest.MonkeyPatch) -> None:
    Recovery().keep(drawn())
    monkeypatch.setattr(unsaved_files, "_OPEN", set())
    monkeypatch.setattr(unsaved_files, "lives", lambda _: True)
    monkeypatch.setattr(os, "getpid", lambda: 1)
    assert recoverable() == []


def test_a_file_that_something_else_has_written_is_left_alone(own_folder: Path) -> None:
    (own_folder / "drafts").mkdir()
    (own_folder / "drafts" / "x.draft.json").write_text("{", "utf-8")
    assert recoverable() == []


def test_where_nothing_can_be_kept_that_is_told(own_folder: Path) -> None:
    (own_folder / "drafts").write_text("a file", "utf-8")
    assert "it is a file" in Recovery().keep(drawn())


WRITES = """
    import sys
    from pathlib import Path
    from sandbox.editing import draft_recovery as recovery
    from sandbox.editing.draft import Draft
    from sandbox.editing.text_patches import put
    recovery.data_folder = lambda: Path(sys.argv[1])
    draft, kept = Draft.empty(), recovery.Recovery()
    target = Path(sys.argv[1]) / "level.json"
    draft.save(target, overwrite=True)
    print("ready", flush=True)
    for number in range(10**9):
        draft.change(put(draft.text, ("title",), str(number % 10) * 70), "a title")
        kept.keep(draft)
        if number % 2:
            draft.save()
"""


@pytest.mark.sweep
@pytest.mark.skipif(sys.platform == "win32", reason="has no signal that ends a process at once")
def test_a_process_killed_at_any_moment_leaves_files_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Killed 12 times, each a little later: level and draft are old or new, never half written."""
    crash(monkeypatch)
    for late in range(12):
        command = [sys.executable, "-c", textwrap.dedent(WRITES), str(tmp_path)]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
            assert process.stdout is not None
            assert process.stdout.readline() == b"ready\n"
            time.sleep(0.003 * late)
            process.send_signal(signal.SIGKILL)
        assert Draft.open(tmp_path / "level.json").level is not None
        for found in recoverable():
            assert found.draft().level is not None
            found.forget()
        assert not list(tmp_path.glob("drafts/*.json"))
    assert atomic_file_writing.lives(os.getpid())


@pytest.mark.parametrize("when", [-1.0, 1e300, float("nan"), float("inf")])
def test_a_time_that_no_calendar_has_was_not_written_here(
    monkeypatch: pytest.MonkeyPatch, own_folder: Path, when: float
) -> None:
    Recovery().keep(drawn())
    [file] = own_folder.glob("drafts/*")
    file.write_text(json.dumps({**json.loads(file.read_text()), "when": when}))
    crash(monkeypatch)

    assert recoverable() == []
    assert file.exists()
