import errno
import os
from pathlib import Path

import pytest

from sandbox.model import atomic_file_writing
from sandbox.model.atomic_file_writing import (
    TakenError,
    check_writable,
    folder_of_files,
    make_folder,
    write_atomically,
)
from sandbox.model.errors import MisuseError, SandboxError
from sandbox.model.translatable_message import Message
from tests.elsewhere import python


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


@pytest.mark.skipif(os.name == "nt", reason="nobody can be asked there whether a process lives")
def test_what_a_killed_process_has_begun_to_write_goes_with_the_next_file(tmp_path: Path) -> None:
    code = (
        "import os, signal; from pathlib import Path\n"
        "from sandbox.model.atomic_file_writing import *\n"
        "Path.replace = lambda *_: os.kill(os.getpid(), signal.SIGKILL)\n"
        f"write_atomically(Path({str(tmp_path / 'file')!r}), 'half')"
    )
    assert python("-c", code).returncode == -9
    assert len(list(tmp_path.glob(".*.part"))) == 1
    left = next(tmp_path.glob(".*.part"))
    mine = left.with_name(f"{left.name[:9]}-{os.getppid()}-{'0' * 32}.part")
    mine.touch()  # of a process that lives
    (tmp_path / ".another.part").touch()

    write_atomically(tmp_path / "file", "whole")

    assert {path.name for path in tmp_path.iterdir()} == {"file", mine.name, ".another.part"}


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_link_gives_way_where_it_is_not_followed(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to(tmp_path / "real")

    write_atomically(tmp_path / "link", "new", follow=False)

    assert not (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "old"


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


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_of_a_link_that_leads_nowhere_the_folder_is_named_that_is_missing(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(tmp_path / "missing" / "file")

    with pytest.raises(SandboxError, match=r"there is no folder .*missing$"):
        write_atomically(tmp_path / "link", "")


def test_a_folder_in_which_no_file_can_be_written_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda path, _: path != tmp_path)

    with pytest.raises(SandboxError, match=f"into the folder {tmp_path}: it is read-only"):
        make_folder(tmp_path)


def test_a_folder_without_space_is_no_wrong_usage(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "mkdir", fail)

    with pytest.raises(SandboxError, match="No space left on device") as caught:
        make_folder(tmp_path / "new")

    assert not isinstance(caught.value, MisuseError)


def test_a_folder_stays_only_for_the_files_in_it(tmp_path: Path) -> None:
    """Folders made in vain are removed with their new parents; existing ones stay."""
    (tmp_path / "old").mkdir()
    for name in ("a/b", "old", "old/c"):
        with pytest.raises(SandboxError), folder_of_files(tmp_path / name):
            raise SandboxError(Message("no space"))
    with folder_of_files(tmp_path / "d" / "e"):
        (tmp_path / "d" / "e" / "file").touch()

    left = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*")}
    assert left == {"old", "d", "d/e", "d/e/file"}


@pytest.mark.skipif(not os.path.exists("/dev/null"), reason="there are no devices there")
def test_a_device_is_not_replaced_by_a_file() -> None:
    with pytest.raises(SandboxError, match="it is not an ordinary file"):
        write_atomically(Path("/dev/null"), "")


@pytest.mark.parametrize(("locked", "reason"), [("", "is read-only"), ("file", "and is read-only")])
def test_what_is_read_only_stays_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, locked: str, reason: str
) -> None:
    (tmp_path / "file").touch()
    real = os.path.realpath(tmp_path / locked)
    monkeypatch.setattr(os, "access", lambda path, _mode: os.path.realpath(path) != real)

    with pytest.raises(SandboxError, match=reason):
        check_writable(tmp_path / "file")


@pytest.mark.skipif(os.name == "nt", reason="permissions as on Unix")
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o755])
def test_who_may_read_and_write_a_file_stays_as_it_was(tmp_path: Path, mode: int) -> None:
    (tmp_path / "real").touch()
    (tmp_path / "real").chmod(mode)
    (tmp_path / "link").symlink_to(tmp_path / "real")

    write_atomically(tmp_path / "link", "new")

    assert (tmp_path / "real").stat().st_mode & 0o777 == mode
    assert (tmp_path / "real").read_text() == "new"


@pytest.mark.skipif(os.name == "nt", reason="owners as on Unix")
def test_a_file_stays_whose_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    theirs = 4321, 1234
    # as if somebody else wrote
    monkeypatch.setattr(atomic_file_writing, "_owner", lambda _path: theirs)
    given = list[tuple[int, int]]()
    monkeypatch.setattr(os, "chown", lambda _path, *owner: given.append(owner))

    write_atomically(tmp_path / "file", "new")

    status = (tmp_path / "file").stat()
    assert given == [(status.st_uid, status.st_gid)]


@pytest.mark.parametrize("linked", [True, False])
def test_of_two_who_make_one_file_the_first_has_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, linked: bool
) -> None:
    """Looking first and then writing would overwrite a file made in between."""
    path, check = tmp_path / "file", check_writable

    def overtaken(path: Path, **how: bool) -> None:
        check(path, **how)
        path.write_text("theirs")

    monkeypatch.setattr(atomic_file_writing, "check_writable", overtaken)
    if not linked:  # a file system that has none
        monkeypatch.setattr(os, "link", lambda *_args, **_rest: os.stat("/nowhere"))

    with pytest.raises(TakenError, match="already exists"):
        write_atomically(path, "mine", new=True)

    assert path.read_text() == "theirs"
    assert list(tmp_path.iterdir()) == [path]
    with pytest.raises(TakenError):
        write_atomically(path, "mine", new=True)


def test_a_new_file_is_written_where_nothing_is(tmp_path: Path) -> None:
    write_atomically(tmp_path / "file", "new", new=True)

    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("file", "new")]


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_links_in_a_circle_lead_to_no_file(tmp_path: Path) -> None:
    """One of them was replaced by the file."""
    (tmp_path / "one").symlink_to("other")
    (tmp_path / "other").symlink_to("one")

    with pytest.raises(MisuseError, match="its links lead in a circle"):
        write_atomically(tmp_path / "one", "new")

    assert (tmp_path / "one").is_symlink()


@pytest.mark.skipif(not os.path.exists("/dev/fd"), reason="there are no paths of open files here")
def test_a_pipe_that_is_named_by_its_number_is_no_file() -> None:
    """As /dev/stdout is: its link leads to no path, so that it seemed to be missing."""
    reader, writer = os.pipe()
    with pytest.raises(MisuseError, match="it is not an ordinary file"):
        check_writable(Path(f"/dev/fd/{writer}"))
    os.close(reader)
    os.close(writer)
