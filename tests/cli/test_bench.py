"""`bench` times the window, and names the levels that are too slow in it."""

import json
from pathlib import Path

import pytest

from sandbox.app.window_benchmark import Timing
from sandbox.cli import bench
from tests.cli.helpers import Run

KEYS = {"level", "first_picture", "switch", "cost", "frame_p50", "frame_p99", "speed"}


def timing(first_picture: float = 1.0, switch: float = 0.1, late: float = 0.01) -> Timing:
    """Return the timing of a level that runs in real time."""
    return Timing("a", first_picture, switch, 0.1, 0.005, late, 1.0)


@pytest.mark.sweep
def test_the_json_has_what_was_measured(tmp_path: Path, run: Run) -> None:
    file = tmp_path / "bench.json"
    asked = ("newton/atwood", "kinematics/projectile")
    outcome = run("bench", *asked, "--size", "900x600", "--seconds", 0.5, "--json", file)

    found = json.loads(file.read_text())
    assert found["size"] == [900, 600]
    assert [level["level"] for level in found["levels"]] == list(asked)
    for level in found["levels"]:
        assert level.keys() == KEYS
        assert all(level[key] > 0 for key in KEYS - {"level"})
        assert level["frame_p50"] <= level["frame_p99"]
        assert level["switch"] < level["first_picture"]  # which has to start a Python, too
        assert level["level"] in outcome.out


def test_99_of_100_frames_below_a_sixtieth_of_a_second_are_smooth() -> None:
    assert timing(late=1 / 60).smooth
    assert not timing(late=0.017).smooth


@pytest.mark.parametrize(
    ("found", "marked"),
    [
        (timing(), []),
        (timing(first_picture=1.51), ["1.51 s !"]),
        (timing(switch=0.32), ["0.32 s !"]),
        (timing(late=0.017), ["17.0 ms !"]),
        (timing(2.0, 0.5, 0.1), ["2.00 s !", "0.50 s !", "100.0 ms !"]),
    ],
)
def test_what_is_beyond_its_bound_is_marked(found: Timing, marked: list[str]) -> None:
    [row] = bench._rows([found])

    assert [cell for cell in row if cell.endswith("!")] == marked


@pytest.mark.parametrize(
    ("found", "status"),
    [(timing(), 0), (timing(first_picture=9.0, switch=9.0), 0), (timing(late=0.02), 1)],
)
def test_only_frames_that_are_late_are_a_failure(
    found: Timing, status: int, tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sandbox.app.window_benchmark.time_window", lambda *_: found)
    file = tmp_path / "bench.json"

    assert run("bench", "newton/atwood", "--json", file).status == status
    [level] = json.loads(file.read_text())["levels"]
    assert level.keys() == KEYS
    assert level["frame_p99"] == found.frame_p99


@pytest.mark.parametrize("size", ["big", "1280", "100x100", "9999x900"])
def test_a_size_that_no_window_has_is_refused(size: str, run: Run) -> None:
    outcome = run("bench", "newton/atwood", "--size", size)

    assert outcome.status == 2
    assert f"--size {size}" in outcome.err


def test_a_link_to_itself_does_not_open(run: Run, tmp_path: Path) -> None:
    """It ended the command with a traceback."""
    path = tmp_path / "loop.json"
    path.symlink_to(path)

    outcome = run("bench", path, "--seconds", 0.1)

    assert outcome.status == 1
    assert "loop.json does not open" in outcome.err
