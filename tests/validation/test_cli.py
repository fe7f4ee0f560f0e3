"""`python -m validation run`: its table, its JSON, its exit status."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from tests.cli.helpers import fall
from validation import case_suite, cli, output
from validation.case import Case, Outcome, run
from validation.case_loading import read

FIELDS = {
    "name", "level", "parameters", "quantity", "unit", "measured", "expected", "error",
    "tolerance", "because", "passed", "naive_error", "step_seconds", "naive_step_seconds", "order",
}  # fmt: skip


def few() -> Iterator[Case]:
    yield read("free_fall")[0]
    yield read("atwood")[0]


@pytest.fixture(autouse=True)
def _few_cases(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "all_cases", few)


def test_the_json_has_the_fields_that_scripts_rely_on(tmp_path: Path) -> None:
    file = tmp_path / "out.json"

    result = CliRunner().invoke(cli.app, ["run", "--json", str(file)])

    assert result.exit_code == 0
    content = json.loads(file.read_text(encoding="utf-8"))
    assert content.keys() == {"environment", "cases"}
    assert {"python", "pymunk", "numpy", "platform"} <= content["environment"].keys()
    assert [case.keys() for case in content["cases"]] == [FIELDS, FIELDS]
    assert all(case["passed"] for case in content["cases"])


def test_the_table_shows_errors_side_by_side() -> None:
    result = CliRunner().invoke(cli.app, ["run"])

    assert "naive error" in result.stdout
    assert "2 of 2 cases hold." in result.stdout


def test_the_cases_of_one_level_can_be_run_alone() -> None:
    result = CliRunner().invoke(cli.app, ["run", "free-fall"])

    assert "1 of 1 cases hold." in result.stdout
    assert "Atwood" not in result.stdout


def test_a_level_that_does_not_exist_is_told_with_what_was_meant() -> None:
    result = CliRunner().invoke(cli.app, ["run", "fre-fall"])

    assert result.exit_code == 1
    assert "free-fall" in result.output


def test_a_level_that_no_case_is_about_is_told(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(fall()), encoding="utf-8")

    result = CliRunner().invoke(cli.app, ["run", str(path), "kinematics/free-fall"])

    assert result.exit_code == 2
    assert "no case is about this level" in result.output


def test_a_missed_bound_is_exit_status_1(monkeypatch: pytest.MonkeyPatch) -> None:
    def wrong() -> Iterator[Case]:
        case = read("free_fall")[0]
        yield Case(
            name="wrong",
            level=case.level,
            quantity=case.quantity,
            expected=lambda _, __: 1.0,
            tolerance=1e-3,
            because="it cannot hold",
        )

    monkeypatch.setattr(cli, "all_cases", wrong)

    result = CliRunner().invoke(cli.app, ["run"])

    assert result.exit_code == 1
    assert "failed: wrong" in result.stderr


def test_a_folder_that_is_not_there_is_wrong_usage(tmp_path: Path) -> None:
    result = CliRunner().invoke(cli.app, ["run", "--json", str(tmp_path / "no" / "out.json")])

    assert result.exit_code == 2
    assert "Traceback" not in result.output


def test_an_event_that_never_came_is_null_in_the_json() -> None:
    outcome = next(run([read("free_fall")[0]]))
    text = json.dumps(
        output.content(cases=[replace(outcome, measured=float("nan"))]), allow_nan=False
    )

    assert json.loads(text)["cases"][0]["measured"] is None


@pytest.mark.sweep
def test_processes_that_share_the_cases_find_what_one_finds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In the same order; only the costs of steps are measured again."""
    cases = list(few())[::-1]
    alone = case_suite.outcomes(cases, jobs=1)
    monkeypatch.setattr(case_suite, "WORTH", 1)

    shared = case_suite.outcomes(cases, jobs=2)

    assert [o.level for o in shared] == [case.level for case in cases]
    assert list(map(untimed, shared)) == list(map(untimed, alone))


def untimed(outcome: Outcome) -> Outcome:
    return replace(outcome, step_seconds=0.0, naive_step_seconds=0.0)


@pytest.mark.parametrize(
    "asked", [["run"], ["compose", "--count", "1"], ["pace", "kinematics/free-fall"]]
)
def test_a_file_that_cannot_be_written_is_refused_before_anything_is_measured(
    asked: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(output, "written", pytest.fail)

    result = CliRunner().invoke(cli.app, [*asked, "--json", str(tmp_path / "missing" / "x.json")])

    assert result.exit_code == 2
    assert "there is no folder" in result.stderr
