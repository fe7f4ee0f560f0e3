"""`replay`: a saved run is repeated."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

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


ODD: Mapping[str, Callable[[Path], object]] = {
    "is not an ordinary file": os.mkfifo if hasattr(os, "mkfifo") else Path.touch,
    "is a folder, not a file": Path.mkdir,
    "is a link to a file that does not exist": lambda path: path.symlink_to("nowhere"),
}


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
@pytest.mark.parametrize("told", ODD)
def test_what_is_no_file_is_not_said_to_be_absent(run: Run, tmp_path: Path, told: str) -> None:
    ODD[told](path := tmp_path / "odd.run.json")

    outcome = run("replay", str(path))

    assert outcome.status == 1
    assert outcome.err == f"{path}: {told}\n"


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_link_to_a_run_is_followed(run: Run, tmp_path: Path) -> None:
    run_file.save(run_file.run_of(opened("newton/atwood", 40)), tmp_path / "run.json")
    (tmp_path / "link.json").symlink_to("run.json")

    assert run("replay", str(tmp_path / "link.json")).status == 0
