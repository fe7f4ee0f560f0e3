"""Measures agree with closed forms."""

from pathlib import Path

import numpy as np
import pytest

from sandbox.experiments.measures import MeasureError, parse
from sandbox.model.expressions import Expression
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from tests.experiments.making import plan, table

G, SPEED, ANGLE = 9.81, 20.0, np.radians(30)
UP = SPEED * np.sin(ANGLE)
FLIGHT = 2 * UP / G


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ball.position.y@1", UP - G / 2),
        ("ball.position.x@speed/20", SPEED * np.cos(ANGLE)),
        ("t@landing", FLIGHT),
        ("t@landing(ball, 2)", (UP + np.sqrt(UP**2 - 4 * G)) / G),
        ("t@apex", UP / G),
        ("ball.position.x@crossing(ball.velocity.y, 0, down)", SPEED * np.cos(ANGLE) * UP / G),
        ("max(ball.position.y)", UP**2 / (2 * G)),
        ("largest(ball.speed)", np.hypot(SPEED * np.cos(ANGLE), UP - 2.2 * G)),
        ("mean(ball.velocity.x)", SPEED * np.cos(ANGLE)),
        ("2*ball.position.x - ball.position.x@landing", SPEED * np.cos(ANGLE) * FLIGHT),
        ("t@until", UP / G),
        ("max(t)", UP / G),
    ],
)
def test_a_measure_is_that_of_the_closed_form(tmp_path: Path, text: str, expected: float) -> None:
    until = {"until": "ball.velocity.y < 0"} if expected == UP / G and "apex" not in text else {}
    level = "kinematics/projectile"
    found = plan(level, {"speed": "20"}, text, set={"angle": 30}, duration=2.2, **until)
    step = 1 / 60 if until or text.startswith("max") else 1e-9  # some are those of a step
    assert table(found, tmp_path)[text][0].as_py() == pytest.approx(expected, abs=step)


def test_the_closed_form_of_a_check_stands_beside_its_measure(tmp_path: Path) -> None:
    found = plan("kinematics/projectile", {"angle": "20, 70"}, "t@landing", "error(range)")
    rows = table(found, tmp_path)
    for measured, expected in zip(rows["t@landing"], rows["t@landing closed form"], strict=True):
        assert measured.as_py() == pytest.approx(expected.as_py(), rel=1e-12)
    for name in ("t@landing error", "error(range)"):
        assert all(0 <= error.as_py() < 1e-12 for error in rows[name])


def test_what_never_came_is_no_number(tmp_path: Path) -> None:
    found = plan("kinematics/projectile", {"angle": "20"}, "t@landing(ball, 50)")
    rows = table(found, tmp_path)
    assert rows["t@landing(ball, 50)"][0].as_py() is None
    assert rows["failure"][0].as_py() is None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("ball.position.x", "does not say when"),
        ("bal.speed@end", "did you mean 'ball.speed'"),
        ("t@landin", "did you mean 'landing'"),
        ("t@landing(bal)", "did you mean 'ball'"),
        ("t@contact(ball)", r"contact\(BODY, BODY\)"),
        ("t@crossing(ball.speed, 0, upp)", "did you mean 'up'"),
        ("t@2*spee", "not a parameter of the level; did you mean 'speed'"),
        ("t@until", "no condition"),
        ("error(rang)", "did you mean 'range'"),
        ("error(9)", "1 to 5"),
        ("max(speed)", "names no quantity"),
        ("max(2*)", "not arithmetic"),
        ("middle(ball.speed)", "does not say when"),
    ],
)
def test_what_does_not_exist_is_refused_with_what_was_meant(text: str, said: str) -> None:
    with pytest.raises(MeasureError, match=said):
        parse(text, load(find("kinematics/projectile")), until=False)


def test_a_time_may_be_said_by_a_constant_of_the_level() -> None:
    level = load(find("momentum/bounce-by-bounce"))

    at = parse("ball.speed@fall/2", level, until=False).at

    assert isinstance(at, Expression)
    assert at(level.defaults) == level.constants["fall"](level.defaults) / 2
