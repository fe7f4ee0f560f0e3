"""The cost of accuracy: times depend on the machine, conclusions from given times do not."""

import json
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from typer.testing import CliRunner

from sandbox.model import level_catalog
from sandbox.model.level import Scheme, Stepping
from sandbox.model.loading import load
from sandbox.physics.measuring.recording import needed
from sandbox.physics.run import simulate
from tests.physics.scenes import small_swings
from validation import output
from validation.cli import app
from validation.cost_of_accuracy import command
from validation.cost_of_accuracy.report import (
    as_json,
    cost_to_reach,
    failed,
    headline,
    milliseconds,
    next_digit,
    order,
    order_in_words,
    pareto,
    times,
)
from validation.cost_of_accuracy.run_error import yardstick
from validation.cost_of_accuracy.scheme_and_rate_sweep import (
    QUICK,
    Budget,
    Point,
    Sweep,
    digits,
    errors,
    timed,
)

LEVELS = ["kinematics/free-fall", "lagrange/simple-pendulum"]


def point(rate: float, error: float, seconds: float, scheme: Scheme = "leapfrog") -> Point:
    return Point(scheme, rate, 10, error, seconds, 100, 0)


def power(exponent: float, scale: float, scheme: Scheme, cost: float = 1e-6) -> list[Point]:
    """A scheme whose error falls with a power of the step."""
    rates = [60.0 * 2**i for i in range(6)]
    return [point(rate, scale * rate**-exponent, cost * rate, scheme) for rate in rates]


def sweep(points: Sequence[Point], own_rate: float = 240.0) -> Sweep:
    return Sweep("a/level", "closed form", ("t",), own_rate, tuple(points))


@pytest.mark.parametrize("exponent", [1.0, 2.0, 4.0])
def test_the_order_is_the_power_by_which_the_error_falls(exponent: float) -> None:
    points = power(exponent, 1.0, "leapfrog")

    assert order(points, "leapfrog") == pytest.approx(exponent)
    assert order(points, "symplectic-euler") is None


def test_rounding_has_no_order() -> None:
    points = [point(60.0 * 2**i, 3e-15, 1e-3) for i in range(6)]

    assert order(points, "leapfrog") is None
    assert order_in_words(3e-15, None) == "exact"
    assert order_in_words(5e-13, -2.0) == "exact", "rounding that adds up is no order"


def test_too_few_runs_are_not_called_exact() -> None:
    points = power(2.0, 1.0, "leapfrog")[:2]

    assert order_in_words(points[0].error, order(points, "leapfrog")) == "–"


def test_nothing_beats_a_point_of_the_pareto_front() -> None:
    points = [
        point(60, 1e-2, 1.0), point(60, 1e-3, 3.0), point(60, 5e-2, 2.0), point(60, 1e-3, 2.5),
        point(60, math.nan, math.nan), point(60, math.inf, 0.5),
    ]  # fmt: skip

    assert pareto(points) == [0, 3]


def test_the_cost_to_reach_an_error_is_that_of_the_cheapest_run() -> None:
    points = [point(60, 1e-2, 1.0), point(120, 1e-4, 4.0), point(240, 1e-5, 2.0)]

    assert cost_to_reach(points, 1e-2) == 1.0
    assert cost_to_reach(points, 1e-3) == 2.0
    assert cost_to_reach(points, 1e-9) is None


def test_the_next_digit_costs_what_a_tenth_of_the_error_does() -> None:
    """For second order, a step that is 4 times shorter, of those that are tried."""
    found = sweep(power(2.0, 1.0, "leapfrog"))

    assert next_digit(found) == pytest.approx(4.0)
    assert next_digit(sweep(power(2.0, 1.0, "leapfrog"), own_rate=1920.0)) is None, "none is closer"
    assert next_digit(sweep([point(240.0, 3e-15, 1e-3)])) is None, "it is rounding"


