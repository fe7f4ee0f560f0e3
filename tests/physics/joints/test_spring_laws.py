"""A spring with a law of its own pulls by it, and stores its integral."""

from typing import Any

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import box, disc, level


def sprung(rate: float = 240, mass: float = 1.5, **spring: Any) -> Level:  # noqa: ANN401
    tie = {"type": "spring", "ends": [[0, 0], "b"], "length": 1, "stiffness": 0, **spring}
    bodies = {"b": disc((1.4, 0), mass=mass, velocity=[0, 0.7])}
    return level(bodies, {}, joints={"tie": tie}, stepping={"rate": rate})


def test_k_x_as_a_law_is_the_spring_with_that_stiffness() -> None:
    """Also beside a damper, and where a bumper lets go: to rounding after 480 steps."""
    for more in ({}, {"damping": 0.4}, {"pushes_only": True, "length": 1.6}):
        ends = [
            build(sprung(**more, **own)).advance(480)
            for own in ({"stiffness": 30}, {"law": "30*x"}, {"stiffness": 10, "law": "20*x"})
        ]
        for other in ends[1:]:
            assert other.position == pytest.approx(ends[0].position, abs=1e-11)


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("law", "energy"),
    [
        ("300*x**3", lambda x: 75 * x**4),
        ("5*sinh(2*x)", lambda x: 2.5 * (np.cosh(2 * x) - 1)),
        ("where(x > 0, 80*x, 0)", lambda x: 40 * np.maximum(x, 0) ** 2),
    ],
    ids=["cubic", "sinh", "rope"],
)
def test_it_stores_the_integral_of_its_law_and_gives_it_back(law: str, energy: Any) -> None:  # noqa: ANN401
    record = ["tie.length", "tie.potential_energy", "system.unexplained_energy", "system.energy"]
    errors = []
    for rate in (240, 480):
        found = simulate(sprung(rate, law=law), duration=2, record=record).columns
        stored = energy(found["tie.length"] - 1)
        assert found["tie.potential_energy"] == pytest.approx(stored, rel=1e-12, abs=1e-13)
        errors.append(np.abs(found["system.unexplained_energy"]).max())

    assert errors[0] / errors[1] == pytest.approx(4, rel=0.3)
    assert errors[1] < 2e-3


def test_a_law_that_is_too_steep_is_refused_with_the_rate_it_needs() -> None:
    """3 b x² at x = 0.4 m for b = 1e6 is 4.8e5 N/m: ω / 2 for 1.5 kg is 283 a second."""
    with pytest.raises(SimulationError, match="the spring 'tie' needs a 'rate' of at least 283"):
        build(sprung(law="1e6*x**3"))


def test_a_law_of_infinite_slope_is_refused_without_a_rate() -> None:
    """sqrt(x) has no slope between -0.4 m and 0.4 m; the message asked for "at least inf"."""
    with pytest.raises(SimulationError, match=r"'tie' is infinitely stiff .* no 'rate' is enough"):
        build(sprung(law="sqrt(x)", length=1.2))


@pytest.mark.parametrize(
    ("law", "told"),
    [
        ("log(x - 1)", "has no finite value or slope at x = 0.4 m"),
        ("k*x", "unknown parameter 'k'"),
        ("x*t", "the time 't' has no meaning here"),
        ("1e41*x/0.4", r"is 1e.41 N, but must be at most 1e.40 N"),
    ],
)
def test_a_law_that_cannot_be_is_told(law: str, told: str) -> None:
    with pytest.raises(LevelError, match=told):
        sprung(law=law)


def test_a_law_with_corners_has_no_fourth_order() -> None:
    tie = {"type": "spring", "ends": ["a", "b"], "stiffness": 1, "law": "abs(x)"}
    with pytest.raises(LevelError, match="which rules out 'tie', whose law has corners"):
        level(
            {"a": box(), "b": box((2, 0))},
            {},
            joints={"tie": tie},
            stepping={"scheme": "fourth-order"},
        )
