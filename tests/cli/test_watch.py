"""`check --watch`: a file is checked again whenever it changes."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from sandbox.cli import check
from tests.cli.helpers import Outcome, Run, Write
from tests.elsewhere import ROOT


class EndedError(Exception):
    """What ends a watch in place of Ctrl-C."""


Watch = Callable[..., Outcome]


@pytest.fixture
def watch(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Watch:
    """Watches a level while one change follows another, with a look at the file after each."""

    def watch(path: Path, *happenings: Callable[[], object]) -> Outcome:
        pending = iter(happenings)

        def sleep(_: float) -> None:
            happening = next(pending, None)
            if happening is None:
                raise EndedError
            happening()

        monkeypatch.setattr("sandbox.cli.check.time.sleep", sleep)
        with pytest.raises(EndedError):
            check.keep_checking([str(path)])
        return Outcome(0, *capsys.readouterr())

    return watch


def nothing() -> None:
    """Change nothing."""


def test_a_file_that_does_not_change_is_checked_once(watch: Watch, write: Write) -> None:
    assert watch(write(), nothing, nothing).out == "1 level well formed\n"


def test_a_mistake_is_told_and_that_all_is_well_again(watch: Watch, write: Write) -> None:
    path = write()

    outcome = watch(path, lambda: write(duration=0), nothing, lambda: write(duration=2))

    assert outcome.out.count("1 level well formed\n") == 2
    assert outcome.err.count(f"{path}:1:") == 1
    assert "1 of 1 level cannot be used" in outcome.err


def test_a_file_that_goes_may_come_back(watch: Watch, write: Write) -> None:
    path = write()

    outcome = watch(path, path.unlink, write)

    assert outcome.out.count("1 level well formed\n") == 2
    assert "there is no such file" in outcome.err


def test_what_is_not_there_is_not_watched(run: Run, tmp_path: Path) -> None:
    outcome = run("check", "--watch", tmp_path / "nowhere.json")

    assert outcome.status == 1
    assert "there is no such file" in outcome.err


@pytest.mark.sweep
@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C cannot be sent to one process alone")
def test_ctrl_c_ends_it_without_a_traceback(write: Write) -> None:
    path = write()
    command = [sys.executable, "-m", "sandbox", "check", "--watch", str(path)]
    with subprocess.Popen(
        command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == "1 level well formed\n"
        write(duration=3)
        changed = [process.stdout.readline() for _ in range(3)]
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)

    assert changed[0] == "\n"
    assert changed[1].startswith(f"{path} at ")
    assert changed[2] == "1 level well formed\n"
    assert err == ""
    assert process.returncode == 130
