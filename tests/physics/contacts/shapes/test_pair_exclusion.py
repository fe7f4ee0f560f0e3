"""Bodies that are kept apart do not meet, whoever looks for contacts; all others do."""

from typing import Any

import pytest

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.run import build, simulate
from tests.physics.scenes import GRAVITY, box, disc, floor, level

Said = dict[str, Any]
SOLVERS: list[Said] = [
    {},
    {"solver": "direct"},
    {"located": ["a", "b"]},
]


def falling(contact: Said, **effects: Said) -> Level:
    """Return a ball that falls on another, which rests on the floor."""
    bodies = {"a": disc((0, 3)), "b": disc((0, 0.5)), "floor": floor()}
    return level(bodies, {**GRAVITY, "contact": contact, **effects}, stepping={"rate": 240})


@pytest.mark.sweep
@pytest.mark.parametrize("contact", SOLVERS, ids=["iterative", "direct", "located"])
def test_a_ball_falls_through_one_that_it_does_not_meet_and_lands_on_the_floor(
    contact: Said,
) -> None:
    through = simulate(
        falling({**contact, "apart": [["a", "b"]]}), duration=2, record=["a.position.y"]
    )
    onto = simulate(falling(contact), duration=2, record=["a.position.y"])

    assert through.columns["a.position.y"][-1] == pytest.approx(0.5, abs=2e-3)
    assert onto.columns["a.position.y"][-1] == pytest.approx(1.5, abs=2e-3)


def test_only_pairs_within_a_group_are_kept_apart() -> None:
    """Of three that fall on each other in one place, the third meets both."""
    bodies = {n: disc((0, 0.5 + 1.2 * i)) for i, n in enumerate("abc")} | {"floor": floor()}
    scene = level(bodies, {**GRAVITY, "contact": {"apart": [["a", "b"]]}}, stepping={"rate": 240})
    final = build(scene).advance(480).position[:, 1]

    assert final[:3] == pytest.approx([0.5, 0.5, 1.5], abs=5e-3)


@pytest.mark.parametrize("solver", ["iterative", "direct"])
def test_bodies_on_one_pivot_need_not_collide(solver: str) -> None:
    """Two bars that overlap at their pin swing freely, and are no mistake at the start."""
    bars = {"upper": box((0.5, 0), size=(1.2, 0.1)), "lower": box((1.5, 0), size=(1.2, 0.1))}
    joints = {
        "hinge": {"type": "pivot", "ends": [{"body": "upper", "at": [-0.5, 0]}, [0, 0]]},
        "pin": {
            "type": "pivot",
            "ends": [{"body": "upper", "at": [0.5, 0]}, {"body": "lower", "at": [-0.5, 0]}],
        },
    }

    def end(contact: Said | None) -> float:
        effects = {**GRAVITY, "rotation": {}, **({} if contact is None else {"contact": contact})}
        scene = level({**bars, "floor": floor(-9)}, effects, joints=joints, stepping={"rate": 480})
        return float(build(scene).advance(480).angle[1])

    assert end({"solver": solver, "jointed": False}) == pytest.approx(end(None), abs=1e-9)
    with pytest.raises(Exception, match="'lower' and 'upper' overlap by"):
        end({"solver": solver})


def test_a_pair_that_never_meets_has_no_coefficient() -> None:
    rub = {
        "pairs": [
            {"bodies": ["a", "b"], "coefficient": 1},
            {"bodies": ["a", "floor"], "coefficient": 1},
        ]
    }
    with pytest.raises(LevelError, match="'a' and 'b' never touch, because of 'contact'"):
        falling({"apart": [["b", "a"]]}, friction=rub)


def test_what_is_not_declared_costs_nothing() -> None:
    assert not build(falling({"solver": "iterative"})).scene.bodies["a"].constraints
