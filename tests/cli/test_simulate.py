"""`simulate`: its file, its verdicts, its exit status."""

import csv
import re
import shlex
from pathlib import Path

import pytest

from sandbox.cli.simulate import chosen
from sandbox.model.level import Stepping
from sandbox.model.loading import load
from sandbox.physics.run import simulate
from tests.cli.helpers import NEVER, WRONG, Run, Write, height


def table(path: Path) -> tuple[list[str], list[list[float]]]:
    """Return the header and the numbers of a CSV file."""
    lines = path.read_text(encoding="utf-8").splitlines()
    header, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    return header, [[float(cell) for cell in row] for row in rows]


def test_the_file_holds_every_bit_of_the_run(run: Run, write: Write, tmp_path: Path) -> None:
    path, output = write(), tmp_path / "out.csv"

    outcome = run("simulate", path, "--set", "g=1.7", "--rate", 70, "--output", output)

    level = load(path)
    trace = simulate(level, {"g": 1.7}, record=chosen(level, []), stepping=Stepping(rate=70))
    header, rows = table(output)
    assert outcome.status == 0
    assert rows == [list(row) for row in zip(trace.t, *trace.columns.values(), strict=True)]
    assert header == ["t [s]", *(f"{name} [{unit}]" for name, unit in trace.units.items())]


def test_unless_told_it_writes_what_the_checks_need_and_how_bodies_move(
    run: Run, write: Write, tmp_path: Path
) -> None:
    path = write(checks=[{**height("0"), "quantity": "ball.speed", "valid_if": "g < 0"}])

    run("simulate", path, "--output", tmp_path / "out.csv")

    assert table(tmp_path / "out.csv")[0] == [
        "t [s]", "ball.speed [m/s]", "ball.position.x [m]", "ball.position.y [m]",
        "ball.velocity.x [m/s]", "ball.velocity.y [m/s]",
    ]  # fmt: skip


def test_it_writes_only_what_is_asked_for_and_still_grades(
    run: Run, write: Write, tmp_path: Path
) -> None:
    records = ("--record", "system.energy", "--record", "t", "--record", "ball.speed")

    outcome = run("simulate", write(), *records, "--output", tmp_path / "out.csv")

    header = table(tmp_path / "out.csv")[0]
    assert header == ["t [s]", "system.energy [J]", "ball.speed [m/s]"]
    assert "ball.position.y" in outcome.out
    assert "passed" in outcome.out


def test_all_records_everything_once(run: Run, write: Write, tmp_path: Path) -> None:
    run("simulate", write(), "--record", "all", "--output", tmp_path / "out.csv")

    header = table(tmp_path / "out.csv")[0]
    assert {"t [s]", "ball.energy [J]", "floor.angle [rad]", "system.energy [J]"} <= set(header)
    assert len(header) == len(set(header))


def test_the_command_in_the_file_gives_the_same_file(
    run: Run, write: Write, tmp_path: Path
) -> None:
    first, second = tmp_path / "first.csv", tmp_path / "second.csv"
    options = ("--set", "g=3.3", "--duration", "0.35", "--rate", "97", "--record", "ball.speed")
    run("simulate", write("a level.json"), *options, "--output", first)
    text = first.read_text(encoding="utf-8")
    command = next(line for line in text.splitlines() if line.startswith("# again: "))
    python, dash_m, package, *arguments = shlex.split(command.removeprefix("# again: "))

    run(*arguments[:-1], second)

    assert (python, dash_m, package, arguments[-1]) == ("python", "-m", "sandbox", "FILE.csv")
    assert second.read_text(encoding="utf-8") == text


def test_a_scheme_and_its_sweeps_can_be_chosen_and_are_run_again_by_the_command_in_the_file(
    run: Run, tmp_path: Path
) -> None:
    first, second = tmp_path / "first.csv", tmp_path / "second.csv"
    options = ("--scheme", "fourth-order", "--iterations", 3, "--duration", 0.1)
    run("simulate", "energy/kepler-ellipse", *options, "--output", first)
    text = first.read_text(encoding="utf-8")
    command = next(line for line in text.splitlines() if line.startswith("# again: "))

    run(*shlex.split(command.removeprefix("# again: "))[3:-1], second)

    assert "# scheme: fourth-order\n# effects" in text.replace("# iterations: 3\n", "", 1)
    assert second.read_text(encoding="utf-8") == text


def test_a_scheme_that_is_not_for_the_level_is_said(run: Run, write: Write, tmp_path: Path) -> None:
    effects = {"gravity": {"acceleration": [0, "-g"]}, "drag": {"linear": 1}}

    options = ("--scheme", "fourth-order", "--output", tmp_path / "out.csv")
    outcome = run("simulate", write(effects=effects), *options)

    assert outcome.status == 1
    assert "a higher order needs smooth forces" in outcome.err


