import os
from pathlib import Path

import pytest

from sandbox.model.errors import SandboxError
from sandbox.model.files import check_writable, write_atomically


@pytest.mark.parametrize("data", ["g = 9.81 m/s²\n", b"\x89PNG\r\n"])
def test_what_is_written_is_there_alone(tmp_path: Path, data: str | bytes) -> None:
    path = tmp_path / "file"
    path.write_text("what was there before, and longer than what comes")

    write_atomically(path, data)

    assert path.read_bytes() == (data.encode() if isinstance(data, str) else data)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_write_that_breaks_off_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    path = tmp_path / "file"
    path.write_text("old")

    def fail(_self: Path, _target: Path) -> None:
        raise error

    monkeypatch.setattr(Path, "replace", fail)

    with pytest.raises((SandboxError, KeyboardInterrupt)) as caught:
        write_atomically(path, "new")

    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
    if isinstance(error, OSError):
        assert str(caught.value) == f"cannot write {path}: No space left on device"


def test_a_new_file_has_the_permissions_of_any_other(tmp_path: Path) -> None:
    (tmp_path / "plain").touch()

    write_atomically(tmp_path / "file", "")

    assert (tmp_path / "file").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to(tmp_path / "real")

    write_atomically(tmp_path / "link", "new")

    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("", "it is a folder"),
        ("missing/file", "there is no folder"),
        ("plain/file", "plain is not a folder"),
        ("x" * 300, "name too long"),
    ],
)
def test_where_no_file_can_be_is_said(tmp_path: Path, name: str, reason: str) -> None:
    (tmp_path / "plain").touch()

    with pytest.raises(SandboxError, match="cannot write") as caught:
        write_atomically(tmp_path / name, "")

    assert reason in str(caught.value).lower()
    assert [file.name for file in tmp_path.iterdir()] == ["plain"]


@pytest.mark.skipif(not os.path.exists("/dev/null"), reason="there are no devices there")
def test_a_device_is_not_replaced_by_a_file() -> None:
    with pytest.raises(SandboxError, match="it is not an ordinary file"):
        write_atomically(Path("/dev/null"), "")


@pytest.mark.parametrize(("locked", "reason"), [("", "is read-only"), ("file", "and read-only")])
def test_what_is_read_only_stays_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, locked: str, reason: str
) -> None:
    (tmp_path / "file").touch()
    real = os.path.realpath(tmp_path / locked)
    monkeypatch.setattr(os, "access", lambda path, _mode: os.path.realpath(path) != real)

    with pytest.raises(SandboxError, match=reason):
        check_writable(tmp_path / "file")
