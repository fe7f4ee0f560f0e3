"""`frames` times the window's frames, and says which levels are not smooth."""

import json
from pathlib import Path

import pytest

from sandbox.app.frame_timing import Frames
from tests.cli.helpers import Run


@pytest.mark.sweep
def test_the_json_has_what_was_measured(tmp_path: Path, run: Run) -> None:
    file = tmp_path / "frames.json"
    asked = ("newton/atwood", "--size", "900x600", "--seconds", 0.5)
    outcome = run("frames", *asked, "--json", file)

    found = json.loads(file.read_text())
    assert found["size"] == [900, 600]
    [level] = found["levels"]
    assert level["level"] == "newton/atwood"
    assert 0 < level["median"] <= level["late"]
    assert level["speed"] > 0
    assert 0 < level["price"] < 10
    assert "newton/atwood" in outcome.out


def test_99_of_100_frames_below_a_sixtieth_of_a_second_are_smooth() -> None:
    assert Frames("a", 1.0, 0.1, 0.01, 1 / 60, 1.0).smooth
    assert not Frames("a", 1.0, 0.1, 0.01, 0.017, 1.0).smooth


@pytest.mark.parametrize("size", ["big", "1280", "100x100", "9999x900"])
def test_a_size_that_no_window_has_is_refused(size: str, run: Run) -> None:
    outcome = run("frames", "newton/atwood", "--size", size)

    assert outcome.status == 2
    assert f"--size {size}" in outcome.err