@pytest.mark.sweep
def test_the_place_that_is_known_least_and_what_is_checked_can_be_trusted_so_far() -> None:
    """Compared with a run at an eighth of the step."""
    level = load(level_catalog.find("lagrange/simple-pendulum"))
    place, *checked = digits(level, ["bob.position.x", "t", "system.energy"])
    fine = level.stepping.at(8 * level.stepping.rate)
    run, best = (
        simulate(level, record=[place.quantity], stepping=s).columns[place.quantity]
        for s in (level.stepping, fine)
    )

    off = max(abs(one - other) for one, other in zip(run, best[::8], strict=False))
    assert ".position." in place.quantity
    assert place.off == pytest.approx(off, rel=0.15)
    assert place.until is None
    assert {each.quantity for each in checked} <= {"bob.position.x", "system.energy"}


def test_the_headline_compares_at_the_same_time_and_at_the_same_error() -> None:
    """Second order beside first order of the same cost: 1 / 240 of the error at 240 Hz."""
    found = headline(sweep([*power(2.0, 1.0, "leapfrog"), *power(1.0, 1.0, "symplectic-euler")]))

    assert found is not None
    assert found.naive_error == pytest.approx(1 / 240)
    assert found.closer == pytest.approx(240)
    assert found.cheaper == pytest.approx(240, rel=1e-6)  # by its order: no run came so close


def test_pymunk_may_take_the_step_that_serves_it_best_in_the_same_time() -> None:
    naive = power(1.0, 1.0, "symplectic-euler", cost=0.25e-6)  # four times as cheap

    found = headline(sweep([*power(2.0, 1.0, "leapfrog"), *naive]))

    assert found is not None
    assert found.naive_error == pytest.approx(1 / 960)


def test_without_a_run_of_ours_there_is_no_headline() -> None:
    assert headline(sweep(power(1.0, 1.0, "symplectic-euler"))) is None


def test_that_pymunk_never_comes_through_is_no_failure_of_ours() -> None:
    naive = [point(240, math.inf, 1e-3, "symplectic-euler")]
    exact, lost = point(240, 0.0, 1e-3), point(240, math.nan, math.nan)

    assert failed([sweep([exact, *naive])]) == []
    assert failed([sweep([lost, *naive])]) == ["a/level"]
    assert failed([Sweep("b", "nothing", (), 240, (), failure="it stops")]) == ["b"]
    assert failed([Sweep("b", "nothing: the level has no check", (), 240, ())]) == []


@pytest.mark.sweep
def test_a_formula_that_is_an_approximation_gives_way_to_a_finer_run() -> None:
    """The formula for small swings is off by the same amount at any step."""
    level = small_swings()

    stick = yardstick(level, level.defaults, budget=0.2)

    assert stick is not None
    assert stick.by_reference == (0,)
    assert stick.by_formula == (1,)  # the rod is as long as it is
    assert "a run at" in stick.kind
    rates = (level.stepping.rate, 2 * level.stepping.rate)
    coarse, fine = (
        stick.error(simulate(level, record=needed(level), stepping=Stepping(rate=rate)))
        for rate in rates
    )
    assert fine < 0.4 * coarse  # it converges, which it cannot to an approximation


@pytest.mark.sweep
def test_under_a_clock_that_ticks_too_seldom_it_is_the_finest_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("validation.cost_of_accuracy.run_error.perf_counter", lambda: 0.0)
    level = small_swings()

    stick = yardstick(level, level.defaults, budget=0.2)

    assert stick is not None
    assert stick.reference.stepping.rate == 16 * level.stepping.rate


def test_a_formula_that_is_exact_is_the_yardstick() -> None:
    level = load(level_catalog.find("kinematics/free-fall"))

    stick = yardstick(level, level.defaults, budget=0.1)

    assert stick is not None
    assert stick.kind == "closed form"
    assert stick.error(simulate(level, record=needed(level))) < 1e-11


@pytest.mark.sweep
def test_a_sweep_finds_the_order_of_each_scheme() -> None:
    """Measured: 2.00 for leapfrog, 1.02 for stock pymunk."""
    found = errors("energy/kepler-ellipse", Budget(run=0.5, rates=(30.0, 60.0, 120.0), targets=()))

    leapfrog, naive = (order(found.points, s) for s in ("leapfrog", "symplectic-euler"))
    assert leapfrog == pytest.approx(2.0, abs=0.1)
    assert naive is not None
    assert naive < 1.3


