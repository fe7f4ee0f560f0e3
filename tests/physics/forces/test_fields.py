"""Forces and potentials that are given as formulas are those that are given by name."""

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.run import build, simulate
from tests.physics.scenes import GRAVITY, G, disc, level

SUN = "-2.5/sqrt(x**2 + y**2)"


def probe(effects: dict[str, object], **rest: object) -> Level:
    moons = {"probe": disc((1, 0), mass=3, velocity=[0.2, 1.3]), "far": disc((-4, 1), mass=0.01)}
    return level(moons, effects, **{"stepping": {"rate": 240}, **rest})


@pytest.mark.parametrize(
    ("formula", "named"),
    [
        ({"potential": [{"energy": SUN, "per": "mass"}]}, {"attraction": [{"mu": 2.5}]}),
        ({"potential": [{"energy": f"{G}*y", "per": "mass"}]}, GRAVITY),
        ({"field": [{"force": ["-0.3*vx", "-0.3*vy"]}]}, {"drag": {"linear": 0.3}}),
        (
            {"field": [{"force": ["2*sin(3*t)", 1], "bodies": ["probe"]}]},
            {"force": [{"body": "probe", "force": ["2*sin(3*t)", 1]}]},
        ),
    ],
    ids=["attraction", "gravity", "drag", "force"],
)
def test_a_formula_moves_bodies_as_the_effect_that_it_spells_out(
    formula: dict[str, object], named: dict[str, object]
) -> None:
    """The same law in other words: after 480 steps, but for rounding."""
    places = [build(probe(effects)).advance(480).position for effects in (formula, named)]

    assert places[0] == pytest.approx(places[1], rel=1e-10, abs=1e-10)


def test_what_does_not_look_at_velocities_is_not_taken_for_a_drag() -> None:
    """At 10 Hz drag of 300 kg/s on 3 kg would be refused; a spring of a formula is not."""
    still = probe({"field": [{"force": ["-30*x", "-30*y"]}]}, stepping={"rate": 10})
    assert not build(still).scene.laws[0].effect.depends_on_velocity

    with pytest.raises(Exception, match="the effect 'field' on 'far' needs a 'rate' of at least"):
        build(probe({"field": [{"force": ["-300*vx", 0]}]}, stepping={"rate": 10}))


def test_a_field_that_is_no_slope_does_work_on_a_way_round() -> None:
    """F = (−y, x): a body held on a circle of radius r would gain 2 π r² a turn; it is booked."""
    trace = simulate(
        probe({"field": [{"force": ["-y", "x"], "bodies": ["probe"]}]}),
        duration=1,
        record=["system.work.field", "system.kinetic_energy", "system.unexplained_energy"],
    )
    gained = trace.columns["system.kinetic_energy"] - trace.columns["system.kinetic_energy"][0]

    assert trace.columns["system.work.field"][-1] > 1
    assert np.abs(trace.columns["system.unexplained_energy"]).max() < 1e-12
    assert trace.columns["system.work.field"] == pytest.approx(gained, abs=0.02)


@pytest.mark.parametrize(
    ("effects", "told"),
    [
        ({"potential": [{"energy": "1/(x - 1)"}]}, "has no finite value where 'probe' starts"),
        ({"potential": [{"energy": "k*x"}]}, "unknown parameter 'k'"),
        ({"potential": [{"energy": "x*t"}]}, "the time 't' has no meaning here"),
        ({"potential": [{"energy": "*".join("x" * 200)}]}, "too deeply to be differentiated"),
        ({"field": [{"force": ["log(x)", 0]}]}, "has no finite value where 'far' starts"),
        ({"field": [{"force": [1, 0], "bodies": ["nobody"]}]}, "unknown body 'nobody'"),
    ],
)
def test_what_has_no_value_is_told_at_its_place(effects: dict[str, object], told: str) -> None:
    with pytest.raises(LevelError, match=told):
        probe(effects)


def test_a_parameter_cannot_have_the_name_of_a_place() -> None:
    with pytest.raises(LevelError, match=r"energy' over x, y; choose another name"):
        probe(
            {"potential": [{"energy": "x**2"}]},
            parameters={"x": {"value": 1, "min": 0, "max": 2}},
            duration="x + 1",
        )


def test_a_potential_with_corners_has_no_fourth_order() -> None:
    with pytest.raises(LevelError, match=r"the effect 'potential', since 'abs.x.' has corners"):
        probe({"potential": [{"energy": "abs(x)"}]}, stepping={"scheme": "fourth-order"})
