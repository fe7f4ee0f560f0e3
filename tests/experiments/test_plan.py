"""All mistakes are reported at once, each with its place; the rows are those of the grid."""

import os
from pathlib import Path

import pytest

from sandbox.experiments import catalog
from sandbox.model.errors import LevelError
from tests.experiments.making import plan, wrong

PROJECTILE = "kinematics/projectile"


def test_rows_go_through_the_grid_the_last_axis_fastest() -> None:
    found = plan(PROJECTILE, {"angle": "10, 20", "speed": "5:7:3"}, "t@end")
    assert found.runs == 6
    varied = [row.varied for row in found.rows(0, 6)]
    assert varied == [(a, s) for a in (10.0, 20.0) for s in (5.0, 6.0, 7.0)]
    assert [row.varied for row in found.rows(2, 5)] == varied[2:5]


def test_each_point_of_the_grid_has_the_same_draws() -> None:
    found = plan(PROJECTILE, {"angle": "10, 20", "g": "9.81±0.01"}, "t@end", draws=5)
    rows = [row.varied for row in found.rows(0, 10)]
    assert [g for _, g in rows[:5]] == [g for _, g in rows[5:]]
    assert [row.varied for row in found.rows(3, 8)] == rows[3:8]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"vary": {"angel": "1,2"}}, "vary.angel: 'angel' is not a parameter"),
        ({"vary": {"angle": "0:95:3"}}, "vary.angle: goes to 0 deg, but the level has"),
        ({"vary": {"angle": "0:95"}}, "vary.angle: must be FROM:TO:COUNT"),
        ({"vary": {}}, "vary: is empty; what can be varied: speed, angle, g"),
        ({"vary": {"without": "gravty"}}, "did you mean 'gravity'"),
        ({"vary": {"scheme": "leapfrg"}}, "did you mean 'leapfrog'"),
        ({"vary": {"rate": "0.5, 60"}}, "vary.rate: must be at least 1"),
        ({"vary": {"angle": "10"}, "measure": ["x"]}, "measure.0: 'x' does not say when"),
        ({"vary": {"angle": "10"}, "measure": []}, "measure: has 0 entries"),
        (
            {"vary": {"angle": "10"}, "measure": ["t@end", "t@end"]},
            "measure.1: 't@end' is measured",
        ),
        ({"vary": {"angle": "10"}, "set": {"angle": 20}}, "set and varied"),
        ({"vary": {"angle": "10"}, "set": {"g": 99}}, "set: 'g' is 99"),
        ({"vary": {"angle": "10"}, "until": "ball.sped > 1"}, "did you mean 'ball.speed'"),
        ({"vary": {"angle": "10"}, "draws": 5}, "draws: nothing is drawn"),
        ({"vary": {"angle": "20..30"}}, "draws: is missing"),
        ({"vary": {"angle": "20..30"}, "draws": 10, "method": "halton"}, "method: must be"),
        ({"vary": {"angle": "20..30"}, "draws": 10, "method": "sobol-indices"}, "a power of two"),
        ({"vary": {"angle": "10"}, "colour": 1}, "unknown key 'colour'"),
        ({"vary": {"angle": "10"}, "duration": 1e9}, "duration: that takes"),
        (
            {"vary": {"angle": "5:90:1000000", "g": "1:25:1000000"}},
            "vary: makes 1,000,000 × 1,000,000 = 1,000,000,000,000 runs; at most 1,000,000",
        ),
    ],
)
def test_a_mistake_is_told_with_its_place(given: dict[str, object], said: str) -> None:
    assert any(said in line for line in wrong(PROJECTILE, **given)), wrong(PROJECTILE, **given)


def test_all_mistakes_are_told_at_once() -> None:
    vary = {"angel": "1", "g": "1:2"}
    assert len(wrong(PROJECTILE, vary=vary, measure=["x", "t@end"], until="y")) == 4


def test_the_mistakes_of_a_file_have_lines(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    path.write_text(
        '{\n  "level": "kinematics/projectile",\n'
        '  "vary": {"angle": "0:95:3"},\n  "measure": ["t@landin"]\n}'
    )
    with pytest.raises(LevelError) as raised:
        catalog.open_plan(path)
    assert [mistake.line for mistake in raised.value.mistakes] == [3, 4]


def test_an_unknown_level_is_a_mistake_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    path.write_text('{"level": "projectil", "vary": {"angle": "10"}, "measure": ["t@end"]}')
    with pytest.raises(LevelError, match=r"1:2: level: .*did you mean"):
        catalog.open_plan(path)


@pytest.mark.parametrize(
    ("odd", "told"),
    [
        ("pipe", "is not an ordinary file"),
        ("circle", "cannot be read"),
        ("nowhere", "is a link to a file that does not exist"),
    ],
)
def test_what_is_no_ordinary_file_is_not_said_to_be_absent(
    tmp_path: Path, odd: str, told: str
) -> None:
    path = tmp_path / "mine.json"
    if odd == "pipe":
        os.mkfifo(path)
    else:
        path.symlink_to(path if odd == "circle" else tmp_path / "nothing")
    with pytest.raises(LevelError, match=told):
        catalog.open_plan(catalog.find(str(path)))
