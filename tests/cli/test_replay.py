"""`replay`: a saved run is repeated."""

from pathlib import Path

from sandbox.app.runs import run_file
from tests.app.scenes import opened
from tests.cli.helpers import Run


def test_says_whether_a_run_is_the_same(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "run.json"
    run_file.save(run_file.run_of(opened("newton/atwood", 40)), path)

    outcome = run("replay", str(path))

    assert outcome.status == 0
    assert "Atwood machine: 40 steps to t = 0.666667 s: the same to the last bit" in outcome.out
    assert "checks passed: 3 of 3" in outcome.out


def test_one_bit_is_told(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "run.json"
    saved = run_file.run_of(opened("newton/atwood", 40))
    least = {**saved.parameters, "m1": saved.parameters["m1"] * (1 + 2**-52)}
    run_file.save(saved.model_copy(update={"parameters": least}), path)

    outcome = run("replay", str(path))

    assert outcome.status == 1
    assert "final state differs" in outcome.out


def test_a_file_that_is_none_is_wrong_usage(run: Run, tmp_path: Path) -> None:
    outcome = run("replay", str(tmp_path / "nothing.json"))

    assert outcome.status == 2
    assert "there is no such file" in outcome.err
