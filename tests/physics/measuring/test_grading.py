"""Grading: a formula, a tolerance, and where it holds."""

from math import inf, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.physics.measuring.grading import Result, grade, relative_error
from sandbox.physics.measuring.recording import needed
from sandbox.physics.run import build, simulate
from tests.physics.scenes import GRAVITY, G, Spec, disc, floor, level

PARAMETERS = {"v": {"value": 8, "min": 0, "max": 20}, "e": {"value": 1, "min": 0, "max": 1}}


def check(
    quantity: str,
    formula: str | float,
    *,
    tolerance: float = 1e-9,
    duration: float = 2,
    scheme: str = "leapfrog",
    speed: float = 8,
    **rest: object,
) -> Result:
    """Grade one check of a ball that is thrown up at 1 m and bounces on the ground."""
    said: Spec = {"quantity": quantity, "formula": formula, "tolerance": tolerance, **rest}
    scene = level(
        {
            "ball": disc((0, 1), velocity=[1, "v"], restitution="e"),
            "ground": floor(restitution=1),
        },
        {**GRAVITY, "contact": {}, "restitution": {}},
        parameters=PARAMETERS,
        checks=[said],
        duration=10,
        stepping={"scheme": scheme},
    )
    (result,) = grade(simulate(scene, {**scene.defaults, "v": speed}, duration))
    return result


def test_a_formula_that_holds_at_every_step_passes() -> None:
    result = check("ball.position.y", f"1 + v*t - {G}*t**2/2", duration=1.5)

    assert result.verdict == "passed"
    assert result.unit == "m"
    assert result.error is not None
    assert result.error <= 1e-14


def test_the_error_of_a_check_is_its_largest() -> None:
    """Off by 0.001 t: most at the end, of a largest expectation of 1 + v t."""
    result = check("ball.position.x", "1.001*t", duration=1.5)

    assert result.verdict == "failed"
    assert result.t == 1.5
    assert (result.measured, result.expected) == pytest.approx((1.5, 1.5015))
    assert result.error == pytest.approx(0.0015 / 1.5015)


def test_an_error_may_be_relative_to_what_a_small_difference_is_the_difference_of() -> None:
    """Off by 1e-7 m over a way of 1 m; a scale below that changes nothing."""
    for scale, error in ((10, 1e-8), (0.1, 1e-7)):
        result = check("ball.position.x", "t + 1e-7", duration=1.0, scale=scale)
        assert result.error == pytest.approx(error, rel=1e-6)


def test_a_formula_may_hold_at_a_time_between_steps() -> None:
    result = check("ball.position.y", f"1 + v*t - {G}*t**2/2", at=0.777)

    assert result.verdict == "passed"
    assert result.t == 0.777


@pytest.mark.parametrize("steps", [23, 31, 46, 62])
def test_the_end_of_a_run_has_come_when_its_last_step_has(steps: int) -> None:
    """23/60 is more than 23 * (1/60) by a bit."""
    result = check("ball.position.x", "t", at=f"{steps}/60", duration=steps / 60)

    assert result.verdict == "passed"


@pytest.mark.parametrize(
    ("at", "quantity", "formula"),
    [
        ({"event": "apex", "body": "ball"}, "ball.position.y", f"1 + v**2/(2*{G})"),
        ({"event": "apex", "body": "ball"}, "t", f"v/{G}"),
        ({"event": "landing", "body": "ball", "height": 1}, "t", f"2*v/{G}"),
        ({"event": "landing", "body": "ball", "height": 1}, "ball.velocity.y", "-v"),
        ({"event": "crossing", "quantity": "ball.position.x", "value": 0.3}, "t", 0.3),
        (
            {"event": "crossing", "quantity": "ball.velocity.y", "value": -1, "direction": "down"},
            "t",
            f"(v + 1)/{G}",
        ),
        ({"event": "contact", "bodies": ["ground", "ball"]}, "ball.position.x", "t"),
    ],
)
def test_a_formula_may_hold_at_an_event(at: Spec, quantity: str, formula: str | float) -> None:
    result = check(quantity, formula, at=at, tolerance=1e-12)

    assert result.verdict == "passed", result