def test_it_says_that_a_pile_may_lean(run: Run, write: Write, tmp_path: Path) -> None:
    """Fifteen boxes, which no number of iterations settles at 60 Hz."""
    box = {"shape": {"type": "box", "width": 1, "height": 1}, "mass": 1, "friction": 0.6}
    line = {"type": "segment", "start": [-9, 0], "end": [9, 0]}
    boxes = {f"box{i}": {**box, "position": [0, i + 0.5]} for i in range(15)}
    effects = {
        "gravity": {"acceleration": [0, "-g"]},
        "contact": {"solver": "iterative"},
        "friction": {},
        "rotation": {},
    }
    bodies = {"floor": {"type": "static", "shape": line, "friction": 0.6}, **boxes}
    level = write(effects=effects, bodies=bodies, checks=[], ghosts={})

    outcome = run("simulate", level, "--output", tmp_path / "out.csv", "--duration", "0.1")

    assert outcome.out.splitlines()[-2].startswith("contacts: sweeps of the solver did not settle")


def test_it_says_what_may_have_passed_through_others(
    run: Run, write: Write, tmp_path: Path
) -> None:
    disc = {"shape": {"type": "disc", "radius": 0.02}, "mass": 0.01}
    bodies = {
        "bullet": {**disc, "position": [-3, 0], "velocity": [100, 0]},
        "target": {**disc, "position": [0, 0]},
    }
    effects = {"gravity": {"acceleration": [0, "-g"]}, "contact": {"solver": "iterative"}}
    level = write(effects=effects, bodies=bodies, checks=[], ghosts={})

    outcome = run("simulate", level, "--output", tmp_path / "out.csv", "--duration", "0.1")

    assert "contacts: the body 'bullet' moved further than its own width in a step" in outcome.out
    assert "2,501 Hz, miss none" in outcome.out


def test_it_says_steps_and_verdicts(run: Run, write: Write, tmp_path: Path) -> None:
    outcome = run("simulate", write(), "--output", tmp_path / "out.csv")

    first, header, verdict, energy = outcome.out.splitlines()
    assert "60 steps at 60 Hz to t = 1 s" in first
    assert header.split() == [
        "quantity", "measured", "expected", "error", "tolerance", "verdict",
    ]  # fmt: skip
    assert verdict.startswith("ball.position.y ")
    assert verdict.endswith("passed")
    assert re.fullmatch(r"energy: closes to \S+ of \S+ J turned over", energy)
    assert f"# {energy}" in (tmp_path / "out.csv").read_text(encoding="utf-8").splitlines()
    assert outcome.err == ""


@pytest.mark.parametrize(("check", "verdict"), [(WRONG, "failed"), (NEVER, "failed: never came")])
def test_a_check_that_fails_is_an_exit_status_of_1_and_a_whole_file(
    run: Run, write: Write, tmp_path: Path, check: dict[str, object], verdict: str
) -> None:
    outcome = run("simulate", write(checks=[height(), check]), "--output", tmp_path / "out.csv")

    assert outcome.status == 1
    assert outcome.out.splitlines()[-3].split("  ")[-1].strip() == "passed"
    assert verdict in outcome.out.splitlines()[-2]
    assert len(table(tmp_path / "out.csv")[1]) == 61


@pytest.mark.parametrize(("contact", "time"), [({}, "1.387"), ({"located": ["ball"]}, "1.384")])
def test_a_contact_in_the_last_step_is_not_said_never_to_have_come(
    run: Run, write: Write, tmp_path: Path, contact: dict[str, object], time: str
) -> None:
    """The ball hits the floor after 1.384 s, and the run ends with the step at 1.387 s."""
    effects = {"gravity": {"acceleration": [0, "-g"]}, "contact": contact}
    check = height(at={"event": "contact", "bodies": ["ball", "floor"]})
    path = write(effects=effects, checks=[check], duration=1.385, stepping={"rate": 300})

    outcome = run("simulate", path, "--output", tmp_path / "out.csv")

    assert outcome.status == 1
    assert f"failed: came at {time} s, too near the end to be measured" in outcome.out


def test_a_longer_run_is_graded_up_to_the_levels_duration(
    run: Run, write: Write, tmp_path: Path
) -> None:
    """The ball's formula is wrong after 1.2 s, which only the longer run reaches."""
    path = write(checks=[height("10 - g*t**2/2 + where(t < 1.2, 0, 1)")])

    outcome = run("simulate", path, "--duration", 2, "--output", tmp_path / "out.csv")

    assert outcome.status == 0
    assert len(table(tmp_path / "out.csv")[1]) == 121


