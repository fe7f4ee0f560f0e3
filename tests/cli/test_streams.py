"""Without a reader or space for its output, a command says so in a sentence and ends quietly."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.helpers import Write
from tests.elsewhere import PATIENCE, ROOT

pytestmark = pytest.mark.skipif(os.name == "nt", reason="a shell as on Unix")


def shell(line: str, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """Run a line of a shell in which SANDBOX and VALIDATION stand for the two programs."""
    python = f"PYTHONPATH={shlex.quote(str(ROOT))} {shlex.quote(sys.executable)} -m"
    for name in ("sandbox", "validation"):
        line = line.replace(name.upper(), f"{python} {name}")
    return subprocess.run(
        ["bash", "-c", line],
        cwd=folder, capture_output=True, text=True, encoding="utf-8", timeout=PATIENCE, check=False,
    )  # fmt: skip


@pytest.mark.sweep
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no such device there")
@pytest.mark.parametrize("command", ["SANDBOX list", "SANDBOX --help", "VALIDATION --help"])
def test_a_full_disk_under_what_is_said_is_told_in_a_sentence(command: str) -> None:
    done = shell(f"{command} > /dev/full")

    assert done.returncode == 1
    assert done.stderr == "cannot write to the standard output: No space left on device\n"


@pytest.mark.sweep
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no such device there")
def test_a_full_disk_under_remarks_costs_no_work(write: Write, tmp_path: Path) -> None:
    """The work is not lost, nor if their reader has gone."""
    for nowhere in ("2> /dev/full", "2> >(true)"):
        done = shell(f"SANDBOX simulate {write()} --output out.csv {nowhere}", tmp_path)

        assert (done.returncode, done.stderr) == (0, "")
        assert (tmp_path / "out.csv").stat().st_size > 0
        (tmp_path / "out.csv").unlink()


@pytest.mark.sweep
def test_whoever_stops_reading_ends_the_program_without_a_word(
    write: Write, tmp_path: Path
) -> None:
    """Like any program that does not handle pipes: by SIGPIPE, 13."""
    output = shlex.quote(str(tmp_path / "out.csv"))
    line = f"SANDBOX simulate {shlex.quote(str(write()))} --output {output} | true"

    done = shell(f"{line}; exit ${{PIPESTATUS[0]}}")

    assert (done.returncode, done.stderr) == (141, "")
    assert (tmp_path / "out.csv").stat().st_size > 0


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("line", "file"),
    [
        ("VALIDATION pace kinematics/free-fall --json made.json", "made.json"),
        ("SANDBOX bench kinematics/free-fall --seconds 0.1 --json made.json", "made.json"),
        (
            "SANDBOX experiment newton/atwood --vary m1=1,2 --measure t@end --jobs 1 --output made",
            "made/report.html",
        ),
    ],
)
def test_what_was_measured_is_written_even_if_nobody_reads_of_it(
    tmp_path: Path, line: str, file: str
) -> None:
    done = shell(f"{line} | true; exit ${{PIPESTATUS[0]}}", tmp_path)

    assert done.returncode == 141
    assert (tmp_path / file).stat().st_size > 0


def test_no_file_gets_the_number_of_a_closed_stream(tmp_path: Path) -> None:
    """What a library prints would be written into it."""
    code = (
        "import os, sys; from sandbox import standard_streams; standard_streams.install();"
        " file = open('out.txt', 'w'); os.write(1, b'printed'); os.write(2, b'printed');"
        " file.write(f'{file.fileno()}')"
    )
    python = f"PYTHONPATH={shlex.quote(str(ROOT))} {shlex.quote(sys.executable)}"

    done = shell(f"{python} -c {shlex.quote(code)} <&- >&- 2>&-", tmp_path)

    assert done.returncode == 0
    assert int((tmp_path / "out.txt").read_text()) > 2


@pytest.mark.sweep
def test_a_closed_output_is_no_failure() -> None:
    done = shell("SANDBOX check newton/atwood >&-")

    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("command", "told"),
    [
        (
            "simulate newton/atwood --output out.csv",
            "cannot write out.csv: the working folder no longer exists\n",
        ),
        ("check q.json", "q.json: there is no such file\n1 of 1 level cannot be used\n"),
    ],
)
def test_a_working_folder_that_is_gone_is_told_in_a_sentence(
    tmp_path: Path, command: str, told: str
) -> None:
    (tmp_path / "here").mkdir()

    done = shell(f"rmdir ../here; SANDBOX {command}", tmp_path / "here")

    assert done.returncode in (1, 2)
    assert done.stderr == told
