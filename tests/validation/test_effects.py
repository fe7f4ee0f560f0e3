"""What effects cost: the figures are the machine's, what is measured is not."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from sandbox.model import catalog
from sandbox.model.effects import Effects
from validation.cli import app
from validation.effects import costs
from validation.effects.costs import DECLARED, EFFECTS, effect_costs, exponent, level_costs


def test_a_level_is_measured_with_its_hooks_and_without() -> None:
    with_drag, without = level_costs(["newton/projectile-with-drag", "kinematics/free-fall"], 1)

    assert (with_drag.hooks, without.hooks) == (1, 0)
    assert with_drag.effects == ("gravity", "drag")
    assert with_drag.ratio == with_drag.step_seconds / with_drag.bare_step_seconds


def test_every_effect_is_measured_alone_and_some_together() -> None:
    found = effect_costs([1, 2], repeats=1)

    assert [cost.effect for cost in found] == list(EFFECTS)
    assert all(cost.bodies == (1, 2) for cost in found)
    assert all(seconds > 0 for cost in found for seconds in cost.step_seconds)
    assert set(DECLARED) <= set(Effects.model_fields)


def test_the_exponent_is_that_of_a_power() -> None:
    counts = [1, 10, 100, 1000]

    assert exponent(counts, [9, 9, 100**1.5, 1000**1.5]) == pytest.approx(1.5)
    assert exponent([1, 10, 100], [1, 1, 1]) is None


def test_the_figures_are_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(catalog, "names", lambda: ["kinematics/free-fall"])
    monkeypatch.setattr(costs, "QUICK", (1, 2))

    done = CliRunner().invoke(app, ["effects", "--quick", "--json", str(tmp_path / "e.json")])

    assert done.exit_code == 0
    said = json.loads((tmp_path / "e.json").read_text(encoding="utf-8"))
    assert {"level", "effects", "hooks", "step_seconds", "bare_step_seconds", "ratio"} <= set(
        said["levels"][0]
    )
    assert {"effect", "seconds_per_step", "bodies"} <= set(said["costs"][0])
    assert said["environment"]["pymunk"]
