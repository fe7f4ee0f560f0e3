"""A run as CSV, with all that another person needs to repeat it."""

import platform
from pathlib import Path

import numpy as np
import pymunk
import pytest

from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import digest, parse
from sandbox.physics.measuring.csv_export import to_csv
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.run import simulate

LEVEL = """{
  "format": 1, "title": "Two lines\\n# of title",
  "parameters": {"g": {"value": 9.81, "min": 0, "max": 25, "unit": "m/s²"}},
  "effects": {"gravity": {"acceleration": [0, "-g"]}, "rotation": {}},
  "bodies": {"ball": {"shape": {"type": "disc", "radius": 0.1}, "mass": 0.3, "position": [0.1, 7],
                      "angular_velocity": 0.7}},
  "duration": 0.5
}"""
NAMES = ("ball.position.y", "ball.angle", "system.energy")


@pytest.fixture
def level() -> Level:
    return parse(LEVEL)


@pytest.fixture
def trace(level: Level) -> Trace:
    return simulate(level, {"g": 1.0 / 3.0}, record=NAMES, stepping=Stepping(rate=70))


def comments(text: str) -> dict[str, str]:
    lines = [line for line in text.splitlines() if line.startswith("# ")]
    return {key: value for key, _, value in (line[2:].partition(": ") for line in lines)}


def test_numbers_keep_every_bit(trace: Trace, tmp_path: Path) -> None:
    path = tmp_path / "out.csv"

    write_atomically(path, to_csv(trace, "fall"))

    rows = [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "#"][1:]
    read = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    written = np.column_stack([trace.t, *trace.columns.values()])
    assert read.tobytes() == written.tobytes()


def test_every_column_says_its_unit(trace: Trace) -> None:
    header = next(line for line in to_csv(trace, "fall").splitlines() if line[0] != "#")

    assert header == "t [s],ball.position.y [m],ball.angle [rad],system.energy [J]"


def test_columns_are_those_asked_for_and_the_time_stands_first_and_once(trace: Trace) -> None:
    text = to_csv(trace, "fall", ["system.energy", "t", "ball.angle", "system.energy"])

    assert "\nt [s],system.energy [J],ball.angle [rad]\n" in text


def test_the_comments_say_what_was_run(trace: Trace, level: Level) -> None:
    told = comments(to_csv(trace, "some/fall"))

    assert told["level"] == "some/fall"
    assert told["hash"] == digest(level)
    assert told["parameters"] == f"g = {1 / 3!r} m/s²"
    assert told["rate"] == "70.0 Hz"
    assert told["iterations"] == "10"
    assert told["scheme"] == "leapfrog"
    assert told["effects"] == "gravity, rotation"
    for name, version in (
        ("python", platform.python_version()),
        ("pymunk", pymunk.version),
        ("numpy", np.__version__),
    ):
        assert f"{name} {version}" in told["versions"]
    assert "sandbox" in told["versions"]
    assert told["again"] == (
        f"python -m sandbox simulate some/fall --set g={1 / 3!r} --duration 0.5 --rate 70.0"
        " --scheme leapfrog --iterations 10 --record ball.position.y --record ball.angle"
        " --record system.energy --output FILE.csv"
    )


def test_nothing_in_a_level_can_break_out_of_its_comment(trace: Trace) -> None:
    lines = to_csv(trace, "evil\nname").splitlines()

    head = lines[: lines.index("t [s],ball.position.y [m],ball.angle [rad],system.energy [J]")]
    assert all(line.startswith("# ") for line in head)
    assert "# title: Two lines\\n# of title" in head


def test_a_run_that_a_hand_has_disturbed_is_not_said_to_be_repeatable(trace: Trace) -> None:
    text = to_csv(trace, "fall", disturbed=True)

    assert "again" not in comments(text)
    assert "# not repeatable: it was touched on the way\n" in text


def test_another_scheme_and_other_iterations_stand_in_the_command(level: Level) -> None:
    stepping = Stepping(scheme="symplectic-euler", iterations=3)
    naive = simulate(level, record=NAMES, stepping=stepping)

    told = comments(to_csv(naive, "fall"))

    assert told["scheme"] == "symplectic-euler"
    assert "--rate 60.0 --scheme symplectic-euler --iterations 3 " in told["again"]


def test_what_is_not_known_is_not_a_number(level: Level) -> None:
    """Euler's schemes know no acceleration before the first step."""
    naive = simulate(
        level, record=["ball.acceleration.y"], stepping=Stepping(scheme="symplectic-euler")
    )

    assert "\n0.0,nan\n" in to_csv(naive, "fall")


def test_a_file_that_cannot_be_written_is_said(trace: Trace, tmp_path: Path) -> None:
    with pytest.raises(SandboxError, match="there is no folder"):
        write_atomically(tmp_path / "missing" / "out.csv", to_csv(trace, "fall"))


@pytest.mark.parametrize("t", [0.1, 0.25, 0.5, 3.0])
def test_the_part_of_a_run_up_to_a_time_is_the_shorter_run(level: Level, t: float) -> None:
    whole, part = (simulate(level, record=NAMES, duration=d) for d in (3.0, t))

    cut = whole.until(t)

    assert cut.t.tobytes() == part.t.tobytes()
    for name in NAMES:
        assert cut.columns[name].tobytes() == part.columns[name].tobytes()


def test_a_contact_later_than_a_time_has_not_happened_yet() -> None:
    level = parse("""{
      "format": 1, "title": "Meeting", "effects": {"contact": {}},
      "bodies": {
        "a": {"shape": {"type": "disc", "radius": 0.5}, "mass": 1, "velocity": [1, 0]},
        "b": {"shape": {"type": "disc", "radius": 0.5}, "mass": 1, "position": [2, 0]}
      }
    }""")
    trace = simulate(level, duration=3.0)
    met = frozenset({"a", "b"})

    assert met in trace.meetings
    assert met in trace.until(2.0).meetings
    assert met not in trace.until(0.5).meetings


def test_what_touches_at_the_start_has_yet_to_meet() -> None:
    """A ball is thrown up from the ground, and meets it when it comes down."""
    level = parse("""{
      "format": 1, "title": "Up and down",
      "effects": {"gravity": {"acceleration": [0, -10]}, "contact": {}},
      "bodies": {
        "ball": {
          "shape": {"type": "disc", "radius": 0.5}, "mass": 1,
          "position": [0, 0.5], "velocity": [0, 5]
        },
        "rock": {"shape": {"type": "disc", "radius": 0.5}, "mass": 1, "position": [3, 0.5]},
        "ground": {
          "type": "static",
          "shape": {"type": "polygon", "vertices": [[-9, 0], [-9, -1], [9, -1], [9, 0]]}
        }
      }
    }""")
    trace = simulate(level, duration=2.0, record=["t"])

    met = trace.meetings[frozenset({"ball", "ground"})][0].step
    assert trace.t[met] == pytest.approx(1, abs=0.02)
    assert frozenset({"rock", "ground"}) not in trace.meetings
