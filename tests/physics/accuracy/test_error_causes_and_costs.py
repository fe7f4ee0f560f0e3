"""The accuracy of a level, its parts, and the cost of more of it."""

import numpy as np
import pytest

from sandbox.model.level import Level, Stepping
from sandbox.model.level_catalog import find
from sandbox.model.loading import load, parse
from sandbox.physics.accuracy import error_causes_and_costs
from sandbox.physics.accuracy.compared_runs import motion, record, scaled
from sandbox.physics.accuracy.error_causes_and_costs import (
    CurrentSetting,
    ErrorBudget,
    Failed,
    Finding,
    Progress,
    WorkPrecisionPoint,
)
from sandbox.physics.accuracy.requested_accuracy import Setting
from sandbox.physics.accuracy.step_refinement import largest_relative_difference
from sandbox.physics.accuracy.trusted_digits import Trust
from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import simulate
from tests.app import scenes
from tests.physics.scenes import small_swings


def splits(found: list[Finding]) -> dict[int, ErrorBudget]:
    return {each.check: each for each in found if isinstance(each, ErrorBudget)}


def trust(found: list[Finding]) -> dict[str, Trust]:
    return {each.quantity: each for each in found if isinstance(each, Trust)}


@pytest.fixture(scope="module")
def ellipse() -> Level:
    return load(find("energy/kepler-ellipse"))


@pytest.fixture(scope="module")
def of_the_ellipse(ellipse: Level) -> list[Finding]:
    """The results for an ellipse, which take two seconds."""
    return list(error_causes_and_costs.split(ellipse, ellipse.defaults))


@pytest.mark.sweep
def test_of_whatever_can_be_drawn_it_is_told_how_far_off_it_is(
    ellipse: Level, of_the_ellipse: list[Finding]
) -> None:
    """Also for quantities without a check: compared with a run at an eighth of the step."""
    names = ["planet.kinetic_energy", "planet.acceleration.x", "planet.position.y"]
    fine = ellipse.stepping.at(8 * ellipse.stepping.rate)
    run, best = (
        simulate(ellipse, record=names, stepping=s).columns for s in (ellipse.stepping, fine)
    )

    found = trust(of_the_ellipse)

    for name in names:
        pairs = zip(run[name], best[name][::8], strict=False)
        off = max(abs(one - other) for one, other in pairs)
        assert found[name].off == pytest.approx(off, rel=0.15)
        assert found[name].size == pytest.approx(np.abs(best[name]).max(), rel=1e-3)
        assert found[name].until is None


def test_it_is_told_until_when_a_motion_is_foretold() -> None:
    """At 30 Hz a double pendulum departs from its true motion; the lengths of its rods never do."""
    level = load(find("lagrange/double-pendulum"))
    slow = level.model_copy(update={"stepping": Stepping(rate=30)})

    found = trust(list(error_causes_and_costs.split(slow, slow.defaults)))
    place = found["lower.position.x"]

    assert place.until is not None
    assert 0.1 < place.until < level.duration(level.defaults)
    assert place.off > 1e-2 * place.size
    assert found["upper.position"].until is None


@pytest.mark.sweep
def test_the_error_of_a_run_is_that_of_its_motion_too() -> None:
    """The trapdoor's checks are of bodies at rest: 1.6e-11, while the door is 8e-5 off."""
    level = load(find("machines/trapdoor"))
    fine = record(level, level.defaults, level.stepping.at(4 * 240), list(motion(level)))
    run = record(level, level.defaults, level.stepping, list(motion(level)))
    true, _ = largest_relative_difference(run, fine, scaled(list(motion(level)), fine))

    found = list(error_causes_and_costs.split(level, level.defaults))

    assert max(split.numerical for split in splits(found).values()) < 1e-9
    (here,) = (each for each in found if isinstance(each, CurrentSetting))
    assert true / 2 < here.error < 2 * true


def test_an_exact_run_owes_nothing_to_its_step() -> None:
    level = scenes.level()

    found = list(error_causes_and_costs.split(level, level.defaults))

    assert len(splits(found)) == 2
    assert all(split.numerical < 1e-13 for split in splits(found).values())
    assert all(split.model == 0 for split in splits(found).values())
    (here,) = (each for each in found if isinstance(each, CurrentSetting))
    assert (here.scheme, here.rate) == ("leapfrog", 60)
    assert here.cost > 0


@pytest.mark.sweep
def test_the_error_of_a_step_is_told_as_numerical(
    ellipse: Level, of_the_ellipse: list[Finding]
) -> None:
    errors = [result.error for result in grade(simulate(ellipse))]

    found = splits(of_the_ellipse)

    for index in (0, 1, 2):
        assert found[index].numerical == pytest.approx(errors[index], rel=0.05)
        assert found[index].model == 0
        assert found[index].remaining == pytest.approx(0, abs=1e-7)


def test_an_approximation_is_told_as_the_models() -> None:
    level = small_swings()

    split = splits(list(error_causes_and_costs.split(level, level.defaults)))[0]

    assert split.model is not None
    assert split.model > 5 * split.numerical
    assert split.model + split.numerical == pytest.approx(split.total, rel=0.1)


def test_a_formula_out_of_its_range_has_no_error() -> None:
    level = scenes.level(
        checks=[
            {
                "quantity": "ball.position.y", "formula": "5 - g*t**2/2",
                "tolerance": 1e-12, "valid_if": "g < 1",
            }
        ]
    )  # fmt: skip

    split = splits(list(error_causes_and_costs.split(level, level.defaults)))[0]

    assert split.total is split.model is split.remaining is None
    assert split.numerical < 1e-13


def test_a_study_tells_points_of_every_scheme_and_the_finer_cost_more(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(error_causes_and_costs, "REFINING", 0.1)
    level = scenes.level(effects={"gravity": {"acceleration": [0, "-g"]}, "drag": {"linear": 0.1}})

    found = list(error_causes_and_costs.study(level, level.defaults))

    points = [
        each
        for each in found
        if isinstance(each, WorkPrecisionPoint) and not isinstance(each, CurrentSetting)
    ]
    assert {point.scheme for point in points} == {"leapfrog", "symplectic-euler", "explicit-euler"}
    for scheme in ("leapfrog", "symplectic-euler"):
        own = [point for point in points if point.scheme == scheme]
        assert len(own) >= 3
        assert [point.cost for point in own] == sorted(point.cost for point in own)
    coarse = {point.scheme: point.error for point in points if point.rate == 30}
    assert coarse["leapfrog"] < 0.01 * coarse["symplectic-euler"]
    shares = [each.fraction for each in found if isinstance(each, Progress)]
    assert shares == sorted(shares)


@pytest.mark.sweep
def test_a_setting_is_looked_for() -> None:
    level = load(find("energy/circular-orbit"))

    *told, setting = error_causes_and_costs.seek(level, level.defaults, 1e-4, 0.4)

    assert isinstance(setting, Setting)
    assert setting.chosen.error <= 1e-4
    runs = [str(each.detail) for each in told if isinstance(each, Progress)]
    assert any("fourth-order at" in run for run in runs)
    assert "the error so far is" in runs[-1]


def test_why_there_is_nothing_to_find_is_told() -> None:
    level = parse(scenes.runaway())

    found = list(error_causes_and_costs.split(level, level.defaults))

    assert isinstance(found[-1], Failed)
    assert "string" in found[-1].reason
