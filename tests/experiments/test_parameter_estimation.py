"""The results of fits to noisy data, and how far they can be trusted."""

from pathlib import Path

import numpy as np
import pytest

from sandbox.experiments.measured_data import Data, DataError, read
from sandbox.experiments.parameter_estimation import FitError, fit
from sandbox.model.level_catalog import find
from sandbox.model.loading import load

FALL = load(find("kinematics/free-fall"))
T = np.linspace(0.2, 1.4, 8)
G, NOISE = 9.7, 0.05
RATE = FALL.stepping.at(10)


def fallen(seed: int) -> np.ndarray:
    return 20 - G * T**2 / 2 + np.random.default_rng(seed).normal(0, NOISE, T.size)


def known(seed: int) -> Data:
    height = "ball.position.y"
    return Data(T, {height: fallen(seed)}, {height: np.full(T.size, NOISE)})


@pytest.mark.sweep
def test_g_lies_within_its_own_uncertainty_in_95_of_100_draws() -> None:
    """Of a normal distribution 95.4 % lie within two standard uncertainties, 68 % within one."""
    off = []
    for seed in range(100):
        [g] = fit(FALL, FALL.defaults, ["g"], known(seed), RATE).parameters
        off.append(abs(g.value - G) / g.uncertainty)
    assert sum(z < 2 for z in off) >= 95
    assert 55 <= sum(z < 1 for z in off) <= 80  # nor is it too large


def test_the_uncertainty_is_that_of_the_linear_problem() -> None:
    """y is linear in g: σ² = σ_y² / Σ (t²/2)²."""
    [g] = fit(FALL, FALL.defaults, ["g"], known(1), RATE).parameters
    assert g.uncertainty == pytest.approx(NOISE / np.sqrt((T**4 / 4).sum()), rel=1e-4)


def test_several_parameters_are_found_at_once_without_known_uncertainties() -> None:
    data = Data(T, {"ball.position.y": fallen(2)}, {})
    found = fit(FALL, FALL.defaults, ["g", "height"], data, RATE)
    for parameter, value in zip(found.parameters, (G, 20.0), strict=True):
        assert abs(parameter.value - value) < 3 * parameter.uncertainty
    assert abs(found.correlation[0, 1]) < 1


def test_what_the_data_do_not_tell_is_refused() -> None:
    data = Data(T, {"ball.position.y": fallen(3)}, {})
    with pytest.raises(FitError, match="do not determine mass"):
        fit(FALL, FALL.defaults, ["mass"], data, RATE)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no rows below a header"),
        ("x,y\n1,2\n", ":1: no column is called 't'"),
        ("t,bal.speed\n0,1\n", ":1: .*did you mean 'ball.speed'"),
        ("t,ball.speed\n1,1\n2,one\n", ":3: 'one' is not a number"),
        ("t,ball.speed\n1,1,1\n", ":2: has 3 cells, but the header 2"),
        ("t,ball.speed\n-1,1\n", "from the start of the run"),
        ("t,ball.speed ±\n1,1\n", "but no 'ball.speed'"),
        ("t,ball.speed,ball.speed ±\n1,1,0\n", "must be above 0"),
        ("# only\nt\n1\n", ":2: no column holds a quantity"),
        (f"t,{'x' * 200_000}\n1,1\n", ":1: field larger than field limit"),
        (f"t,ball.speed\n1,{'1' * 200_000}\n", ":2: field larger than field limit"),
    ],
)
def test_data_that_cannot_be_used_are_refused_with_their_line(
    tmp_path: Path, text: str, said: str
) -> None:
    path = tmp_path / "data.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(DataError, match=said):
        read(path, FALL)


def test_a_file_says_what_it_says(tmp_path: Path) -> None:
    path = tmp_path / "data.csv"
    path.write_text("# by hand\nt, ball.speed, ball.speed ±\n1, 2, 0.1\n2,, 0.2\n", "utf-8")
    found = read(path, FALL)
    assert found.t.tolist() == [1, 2]
    assert found.count == 1
    assert found.uncertainties["ball.speed"].tolist() == [0.1, 0.2]
