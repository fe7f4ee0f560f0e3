"""Sensitivities of functions for which they are known by hand."""

from pathlib import Path

import numpy as np
import pytest

from sandbox.experiments import read_results, report, result_statistics
from sandbox.experiments.experiment_folder import RESULTS
from sandbox.experiments.random_points import points
from tests.experiments.making import plan, table

A, B = 7.0, 0.1


@pytest.mark.sweep
def test_sobol_s_indices_of_ishigami_s_function_are_those_known_by_hand() -> None:
    """T. Ishigami and T. Homma (1990): f = sin x + a sin² y + b z⁴ sin x, each from −π to π."""
    count = 2048
    x, y, z = (2 * np.pi * points("sobol-indices", 7, 3, 5 * count, 0, 5 * count) - np.pi).T
    f = np.sin(x) + A * np.sin(y) ** 2 + B * z**4 * np.sin(x)
    first = (1 + B * np.pi**4 / 5) ** 2 / 2, A**2 / 8, 0.0
    both = 8 * B**2 * np.pi**8 / 225  # of x and z together
    whole = sum(first) + both
    found = result_statistics.sensitivity("f", f, ("x", "y", "z"))
    assert found.first == pytest.approx(np.array(first) / whole, abs=0.02)
    total = np.array(first) + both * np.array((1, 0, 1))
    assert found.total == pytest.approx(total / whole, abs=0.02)
    assert (np.abs(found.total - total / whole) < 4 * found.total_error).all()


@pytest.mark.sweep
def test_a_falling_stone_s_time_depends_on_height_and_gravity_as_their_spreads(
    tmp_path: Path,
) -> None:
    """t = √(2 h / g): the shares of the variance are those of (σ/2h)² and (σ/2g)²."""
    vary = {"height": "20±0.1", "g": "9.81±0.02"}
    others = {"draws": 64, "method": "sobol-indices", "duration": 2.2, "rate": 30}
    found = plan("kinematics/free-fall", vary, "t@landing", **others)
    table(found, tmp_path)
    [shares] = result_statistics.sensitivities(found, tmp_path / RESULTS)
    height, g = (0.1 / 20) ** 2, (0.02 / 9.81) ** 2
    assert shares.first == pytest.approx([height / (height + g), g / (height + g)], abs=0.05)
    page = report.write(found, tmp_path / RESULTS, tmp_path)
    assert "Sobol" in page.path.read_text("utf-8")


@pytest.mark.sweep
def test_the_distribution_of_an_outcome_is_that_of_what_is_drawn(tmp_path: Path) -> None:
    found = plan("kinematics/projectile", {"speed": "20±0.1"}, "ball.position.x@1", draws=200,
                 method="sobol", set={"angle": 60})  # fmt: skip
    table(found, tmp_path)
    [summary] = result_statistics.summaries(found, read_results.read(
        tmp_path / RESULTS, ["ball.position.x@1", "ball.position.x@1 error"]
    ))  # fmt: skip
    assert summary.mean == pytest.approx(10, abs=0.01)
    assert summary.deviation == pytest.approx(0.05, rel=0.05)
    assert summary.error is not None
    assert summary.error < 1e-12