def test_a_contact_is_measured_when_the_impact_is_over() -> None:
    """Just after it the ball rises as fast as it fell: e = 1, and it keeps its energy."""
    at = {"event": "contact", "bodies": ["ball", "ground"]}
    result = check("ball.velocity.y", "v", at=at, tolerance=1)

    assert result.measured is not None
    assert result.measured > 8


@pytest.mark.parametrize(
    "at",
    [
        5,
        {"event": "landing", "body": "ball", "height": -3},
        {"event": "crossing", "quantity": "ball.position.x", "value": 100},
        {"event": "crossing", "quantity": "ball.position.x", "value": 1, "direction": "down"},
    ],
)
def test_what_has_not_come_yet_is_waited_for(at: object) -> None:
    result = check("ball.position.x", "t", at=at, duration=0.5)

    assert result.verdict == "waiting"
    assert result.error is None


def test_a_contact_at_the_last_step_is_waited_for() -> None:
    """The impact is not over."""
    at = {"event": "contact", "bodies": ["ball", "ground"]}
    verdicts = [check("ball.position.x", "t", at=at, duration=n / 60).verdict for n in (100, 110)]

    assert verdicts == ["waiting", "passed"]


@pytest.mark.parametrize(
    ("condition", "verdict"), [("v > 9", "not applicable"), ("v < 9", "failed")]
)
def test_a_formula_does_not_apply_where_its_condition_is_false(
    condition: str, verdict: str
) -> None:
    assert check("ball.position.x", "2*t", valid_if=condition).verdict == verdict


def test_a_formula_without_a_value_fails() -> None:
    result = check("ball.position.x", "sqrt(v - 3) + t", speed=2)

    assert result.verdict == "failed"
    assert result.error == inf


def test_the_naive_schemes_are_not_asked_for_the_forces_before_their_first_step() -> None:
    result = check("ball.acceleration.y", -G, scheme="symplectic-euler", duration=1)

    assert result.verdict == "passed"


def test_a_run_records_what_its_checks_need() -> None:
    scene = level(
        {"a": disc(), "b": disc((2, 0))},
        {},
        checks=[
            {"quantity": "a.speed", "formula": 0, "tolerance": 1},
            {"quantity": "t", "formula": 0, "tolerance": 1, "at": {"event": "apex", "body": "b"}},
            {"quantity": "a.speed", "formula": 0, "tolerance": 1, "at": 1},
        ],
    )

    assert needed(scene) == ["a.speed", "t", "b.velocity.y"]
    assert set(simulate(scene, duration=1).columns) == {"a.speed", "t", "b.velocity.y"}


NUMBERS = st.floats(-1e6, 1e6)


@given(st.lists(NUMBERS, min_size=1, max_size=5), NUMBERS)
def test_the_error_is_relative_to_the_largest_expectation(
    expected: list[float], off: float
) -> None:
    values = np.array(expected)
    scale = float(np.abs(values).max())
    error, where = relative_error(values + off, values)

    assert error == pytest.approx(abs(off) / (scale if scale > 1e-9 else 1), rel=1e-6, abs=1e-9)
    assert 0 <= where < len(expected)


def test_where_zero_is_expected_the_error_is_absolute() -> None:
    assert relative_error(np.array([1e-3, -5e-3]), np.zeros(2)) == (5e-3, 1)


@pytest.mark.parametrize(("measured", "expected"), [(nan, 1.0), (1.0, nan), (1.0, inf), (inf, inf)])
def test_what_is_not_a_number_is_infinitely_wrong(measured: float, expected: float) -> None:
    error, where = relative_error(np.array([1.0, measured]), np.array([1.0, expected]))

    assert (error, where) == (inf, 1)


@pytest.mark.parametrize(
    ("duration", "steps"), [(1, 60), (0.7, 42), (1 / 3, 20), (0.01, 1), (1.001, 61)]
)
def test_a_run_lasts_to_the_first_step_that_is_not_before_its_end(
    duration: float, steps: int
) -> None:
    trace = simulate(level({"ball": disc()}, {}), duration=duration, record=["t"])

    assert len(trace.t) == steps + 1
    assert trace.t[-1] == steps * build(trace.level).dt