@pytest.mark.sweep
def test_runs_that_fail_stay_as_rows_without_a_cost() -> None:
    """The spring of 200 N/m on 0.1 kg needs more than 22 Hz, and says so."""
    found = errors("energy/damped-spring", Budget(run=0.5, rates=(2.0, 240.0), targets=()))

    failed = [p for p in found.points if p.failure]
    assert {p.rate for p in failed} == {2.0}
    assert all(math.isnan(p.seconds_per_second) for p in timed(found).points if p.failure)
    content = output.content(levels=[as_json(found)])
    (row, *_) = [p for p in content["levels"][0]["points"] if p["failure"]]
    assert row["error"] is None


def test_what_goes_quickly_takes_levels_of_every_chapter() -> None:
    every = level_catalog.textbook()
    taken = command.sample(every)

    assert {name.partition("/")[0] for name in taken} == {name.partition("/")[0] for name in every}
    assert len(every) / command.EACH <= len(taken) < len(every) / 4


@pytest.mark.sweep
def test_the_figures_are_written(tmp_path: Path) -> None:
    file = tmp_path / "c.json"

    done = CliRunner().invoke(
        app, ["cost", *LEVELS, "--quick", "--json", str(file), "--output", str(tmp_path)]
    )

    assert done.exit_code == 0
    said = json.loads(file.read_text(encoding="utf-8"))
    assert [level["level"] for level in said["levels"]] == LEVELS
    for level in said["levels"]:
        assert {"points", "order", "pareto", "judged_by", "own_rate", "headline"} <= set(level)
        assert {"scheme", "rate", "iterations", "error", "seconds_per_second", "steps"} <= set(
            level["points"][0]
        )
        assert {p["rate"] for p in level["points"]} <= {*QUICK.rates, level["own_rate"]}
    assert said["environment"]["pymunk"]
    assert said["levels"][0]["headline"]["closer"] > 1e8
    assert (tmp_path / "kinematics-free-fall.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("wrong", "status"),
    [(["kinematics/free-fal"], 1), (["kinematics/free-fall", "--json", "/no/such/folder/c"], 2)],
)
def test_no_such_level_has_failed_and_no_such_folder_is_wrong_usage(
    wrong: list[str], status: int
) -> None:
    done = CliRunner().invoke(app, ["cost", "--quick", *wrong])

    assert done.exit_code == status
    assert done.stderr
    assert "Traceback" not in done.output


def test_a_folder_for_diagrams_is_made_before_anything_is_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "not" / "there"
    monkeypatch.setattr(command, "sweep_all", lambda *_, **__: [] if folder.is_dir() else None)

    assert command.measure([], None, folder, quick=True) == []


@pytest.mark.parametrize("place", ["file", "file/in it"])
def test_a_file_in_the_place_of_the_folder_is_told_before_anything_is_measured(
    tmp_path: Path, place: str
) -> None:
    (tmp_path / "file").touch()

    done = CliRunner().invoke(app, ["cost", *LEVELS, "--output", str(tmp_path / place)])

    assert done.exit_code == 2
    assert "cannot make the folder" in done.output


def test_without_the_library_that_draws_it_is_told_before_anything_is_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "validation.cost_of_accuracy.work_precision_diagram", None)

    done = CliRunner().invoke(app, ["cost", *LEVELS, "--output", str(tmp_path)])

    assert done.exit_code == 2
    assert "a diagram needs the library" in done.output
    assert "mechanics-sandbox[report]" in done.output


def test_costs_and_ratios_are_told_in_two_digits() -> None:
    assert milliseconds(0.1371) == "140 ms/s"
    assert milliseconds(0.00001) == "0.01 ms/s"
    assert times(170.3) == "170×"
    assert times(2.49e12) == "2.5e+12×"
