"""The tables of cases are read, and their mistakes are reported with their place."""

import tomllib
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from sandbox.model.level import ContactEvent
from validation import case_loading, cases, cli
from validation.case import Case
from validation.case_loading import ClosedForm, Formula, TableError
from validation.cases import PHENOMENA

TABLE = """
[[table]]
level = "kinematics/complementary-angles"
over = [{}, {angle = 10.0}, {ends = ["g"]}]
each = [{ball = "low", times = 1}, {ball = "high", times = 2}]
because = "it is made up"
tolerance = 1e-6

[[table.case]]
name = "range of the {ball} ball"
quantity = "{ball}.position.x"
formula = "{times} * kinematics.projectile_distance(speed, radians(angle), t)"
at = {event = "contact", bodies = ["{ball}", "sand"]}
order = 2
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of tables that has not been read yet."""
    monkeypatch.setattr(case_loading, "FOLDER", tmp_path)
    monkeypatch.setattr(case_loading, "read", case_loading.read.__wrapped__)
    return tmp_path


def written(folder: Path, text: str) -> tuple[Case, ...]:
    (folder / "made_up.toml").write_text(text, encoding="utf-8")
    return case_loading.read("made_up")


def test_every_file_of_tables_is_registered() -> None:
    files = {path.stem for path in Path(cases.__file__).parent.glob("*.toml")}

    forgotten = files ^ set(PHENOMENA)
    assert not forgotten, f"name {forgotten} in PHENOMENA, validation/cases/__init__.py"


@pytest.mark.parametrize("phenomenon", PHENOMENA)
def test_some_formula_uses_every_definition(phenomenon: str) -> None:
    said = tomllib.loads((case_loading.FOLDER / f"{phenomenon}.toml").read_text(encoding="utf-8"))
    used = {name for case in case_loading.read(phenomenon) for name in defined(case)}

    assert used == said.get("let", {}).keys()


def defined(case: Case) -> Mapping[str, Formula]:
    assert isinstance(case.expected, ClosedForm)
    return case.expected.defined


def test_a_row_is_a_case_for_each_choice_of_parameters_and_each_item(folder: Path) -> None:
    found = written(folder, TABLE)

    assert [case.name.split()[3] for case in found] == ["low", "high"] * 4
    assert [case.parameters for case in found[:4:2]] == [{}, {"angle": 10.0}]
    assert found[4].parameters["g"] > found[6].parameters["g"]
    assert found[1].at == ContactEvent(event="contact", bodies=("high", "sand"))
    assert {case.because for case in found} == {"it is made up"}


def test_a_formula_is_that_of_the_parameters_and_of_the_times(folder: Path) -> None:
    low, high, *_ = written(folder, TABLE)

    t = np.array([0.0, 2.0])
    values = {"speed": 3.0, "angle": 60.0}
    assert low.expected(values, t) == pytest.approx([0.0, 3.0])
    assert high.expected(values, t) == pytest.approx([0.0, 6.0])


def test_a_definition_is_a_number_of_the_case_or_a_function_and_may_use_others(
    folder: Path,
) -> None:
    let = """
[let]
slow = "speed / 2"
unused = "mass_of_another_level"
ways = "lambda times: times * kinematics.projectile_distance(slow, radians(angle), t)"
"""
    formula = '"{times} * kinematics.projectile_distance(speed, radians(angle), t)"'
    low, high, *_ = written(folder, let + TABLE.replace(formula, '"ways({times})"'))

    values = {"speed": 6.0, "angle": 60.0}
    assert list(defined(low)) == ["slow", "ways"]
    assert high.expected(values, np.array([0.0, 2.0])) == pytest.approx([0.0, 6.0])


@pytest.mark.parametrize(
    ("said", "instead", "told"),
    [
        ("\n[[table]]", "\n[let]\nspeed = '2'\n[[table]]", "also the name of a parameter: speed"),
        ("speed,", "fast,", "formula has an unknown name: fast"),
        ("formula = ", "formla = ", "'range of the low ball' lacks formula"),
        ("order = 2", "ordr = 2", "'range of the low ball': unknown key: ordr"),
        ("over = ", "ovr = ", "unknown key in a table: ovr"),
        ("level = ", "# ", "a table needs a level"),
        ("-angles", "-angels", "did you mean 'kinematics/complementary-angles'"),
        ("position.x", "positin.x", "'range of the low ball': 'low.positin.x' is not a quantity"),
        ("radians(angle)", "radians(angel)", "formula has an unknown name: angel"),
        ("kinematics.", "kinematik.", "formula has an unknown name: kinematik"),
        (
            'at = {event = "contact", bodies = ["{ball}", "sand"]}',
            'at = "2*angel"',
            "'at' has an unknown parameter: angel",
        ),
    ],
)
def test_what_cannot_be_meant_is_told_with_its_file_and_case(
    folder: Path, said: str, instead: str, told: str
) -> None:
    with pytest.raises(TableError, match=told) as caught:
        written(folder, TABLE.replace(said, instead, 1))

    assert str(caught.value).startswith(f"{folder}/made_up.toml")


@pytest.mark.parametrize(
    ("text", "told"),
    [("[[table]", r"made_up\.toml: is not TOML: .*line 1"), ("# empty", r"has no \[\[table\]\]")],
)
def test_a_file_that_is_no_table_is_named(folder: Path, text: str, told: str) -> None:
    with pytest.raises(TableError, match=told):
        written(folder, text)


def test_a_mistake_in_a_table_is_told_without_a_traceback(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    unknown = TABLE.replace("radians(angle)", "math.radians(angle)")
    monkeypatch.setattr(cli, "all_cases", lambda: written(folder, unknown))

    result = CliRunner().invoke(cli.app, ["run"])

    assert result.exit_code == 1
    assert "unknown name: math" in result.stderr
    assert "Traceback" not in result.stderr
