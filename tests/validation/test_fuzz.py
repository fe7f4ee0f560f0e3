"""Odd levels are made and tried, and kept if they are not answered."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from itertools import groupby, islice, takewhile
from multiprocessing import Pipe
from pathlib import Path
from random import Random
from typing import Any, get_args

import pytest
from typer.testing import CliRunner

from sandbox.model.effects import Effects
from sandbox.model.errors import SandboxError
from sandbox.model.joints import Joint
from sandbox.model.shorthand.repeated_members import REPEAT
from sandbox.model.write_json_schema import schema
from tests.elsewhere import python
from tests.model.levels import bare, hanging
from validation.cli import app
from validation.fuzz import command, isolated_trial
from validation.fuzz.atheris_process import Choices
from validation.fuzz.command import Findings, made, shrunk
from validation.fuzz.coverage_guided_levels import guided
from validation.fuzz.isolated_trial import (
    ENDED,
    NO_ANSWER,
    REFUSED,
    RUNS,
    SLOW,
    STOPPED,
    UNTOLD,
    Outcome,
    Trial,
    Tried,
    attempt,
)
from validation.fuzz.mutated_levels import places
from validation.fuzz.refused_level_repair import mended
from validation.fuzz.schema_grammar import Grammar

JOINTS = [kind.model_fields["type"].annotation for kind in get_args(get_args(Joint)[0])]


def levels(count: int) -> Iterator[dict[str, Any]]:
    return (made(5, number) for number in range(0, 2 * count, 2))


def test_every_effect_and_joint_that_the_schema_declares_is_tried() -> None:
    effects: set[str] = set()
    joints: set[str] = set()
    for level in levels(120):
        effects |= level.get("effects", {}).keys()
        joints |= {str(joint.get("type")) for joint in level.get("joints", {}).values()}

    assert effects >= Effects.model_fields.keys()
    assert joints >= {name for kind in JOINTS for name in get_args(kind)}


def test_every_part_of_a_level_is_tried() -> None:
    drawn = list(levels(240))
    events = [event for level in drawn for event in level.get("events", {}).values()]

    assert set().union(*drawn) == schema()["properties"].keys() - {"$schema"}
    assert {"j1", "j2"} <= {joint for event in events for joint in event.get("cut", ())}
    assert Effects.model_fields.keys() & {name for event in events for name in event.get("off", ())}


def test_formulas_are_tried_over_each_of_their_variables() -> None:
    """Of fields only x was drawn, and of torques only t."""
    effects = [level.get("effects", {}) for level in levels(240)]
    fields = str([effect.get("field") for effect in effects])
    torques = str([effect.get("torque") for effect in effects])

    assert {"x", "y", "vx", "vy", "t"} <= set(re.findall(r"[a-z]+", fields))
    assert {"theta", "omega", "t"} <= set(re.findall(r"[a-z]+", torques))


def test_shorthand_is_tried() -> None:
    holders = [holder for level in levels(120) for holder, key in places(level) if key == REPEAT]
    copies = [copy for level in levels(120) for copy in level["bodies"].values() if "copy" in copy]

    assert any("each" in holder for holder in holders), "members that are not objects"
    assert any("type" in holder for holder in holders), "joints or shapes"
    assert {"g"} == {copy["copy"] for copy in copies}


def test_the_same_number_is_the_same_level() -> None:
    first = [json.dumps(made(1, number)) for number in range(80)]

    assert first == [json.dumps(made(1, number)) for number in range(80)]
    assert made(1, 0) != made(2, 0)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        (json.dumps(bare()), RUNS),
        ("{", REFUSED),
        (json.dumps(bare() | {"bodies": {}}), REFUSED),
        (json.dumps(hanging() | {"stepping": {"accuracy": 1e-3}}), RUNS),
    ],
)
def test_a_level_runs_or_is_refused(text: str, kind: str) -> None:
    assert attempt(text).kind == kind


@pytest.mark.parametrize("name", ["parse", "build"])
def test_what_is_raised_but_by_us_is_no_answer(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError("complex division by zero")

    monkeypatch.setattr(isolated_trial, name, fail)

    outcome = attempt(json.dumps(bare()))

    assert (outcome.kind, outcome.passed) == (UNTOLD, False)
    assert "complex division by zero" in outcome.what


@pytest.mark.sweep
def test_a_process_that_ends_is_told_and_another_begins() -> None:
    tried = Trial()
    assert tried.run(json.dumps(bare())).kind == RUNS
    assert tried._process is not None
    tried._process.kill()

    assert tried.run(json.dumps(bare())).kind == ENDED
    assert tried.run("{}").kind == REFUSED
    tried.close()


@pytest.mark.sweep
def test_the_time_to_import_libraries_is_not_part_of_an_answer() -> None:
    code = (
        "import sys\n"
        "from sandbox.model import catalog\n"
        "from validation.fuzz import isolated_trial\n"
        "isolated_trial.load_libraries()\n"
        "before = set(sys.modules)\n"
        "isolated_trial.attempt(catalog.find('machines/trebuchet').read_text())\n"
        "isolated_trial.attempt(catalog.find('momentum/cradle').read_text())\n"
        "print(*(set(sys.modules) - before))"
    )

    done = python("-c", code)

    libraries = [name for name in done.stdout.split() if not name.startswith("sandbox.")]
    assert libraries == []


@pytest.mark.sweep
@pytest.mark.skipif(os.name == "nt", reason="computing is not limited there, only time")
def test_what_takes_too_long_is_told() -> None:
    """Half a second of computing is many ticks of any system's clock."""
    ball = bare()["bodies"]["ball"]
    crowd = {f"ball {number}": ball for number in range(3000)}
    tried = Trial(seconds=0.01)

    assert tried.run(json.dumps(bare() | {"bodies": crowd})).kind == SLOW
    tried.close()


