"""The command that composes random scenes."""

import json
from collections.abc import Callable
from math import hypot, inf
from pathlib import Path

import pytest
from typer.testing import CliRunner

from sandbox.model.loading import load
from tests.validation.test_random_compositions import FIELDS, of, recorded
from validation import cli
from validation.random_compositions import command
from validation.random_compositions.command import Outcome, complaints, judged
from validation.random_compositions.invariants import Case, Judgement
from validation.random_compositions.seeded_scenes import scene, seeds


def outcome_of(seed: int, *, passed: bool) -> Outcome:
    judgement = Judgement("joints", 0.0 if passed else inf, 1e-9, passed)
    return Outcome(seed, "table", 4, 2, (judgement,), passed, False, "", 60.0, 0.1)


def judged_by_parity(seed: int) -> Outcome:
    return outcome_of(seed, passed=seed % 2 == 0)


def test_the_command_writes_what_failed_as_json_and_as_levels(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("validation.output.spread", _in_turn)
    monkeypatch.setattr("validation.random_compositions.command.judged", judged_by_parity)
    file, folder = tmp_path / "found.json", tmp_path / "levels"
    args = ["compose", "--scene", "2", "--scene", "3", "--json", str(file), "--output", str(folder)]

    result = CliRunner().invoke(cli.app, args)

    assert result.exit_code == 1
    found = json.loads(file.read_text(encoding="utf-8"))
    assert set(found) == {"environment", "scenes"}
    assert set(found["scenes"][0]) >= FIELDS
    assert [s["passed"] for s in found["scenes"]] == [True, False]
    told = found["scenes"][1]["judgements"]
    assert told == [{"name": "joints", "figure": None, "bound": 1e-9, "passed": False}]
    (level,) = folder.iterdir()
    assert load(level).summary.startswith("joints inf")


def _in_turn(work: Callable[[int], Outcome], items: list[int], jobs: int | None) -> object:
    assert jobs is None  # one for each core
    return enumerate(map(work, items))


def test_of_many_scenes_that_fail_only_the_first_are_named() -> None:
    told = list(complaints([outcome_of(seed, passed=False) for seed in range(30)]))

    assert len(told) == 21
    assert told[-1] == "and 10 more"


@pytest.mark.sweep
def test_a_scene_is_judged_by_its_seed_alone() -> None:
    seed = next(s for s in seeds(0, 200) if scene(s).family == "machine")
    first, second = judged(seed), judged(seed)

    assert first.judgements == second.judgements
    assert command.playable(first)["stepping"]["rate"] == first.rate


def test_a_case_knows_how_far_its_bodies_reach() -> None:
    box = of("wedged").document["bodies"]["box"]["shape"]

    assert Case(recorded("wedged")).extents[1] == pytest.approx(
        hypot(box["width"], box["height"]) / 2
    )
