"""The cost of effects: times depend on the machine, conclusions from given times do not."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from sandbox.model import effects, level_catalog
from sandbox.model.loading import load
from sandbox.physics.run import build
from validation.case import textbook
from validation.cli import app
from validation.effect_costs import comparison_with_bare_engine, cost_growth
from validation.effect_costs.comparison_with_bare_engine import (
    ALL_PAIRS,
    DECLARED,
    EFFECTS,
    effect_costs,
    exponent,
    level_costs,
    unhook,
)
from validation.effect_costs.cost_growth import growths


def test_a_level_is_measured_with_its_hooks_and_without() -> None:
    with_drag, without = level_costs(["newton/projectile-with-drag", "kinematics/free-fall"], 1)

    assert (with_drag.hooks, without.hooks) == (1, 0)
    assert with_drag.effects == ("gravity", "drag")
    assert with_drag.ratio == with_drag.step_seconds / with_drag.bare_step_seconds


@pytest.mark.sweep
def test_what_calls_python_stands_beside_the_effects_of_a_level() -> None:
    """Each level that calls Python has a law, a joint or an effect that explains it."""
    laws = {effect.name for effect in effects.EFFECTS.values() if effect.is_law}
    for name in level_catalog.textbook():
        level = textbook(name)
        declared, ways = level.effects.declared, comparison_with_bare_engine._ways(level)
        reason = {"sticking", *laws} & set(declared) or level.joints or ways
        assert bool(reason) >= bool(build(level).hooks), (name, declared, ways)


@pytest.mark.parametrize(
    ("name", "left"), [("energy/spring-oscillator", 1), ("energy/circular-orbit", 0)]
)
def test_the_bare_engine_keeps_its_own_springs_and_loses_our_hook(name: str, left: int) -> None:
    world = build(load(level_catalog.find(name)))
    assert len(world.scene.space.constraints) == 1

    unhook(world)

    assert len(world.scene.space.constraints) == left


def test_every_effect_is_measured_alone_and_some_together() -> None:
    found = effect_costs([1, 2], repeats=1)

    assert [cost.effect for cost in found] == list(EFFECTS)
    assert all(cost.bodies == (1, 2) for cost in found if cost.effect not in ALL_PAIRS)
    (pairs,) = (cost for cost in found if cost.effect == "gravitation")
    assert pairs.bodies == (2,), "one body alone attracts nothing"
    assert all(seconds > 0 for cost in found for seconds in cost.step_seconds)
    assert set(DECLARED) <= set(effects.EFFECTS)
    assert {n for n, effect in effects.EFFECTS.items() if effect.trial is not None} <= set(DECLARED)


@pytest.mark.sweep
def test_the_growth_of_a_crowd_is_measured_beside_pymunks() -> None:
    (found,) = growths({"pile": (2, 8)})

    assert found.bodies == (2, 8)
    assert all(s > 0 for s in (*found.seconds_per_body, *found.bare_seconds_per_body))
    assert all(found.contacts_per_body), "the heap has fallen"


def test_the_exponent_is_that_of_a_power() -> None:
    counts = [1, 10, 100, 1000]

    assert exponent(counts, [9, 9, 100**1.5, 1000**1.5]) == pytest.approx(1.5)
    assert exponent([1, 10, 100], [1, 1, 1]) is None


@pytest.mark.sweep
def test_the_figures_are_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(level_catalog, "names", lambda: ["kinematics/free-fall"])
    monkeypatch.setattr(comparison_with_bare_engine, "QUICK", (1, 2))
    monkeypatch.setattr(cost_growth, "QUICK", {"gas": (1, 2)})

    done = CliRunner().invoke(app, ["effects", "--quick", "--json", str(tmp_path / "e.json")])

    assert done.exit_code == 0
    said = json.loads((tmp_path / "e.json").read_text(encoding="utf-8"))
    assert {"level", "effects", "hooks", "step_seconds", "bare_step_seconds", "ratio"} <= set(
        said["levels"][0]
    )
    assert {"effect", "seconds_per_step", "bodies"} <= set(said["costs"][0])
    measured = {"seconds_per_body", "contacts_per_body"}
    bare = {f"bare_{figure}" for figure in measured}
    assert {"scene", "bodies", *measured, *bare} == set(said["growth"][0])
    assert said["environment"]["pymunk"]
