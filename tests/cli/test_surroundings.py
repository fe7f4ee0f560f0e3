"""Wherever the program is started, it works, or says in a sentence why it cannot."""

import os
from pathlib import Path

import pytest

from tests.cli.helpers import Write
from tests.cli.test_streams import shell

pytestmark = pytest.mark.skipif(os.name == "nt", reason="a shell as on Unix")


@pytest.mark.sweep
@pytest.mark.parametrize(
    "line",
    [
        "LC_ALL=C LANG=C PYTHONUTF8=0 PYTHONCOERCECLOCALE=0 SANDBOX list",
        "COLUMNS=20 SANDBOX simulate --help",
        "COLUMNS=1 SANDBOX list",
        "PYTHONOPTIMIZE=2 SANDBOX check newton/atwood",
        "SANDBOX check newton/atwood <&- >&- 2>&-",
        "env -u HOME -u XDG_CACHE_HOME SANDBOX check newton/atwood",
    ],
)
def test_the_surroundings_do_not_matter(line: str) -> None:
    done = shell(line.replace("env -u HOME -u XDG_CACHE_HOME", "unset HOME XDG_CACHE_HOME;"))

    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.sweep
def test_what_cannot_be_kept_for_want_of_a_home_is_found_all_the_same(
    write: Write, tmp_path: Path
) -> None:
    path = write(stepping={"accuracy": 1e-2})

    line = f"HOME=/dev/null XDG_CACHE_HOME=/dev/null SANDBOX simulate {path} --output out.csv"
    done = shell(line, tmp_path)

    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert (tmp_path / "out.csv").stat().st_size > 0


@pytest.mark.sweep
@pytest.mark.parametrize(
    "line",
    [
        "SANDBOX generate pile --bodies 20 --output pile.json",
        "SANDBOX experiment newton/atwood --vary m1=1,2 --measure t@end --jobs 1 --output made",
        "VALIDATION compose --count 1 --jobs 1 --json made.json",
        "VALIDATION cost kinematics/free-fall --quick --output made/here",
    ],
)
def test_without_space_for_a_file_both_programs_end_alike_and_leave_nothing(
    tmp_path: Path, line: str
) -> None:
    """No file may exceed 1 kB here."""
    done = shell(f"ulimit -f 1; {line}", tmp_path)

    assert (done.returncode, "Traceback" in done.stderr) == (1, False)
    assert "cannot write" in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.sweep
def test_an_end_that_is_asked_for_leaves_no_file(write: Write, tmp_path: Path) -> None:
    path = write(duration=1e5, checks=[])
    out = tmp_path / "out.csv"

    done = shell(f"timeout --signal=TERM 3 env SANDBOX simulate {path} --output {out}", tmp_path)

    assert done.returncode in (124, 143)
    assert "Traceback" not in done.stderr
    assert not out.exists()
    assert not list(tmp_path.glob(".*.part"))


@pytest.mark.sweep
def test_a_crowd_is_told_before_it_is_played(write: Write) -> None:
    disc = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1}
    crowd = {f"d{i}": disc for i in range(400)}
    path = write(parameters={}, bodies=crowd, effects={"contact": {"overlaps": True}}, checks=[])

    done = shell(f"SANDBOX check {path}")

    assert done.returncode == 1
    assert "pairs of bodies are close to each other, too many for a step" in done.stderr