def test_a_shorter_run_is_graded_as_far_as_it_goes(run: Run, write: Write, tmp_path: Path) -> None:
    path = write(checks=[height(), NEVER])

    outcome = run("simulate", path, "--duration", 0.5, "--output", tmp_path / "out.csv")

    assert outcome.status == 0
    assert "not reached" in outcome.out
    assert "shorter than the level's 1 s" in outcome.out


def test_a_level_without_checks_says_so(run: Run, write: Write, tmp_path: Path) -> None:
    outcome = run("simulate", write(checks=[]), "--output", tmp_path / "out.csv")

    assert outcome.status == 0
    assert "no checks" in outcome.out


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--set", "q=1"], "unknown parameter 'q'"),
        (["--set", "g=26"], "must lie between 0 and 25 m/s²"),
        (["--set", "g=nan"], "not a finite number"),
        (["--set", "g"], "must be NAME=VALUE"),
        (["--set", "=3"], "must be NAME=VALUE"),
        (["--set", "g=1,5"], "a decimal point is written ., not a comma"),
        (["--set", "g=fast"], "'fast' is not a number"),
        (["--set", "g=1", "--set", "g=2"], "'g' is set twice"),
        (["--duration", "0"], "--duration 0: must be a finite number greater than 0"),
        (["--duration", "inf"], "--duration inf: must be"),
        (["--duration", "1e12"], "--duration 1e+12: that takes 6e+13 steps at 60 Hz; 10,000,000"),
        (["--rate", "nan"], "--rate nan: must be a number"),
        (["--accuracy", "2"], "--accuracy 2: must be less than 1"),
        (["--rate", "0.5"], "--rate 0.5: must be at least 1"),
        (["--rate", "1e6"], "--rate 1e+06: must be at most 100000"),
        (["--rate", "nan"], "--rate nan: must be"),
        (["--rate", "often"], "--rate"),
        (["--scheme", "fourth"], "--scheme fourth: must be 'leapfrog', 'fourth-order', "),
        (["--iterations", "0"], "--iterations 0: must be at least 1"),
        (["--record", "ball.sped"], "did you mean 'ball.speed'?"),
        (["--record", "bowl.speed"], "'bowl.speed' is not a quantity of this level"),
        (["--slowly"], "--slowly"),
    ],
)
def test_wrong_usage_is_said_and_writes_nothing(
    run: Run, write: Write, tmp_path: Path, options: list[str], message: str
) -> None:
    output = tmp_path / "out.csv"

    outcome = run("simulate", write(), "--output", output, *options)

    assert outcome.status == 2
    assert message in outcome.err
    assert outcome.out == ""
    assert not output.exists()


@pytest.mark.parametrize(
    ("name", "message"),
    [("missing/out.csv", "there is no folder"), (".", "folder"), ("fall.json/x", "not a folder")],
)
def test_an_output_that_cannot_be_is_refused_before_the_run(
    run: Run, write: Write, tmp_path: Path, name: str, message: str
) -> None:
    outcome = run("simulate", write(), "--output", tmp_path / name)

    assert outcome.status == 2
    assert outcome.err.startswith(f"cannot write {tmp_path / name}: ")
    assert message in outcome.err


def test_a_bad_level_fails_with_its_mistakes(run: Run, write: Write, tmp_path: Path) -> None:
    path = write(effects={"gravty": {}})

    outcome = run("simulate", path, "--output", tmp_path / "out.csv")

    assert outcome.status == 1
    assert f"{path}:1:" in outcome.err
    assert "did you mean 'gravity'?" in outcome.err
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.usefixtures("boundless")
def test_a_run_that_has_to_stop_writes_nothing(run: Run, write: Write, tmp_path: Path) -> None:
    bodies = {"ball": {"shape": {"type": "disc", "radius": 1}, "mass": 1, "velocity": [1e153, 0]}}
    path = write(bodies=bodies, checks=[], duration=1e5)

    outcome = run("simulate", path, "--rate", 1, "--output", tmp_path / "out.csv")

    assert outcome.status == 1
    assert outcome.err.startswith("stopped at t = ")
    assert list(tmp_path.iterdir()) == [path]


def test_what_cannot_be_recorded_is_refused_beside_everything(
    run: Run, write: Write, tmp_path: Path
) -> None:
    output = tmp_path / "out.csv"

    outcome = run("simulate", write(), "--record", "all", "--record", "bogus", "--output", output)

    assert outcome.status == 2
    assert "'bogus' is not a quantity of this level" in outcome.err
    assert not output.exists()
