"""What may be wrong with files and surroundings of a command, for `tests.endurance.faults`."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path

HUGE = 200_000_000  # bytes

Make = Callable[[Path], object]


def _sealed(path: Path) -> None:
    path.mkdir()
    path.chmod(0)


def _unreadable(path: Path) -> None:
    path.write_text("{}")
    path.chmod(0)


def _locked(path: Path) -> None:
    _sealed(locked := path.with_name("locked"))
    path.symlink_to(locked / path.name)


def _within(path: Path) -> None:
    """Make a path that leads through a file."""
    path.symlink_to(Path(__file__) / "file.json")


def _huge(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(HUGE)


def _link(target: str) -> Make:
    return lambda path: path.symlink_to(target)


def _bytes(content: bytes) -> Make:
    return lambda path: path.write_bytes(content)


INPUTS: Mapping[str, Make] = {
    "missing": lambda _: None,
    "folder": Path.mkdir,
    "pipe": os.mkfifo,
    "broken link": _link("nowhere"),
    "circle of links": lambda path: path.symlink_to(path.name),
    "link to /dev/zero": _link("/dev/zero"),
    "link to /dev/full": _link("/dev/full"),
    "link to a terminal": _link("/dev/tty"),
    "path through a file": _within,
    "unreadable": _unreadable,
    "folder without access": _sealed,
    "link into a locked folder": _locked,
    "link to it": lambda path: path.symlink_to(path.with_name(f"aside-{path.name}")),
    "empty": _bytes(b""),
    "binary": _bytes(bytes(range(256)) * 40),
    "UTF-16": _bytes("{}".encode("utf-16")),
    "Latin-1": _bytes(b'{"title": "Fl\xe4che"}'),
    "huge": _huge,
}  # fmt: skip
"""What may be at the path of a file that is read, and cannot be used."""


def _read_only(path: Path) -> None:
    path.parent.chmod(0o500)


def _no_folder(path: Path) -> None:
    path.parent.rmdir()


def _file_for_folder(path: Path) -> None:
    path.parent.rmdir()
    path.parent.write_text("")


def _elsewhere(path: Path) -> None:
    """Let the path lead to a file, or to a folder, of another place."""
    target = path.parent.parent / f"target{path.suffix}"
    if path.suffix:
        target.write_text("before")
    else:
        target.mkdir()
    path.symlink_to(target)


OUTPUTS: Mapping[str, Make] = {
    "read-only folder": _read_only,
    "locked folder": lambda path: path.parent.chmod(0),
    "missing folder": _no_folder,
    "folder": Path.mkdir,
    "file": _bytes(b"before"),
    "pipe without reader": os.mkfifo,
    "link": _elsewhere,
    "link into no folder": _link("nowhere/at/all"),
    "circle of links": lambda path: path.symlink_to(path.name),
    "link to /dev/full": _link("/dev/full"),
    "path through a file": _file_for_folder,
}  # fmt: skip
"""What may be at a path that is written."""


def usable(fault: str, output: str) -> bool:
    """Whether something can be written there: files over files, and folders are made."""
    if fault == "link":
        return not output.startswith("mine")  # `new` overwrites nothing, not even by a link
    if output.endswith("/"):
        return fault in ("missing folder", "folder")
    return fault == "file" and not output.startswith("mine")


ISOLATED = (
    "import runpy, sys; sys.path.insert(0, ROOT);"
    " runpy.run_module(MODULE, run_name='__main__', alter_sys=True)"
)
NO_HOME = "unset HOME XDG_CACHE_HOME XDG_CONFIG_HOME XDG_DATA_HOME;"
NULL_HOME = " ".join(
    f"{name}=/dev/null" for name in ("HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME")
)

SURROUNDINGS = {
    "reader gone": "PYTHON -m COMMAND | true; exit ${PIPESTATUS[0]}",
    "closed output": "exec PYTHON -m COMMAND >&-",
    "full output": "exec PYTHON -m COMMAND > /dev/full",
    "closed errors": "exec PYTHON -m COMMAND 2>&-",
    "full errors": "exec PYTHON -m COMMAND 2> /dev/full",
    "closed input": "exec PYTHON -m COMMAND <&-",
    "all closed": "exec PYTHON -m COMMAND <&- >&- 2>&-",
    "20 columns": "COLUMNS=20 exec PYTHON -m COMMAND",
    "1 column": "COLUMNS=1 exec PYTHON -m COMMAND",
    "LC_ALL=C": "LC_ALL=C LANG=C PYTHONUTF8=0 PYTHONCOERCECLOCALE=0 exec PYTHON -m COMMAND",
    "ASCII": "PYTHONIOENCODING=ascii exec PYTHON -m COMMAND",
    "no home": f"{NO_HOME} exec PYTHON -m COMMAND",
    "home is no folder": f"{NULL_HOME} exec PYTHON -m COMMAND",
    "read-only home": "mkdir h; chmod 500 h; HOME=$PWD/h exec PYTHON -m COMMAND",
    "no working folder": "mkdir ../gone; cd ../gone; rmdir ../gone; exec PYTHON -m COMMAND",
    "full disk": "ulimit -f 0; exec PYTHON -m COMMAND",
    "few open files": "ulimit -n 64; exec PYTHON -m COMMAND",
    "-O": "exec PYTHON -O -m COMMAND",
    "-OO": "exec PYTHON -OO -m COMMAND",
    "-I": "exec PYTHON -I -c ISOLATED",
    "-W error": "exec PYTHON -W error -m COMMAND",
}  # fmt: skip
"""Lines of a shell in which a command is called."""
