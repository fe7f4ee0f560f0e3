"""`--accuracy`: a setting is found, stated, and used."""

import shlex
from pathlib import Path

import pytest

from sandbox.app import main as window
from sandbox.physics.accuracy import calibration_cache as memory
from tests.cli.helpers import Run, Write

ASKING = {"stepping": {"accuracy": 1e-6}}


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache folder for this test."""
    monkeypatch.setattr(memory, "folder", lambda: tmp_path / "cache")
    monkeypatch.setattr(memory, "_unkept", {})
    return tmp_path / "cache"


def test_simulate_says_what_was_found_and_runs_with_it(
    run: Run, write: Write, tmp_path: Path, cache: Path
) -> None:
    output = tmp_path / "out.csv"
    outcome = run("simulate", write(), "--accuracy", "1e-6", "--output", output)

    assert outcome.status == 0
    assert "accuracy 1e-06: leapfrog at 30 Hz, estimated error" in outcome.out
    assert "ms of computing per second of the scene, judged by its checks" in outcome.out
    assert "# rate: 30.0 Hz" in output.read_text()
    assert len(list(cache.iterdir())) == 1


def test_a_level_that_asks_can_be_run_again_as_it_was(
    run: Run, write: Write, tmp_path: Path
) -> None:
    first, second = tmp_path / "1.csv", tmp_path / "2.csv"
    path = write(**ASKING)
    run("simulate", path, "--output", first)
    again = next(line for line in first.read_text().splitlines() if line.startswith("# again"))
    assert "--rate 30.0" in again

    outcome = run("simulate", path, "--rate", "30.0", "--output", second)

    assert outcome.status == 0
    assert "estimated" not in outcome.out
    assert second.read_text().splitlines()[20:] == first.read_text().splitlines()[20:]


def test_what_is_asked_for_is_run_again_by_the_command_in_the_file(
    run: Run, write: Write, tmp_path: Path
) -> None:
    """To the last letter, with another scheme than the level's."""
    first, second = tmp_path / "1.csv", tmp_path / "2.csv"
    path = write(stepping={"scheme": "fourth-order"})
    run("simulate", path, "--accuracy", "1e-6", "--output", first)
    text = first.read_text(encoding="utf-8")
    again = next(line for line in text.splitlines() if line.startswith("# again: "))

    run(*shlex.split(again.removeprefix("# again: "))[3:-1], second)

    assert "# scheme: leapfrog" in text
    assert second.read_text(encoding="utf-8") == text


def test_render_asks(run: Run, write: Write, tmp_path: Path) -> None:
    outcome = run("render", write(), "--accuracy", "1e-3", "--output", tmp_path / "out.png")

    assert outcome.status == 0
    assert "accuracy 0.001: leapfrog at 30 Hz" in outcome.out


def test_play_asks(run: Run, write: Write, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[tuple[object, ...]] = []
    monkeypatch.setattr(window, "has_display", lambda: True)
    monkeypatch.setattr(window, "run", lambda *arguments, **_: opened.append(arguments))
    path = write()

    assert run("play", path, "--accuracy", "1e-6").status == 0
    assert opened[0][:3] == (str(path), {}, 1e-6)


@pytest.mark.parametrize(
    ("options", "told", "status"),
    [
        (["--accuracy", "1e-6", "--rate", "60"], "a setting is chosen or asked for, not both", 2),
        (
            ["--accuracy", "1e-6", "--scheme", "leapfrog"],
            "--accuracy and --scheme: a setting is",
            2,
        ),
        (["--accuracy", "0"], "--accuracy 0: must be greater than 0", 2),
        (["--accuracy", "1"], "--accuracy 1: ", 2),
        (["--accuracy", "nan"], "--accuracy nan: ", 2),
        (["--accuracy", "high"], "--accuracy", 2),
        (["--accuracy", "1e-20"], "below rounding; it must be at least 1e-14", 1),
    ],
)
def test_what_cannot_be_asked_for_is_said(
    run: Run, write: Write, tmp_path: Path, options: list[str], told: str, status: int
) -> None:
    outcome = run("simulate", write(), *options, "--output", tmp_path / "out.csv")

    assert outcome.status == status
    assert told in outcome.err
    assert not (tmp_path / "out.csv").exists()


def test_a_cache_that_cannot_be_written_is_said_and_does_no_harm(
    run: Run, write: Write, tmp_path: Path, cache: Path
) -> None:
    cache.write_text("no folder")
    outcome = run("simulate", write(), "--accuracy", "1e-6", "--output", tmp_path / "out.csv")

    assert outcome.status == 0
    assert "the setting is not kept for the next time" in outcome.err
    assert "Traceback" not in outcome.err