def test_what_gets_no_time_to_compute_is_asked_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 32,973 levels, tried beside 29 other processes, 8 were reported as slow."""
    answers = [NO_ANSWER, Outcome(RUNS), NO_ANSWER, NO_ANSWER]
    monkeypatch.setattr(Trial, "_ask", lambda *_: answers.pop(0))

    assert Trial().run("{}") == Outcome(RUNS)
    assert Trial().run("{}") == NO_ANSWER


STAND_IN = """
import os, sys, contextlib
from pathlib import Path

@contextlib.contextmanager
def instrument_imports(include):
    assert "sandbox.model.loading" not in sys.modules
    yield

def Setup(arguments, explore):
    global inputs, one
    inputs, one = sorted(Path(arguments[-1]).iterdir()), explore

def Fuzz():
    for each in inputs[:int(os.environ["INPUTS"])]:
        one(each.read_bytes())
    os._exit(1)
"""
"""What stands in for Atheris, which is not installed everywhere: it tries inputs, and ends."""


@pytest.fixture
def led(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[int], Generator[Tried]]:
    """Return the results for levels if each process tries a number of inputs."""
    (tmp_path / "atheris.py").write_text(STAND_IN, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)

    def begin(inputs: int) -> Generator[Tried]:
        monkeypatch.setenv("INPUTS", str(inputs))
        return guided(7, Trial())

    return begin


@pytest.mark.sweep
@pytest.mark.skipif(os.name == "nt", reason="Atheris is not made for it")
def test_atheris_is_told_what_comes_of_the_levels_it_makes(
    led: Callable[[int], Generator[Tried]],
) -> None:
    """Three inputs per process: the next continues their numbers, and mended levels keep theirs."""
    with closing(led(3)) as source:
        found = list(takewhile(lambda tried: tried.number < 7, source))

    assert [number for number, _ in groupby(found, lambda tried: tried.number)] == list(range(7))
    for _, data, outcome in found:
        assert attempt(json.dumps(data)) == outcome


@pytest.mark.sweep
@pytest.mark.skipif(os.name == "nt", reason="Atheris is not made for it")
def test_atheris_that_tries_nothing_is_told(led: Callable[[int], Generator[Tried]]) -> None:
    with pytest.raises(SandboxError, match="Atheris ended before it tried a level"):
        next(led(0))


@pytest.mark.sweep
def test_atheris_leaves_no_file_behind_if_whoever_asked_it_is_killed(tmp_path: Path) -> None:
    """It left its last input in the working folder, as a crash."""
    pytest.importorskip("atheris")
    (tmp_path / "inputs").mkdir()
    ours, theirs = Pipe()
    options = (str(theirs.fileno()), "1", str(tmp_path / "inputs"))
    with subprocess.Popen(
        [sys.executable, "-m", "validation.fuzz.atheris_process", *options],
        pass_fds=[theirs.fileno()], cwd=tmp_path, env={**os.environ, "PYTHONPATH": os.getcwd()},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    ):  # fmt: skip
        theirs.close()
        assert ours.poll(60)
        ours.close()

    assert [path.name for path in tmp_path.iterdir()] == ["inputs"]


def test_what_atheris_finds_counts_if_the_level_fails_by_itself(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A process may end, be slow because of its counting, or have had enough of many levels."""
    seen = [(0, "{}", Outcome(RUNS)), (0, "[1]", Outcome(SLOW)), (1, "[2]", None)]
    monkeypatch.setattr("validation.fuzz.coverage_guided_levels._explored", lambda *_: iter(seen))
    monkeypatch.setattr(Trial, "run", lambda _, text: Outcome(ENDED if "2" in text else RUNS))

    found = list(islice(guided(1, Trial()), 4))

    assert [(number, outcome.kind) for number, _, outcome in found] == [
        (0, RUNS), (0, RUNS), (1, ENDED), (2, RUNS),
    ]  # fmt: skip


