"""Effects are switched off and on from the command line, with their results told and drawn."""

import shlex
from pathlib import Path

import pytest

from tests.cli.helpers import Run, Write, height

DRAG = {"gravity": {"acceleration": [0, "-g"]}, "drag": {"linear": 0.5}}


def test_a_run_without_an_effect_is_told_in_the_levels_own_quantities(
    run: Run, write: Write, tmp_path: Path
) -> None:
    outcome = run("simulate", write(), "--with", "drag.linear=0.5", "--output", tmp_path / "x.csv")

    # with k = c/m: y = 10 − g (t/k − (1 − exp(−k t))/k²), 5.8197 after 1 s
    first, header, row, summary, _energy = outcome.out.splitlines()
    assert outcome.status == 0
    assert "fall.json with drag (linear 0.5), 60 steps" in first
    assert header.split("  ")[0] == "quantity"
    assert row.split()[:5] == ["ball.position.y", "5.095", "m", "5.81966", "m"]
    assert row.endswith("+7.25 %")
    assert summary.startswith("with drag (linear 0.5): ball.position.y +7.25 %; +")
    assert summary.endswith(" ms a step")


def test_an_effect_that_the_scheme_rules_out_is_possible_with_another(
    run: Run, tmp_path: Path
) -> None:
    first, second = tmp_path / "1.csv", tmp_path / "2.csv"
    options = ("energy/precession", "--with", "drag.linear=0.1", "--duration", 0.1)

    refused = run("simulate", *options, "--output", first)
    taken = run("simulate", *options, "--scheme", "leapfrog", "--output", first)
    text = first.read_text(encoding="utf-8")
    again = next(line for line in text.splitlines() if line.startswith("# again: "))
    run(*shlex.split(again.removeprefix("# again: "))[3:-1], second)

    assert (refused.status, taken.status) == (2, 0)
    assert "rules out the effect 'drag'; choose 'leapfrog'" in refused.err
    assert second.read_text(encoding="utf-8") == text


def test_the_file_names_the_change_and_how_to_get_it_again(
    run: Run, write: Write, tmp_path: Path
) -> None:
    path, first, second = write(effects=DRAG), tmp_path / "1.csv", tmp_path / "2.csv"
    run("simulate", path, "--without", "drag", "--output", first)
    text = first.read_text(encoding="utf-8")
    again = next(line for line in text.splitlines() if line.startswith("# again: "))
    command = shlex.split(again.removeprefix("# again: "))
    run(*command[3:-1], second)
    run("simulate", path, "--output", tmp_path / "3.csv")
    plain = (tmp_path / "3.csv").read_text(encoding="utf-8")

    assert "# change: without drag\n" in text
    assert "# effects: gravity\n" in text
    assert second.read_text(encoding="utf-8") == text
    assert "# change" not in plain
    assert next(line for line in plain.splitlines() if "hash" in line) in text  # the file's own


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--without", "drag"], "the level declares no effect 'drag'; known: gravity"),
        (["--with", "darg"], "unknown effect 'darg'; did you mean 'drag'?"),
        (["--with", "drag=1"], "must be EFFECT or EFFECT.SETTING=VALUE"),
        (["--with", "drag."], "must be EFFECT or EFFECT.SETTING=VALUE"),
        (["--with", "drag.linear=1", "--with", "drag.linear=2"], "'drag.linear' is set twice"),
        (["--without", "gravity", "--with", "gravity"], "is asked for by --with, too"),
    ],
)
@pytest.mark.parametrize("command", ["simulate", "render"])
def test_what_cannot_be_meant_is_wrong_usage(
    run: Run, write: Write, tmp_path: Path, command: str, options: list[str], message: str
) -> None:
    path, output = write(), tmp_path / ("x.png" if command == "render" else "x.csv")

    outcome = run(command, path, *options, "--output", output)

    assert outcome.status == 2
    assert message in outcome.err
    assert list(tmp_path.iterdir()) == [path]


def test_two_runs_are_drawn_over_each_other(run: Run, write: Write, tmp_path: Path) -> None:
    path, alone, both = write(effects=DRAG), tmp_path / "1.png", tmp_path / "2.png"
    run("render", path, "--output", alone)

    outcome = run("render", path, "--without", "drag", "--output", both)

    assert outcome.out == f"{both}: {path} without drag\n"
    assert alone.read_bytes() != both.read_bytes()


def test_effects_are_ranked_by_what_they_change(run: Run, write: Write) -> None:
    outcome = run("effects", write(effects={**DRAG, "drag": {"linear": 1e-3}}))

    header, first, second = outcome.out.splitlines()
    assert outcome.status == 0
    assert header.split()[0] == "effect"
    assert first.split()[:2] == ["gravity", "ball.position.y"]
    assert second.split()[0] == "drag"
    assert second.endswith("ms a step")


def test_an_effect_that_changes_nothing_is_named(run: Run, write: Write) -> None:
    """The ball never comes near the floor."""
    gravity = {"acceleration": [0, "-g"]}
    outcome = run("effects", write(effects={"gravity": gravity, "contact": {}}))

    assert outcome.out.splitlines()[-1] == "'contact' is declared but changes nothing here"


@pytest.mark.sweep
def test_an_effect_that_a_level_cannot_run_without_is_told_so(run: Run) -> None:
    outcome = run("effects", "newton/table-and-pulley-with-friction")

    assert outcome.status == 0
    assert "contact   the level cannot run without it\n" in outcome.out
    assert "without contact there is no friction either\n" in outcome.out
    assert "without friction: stopped at t = " in outcome.out
    assert outcome.err == ""


def test_a_level_without_effects_says_so(run: Run, write: Write) -> None:
    path = write(effects={}, parameters={}, checks=[height("10")])

    assert run("effects", path).out == f"{path} declares no effect\n"


def test_a_level_of_many_bodies_is_written_and_runs(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "gas.json"

    made = run("generate", "gas", "--bodies", 9, "--output", path)
    ran = run("simulate", path, "--duration", 1, "--output", tmp_path / "gas.csv")

    assert made.out.startswith(f"{path}: A gas of 9 discs")
    assert ran.status == 0
    assert "system.energy" in ran.out


@pytest.mark.sweep
def test_no_level_of_no_bodies_is_written(run: Run, tmp_path: Path) -> None:
    outcome = run("generate", "gas", "--bodies", 0, "--output", tmp_path / "gas.json")

    assert outcome.status == 2
    assert "must have between 1 and" in outcome.err
    assert not list(tmp_path.iterdir())