def test_inputs_are_choices() -> None:
    """Equal bytes give equal levels, and once they are used up each choice is the first."""
    data, others = (Random(seed).randbytes(2000) for seed in (1, 2))
    assert Grammar(Choices(data)).level() == Grammar(Choices(data)).level()
    assert Grammar(Choices(data)).level() != Grammar(Choices(others)).level()
    assert Choices(b"").choice("abc") == "a"
    assert 0 <= Choices(b"\xff" * 4).random() < 1


@pytest.mark.parametrize("ended", [KeyboardInterrupt, SystemExit])
def test_what_was_found_is_told_if_somebody_interrupts_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ended: type[BaseException]
) -> None:
    def some(*_: object) -> Generator[Tried]:
        yield Tried(0, {}, Outcome(RUNS))
        yield Tried(1, {}, Outcome(STOPPED))
        raise ended

    monkeypatch.setattr(command, "available", lambda: False)
    monkeypatch.setattr(command, "drawn", some)
    file = tmp_path / "out.json"

    with pytest.raises(ended):
        command.fuzz(None, 1, None, file, tmp_path)

    assert json.loads(file.read_text(encoding="utf-8"))["answers"] == {RUNS: 1, STOPPED: 1}


def test_what_is_wrong_is_taken_away() -> None:
    data = bare()
    data["bodies"]["ball"] |= {"radius": 3, "mass": -1}
    outcome = attempt(json.dumps(data))
    assert outcome.kind == REFUSED

    for _ in range(3):
        data = mended(data, attempt(json.dumps(data)).mistakes)

    assert attempt(json.dumps(data)).kind in (RUNS, STOPPED)


def test_what_goes_wrong_is_made_small() -> None:
    least = shrunk(hanging(), lambda level: "string" in level.get("joints", {}))

    assert least == {"joints": {"string": {}}}


def test_what_goes_wrong_is_kept(tmp_path: Path) -> None:
    class Wrong(Trial):
        def run(self, text: str) -> Outcome:
            return Outcome(ENDED, "with -6") if "bodies" in json.loads(text) else Outcome(RUNS)

    found = Findings()
    data = made(1, 0)
    command._note(Tried(0, data, Outcome(ENDED, "with -6")), Wrong(), found, tmp_path)

    [sample] = tmp_path.iterdir()
    assert json.loads(sample.read_text(encoding="utf-8")) == {"bodies": {}}
    assert found.failures == [{"number": 0, "what": "ended: with -6", "sample": str(sample)}]


def test_without_a_place_for_samples_nothing_is_tried_and_nothing_written(tmp_path: Path) -> None:
    """The figures of no level were written."""
    file, taken = tmp_path / "out.json", tmp_path / "taken"
    taken.touch()

    done = CliRunner().invoke(
        app, ["fuzz", "--count", "4", "--json", str(file), "--samples", str(taken / "samples")]
    )

    assert done.exit_code == 2
    assert str(taken / "samples") in done.output.replace("\n", "")
    assert not file.exists()


@pytest.mark.sweep
def test_the_figures_are_written(tmp_path: Path) -> None:
    file = tmp_path / "out.json"

    done = CliRunner().invoke(
        app,
        ["fuzz", "--count", "4", "--seed", "1", "--json", str(file), "--samples", str(tmp_path)],
    )

    assert done.exit_code == 0
    said = json.loads(file.read_text(encoding="utf-8"))
    assert {
        "environment",
        "seed",
        "guided",
        "count",
        "seconds",
        "answers",
        "failures",
        "passed",
    } == said.keys()
    assert said["count"] >= 4
    assert said["failures"] == []
