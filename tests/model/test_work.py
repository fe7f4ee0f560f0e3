"""The work of checking a level is bounded before it is done."""

import json
from time import process_time

import pytest

from sandbox.model.rules import level_validation
from sandbox.model.rules.conditions import conditions
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.rules.level_validation import FEWEST, MAX_CORNERS, corners
from tests.model.levels import Data, bare, level, mistakes, said

MANY = {f"p{i}": {"value": 1, "min": 0.5, "max": 2} for i in range(8)}
SUM = "+".join(f"0*p{i}" for i in range(8))


def crowd(count: int) -> Data:
    disc = {"shape": {"type": "disc", "radius": f"1 + {SUM}"}, "mass": f"1 + {SUM}"}
    bodies = {f"b{i}": disc for i in range(count)}
    gravity = {"gravity": {"acceleration": [0, -9.81]}}
    return {"format": 1, "title": "x", "parameters": MANY, "effects": gravity, "bodies": bodies}


def wires(count: int) -> Data:
    data = crowd(count)
    for i, body in enumerate(data["bodies"].values()):
        data["bodies"][f"b{i}"] = {**body, "position": [0, i]}
    data["joints"] = {
        f"w{i}": {"type": "wire", "bead": f"b{i}", "curve": [f"s + {SUM}", i], "s": [-1, 1]}
        for i in range(count)
    }
    return data


def test_of_few_parts_every_combination_of_bounds_is_tried() -> None:
    found = list(corners(level(crowd(1)), {f"p{i}" for i in range(8)}))

    assert len(found) == 1 + 2**8 == 1 + MAX_CORNERS


def test_what_no_parameter_changes_is_looked_at_once() -> None:
    assert len(list(corners(level(crowd(1)), ()))) == 1


def test_where_few_are_tried_all_of_a_side_come_first() -> None:
    tried = list(corners(level(crowd(1)), most=FEWEST))

    assert [set(values.values()) for values in tried] == [{1.0}, {0.5}, {2.0}]


@pytest.mark.sweep
@pytest.mark.parametrize("data", [crowd(800), wires(20)], ids=["bodies", "wires"])
def test_of_many_parts_fewer_combinations_are_tried(
    data: Data, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All of them were 600,000 looks at bodies, and 18 s for wires."""
    made, work = level(data), 0.0

    def counted(condition: Condition, _: object) -> None:
        nonlocal work
        work += condition.work

    monkeypatch.setattr(Condition, "fault", counted)
    assert level_validation.faults(made) == []

    everything = sum(c.work * 2 ** len(c.names) for c in conditions(made))
    defaults = sum(c.work for c in conditions(made))
    assert everything > 3 * level_validation.PATIENCE
    assert work < (1 + FEWEST) * defaults + 1.5 * level_validation.PATIENCE


def test_an_impossible_mass_is_found_at_the_end_of_a_range_however_many_bodies_there_are() -> None:
    data = crowd(800)
    data["bodies"]["b7"] = {**data["bodies"]["b7"], "mass": f"p3 - 0.5 + {SUM}"}

    assert "must be greater than 0" in said(mistakes(data))[0]


def test_more_wires_than_can_be_looked_at_are_refused() -> None:
    start = process_time()

    found = said(mistakes(wires(201)))

    assert found == ["joints: have 201 wires; at most 200 can be checked for crossings"]
    assert process_time() - start < 2


@pytest.mark.sweep
def test_polygons_with_more_edges_than_can_be_looked_at_are_refused() -> None:
    data = bare()
    corners_ = [[i, i * i] for i in range(200)]
    shape = {"type": "polygon", "vertices": corners_}
    for i in range(251):
        data["bodies"][f"b{i}"] = {"type": "static", "shape": shape}

    assert "10,040,000 pairs of edges that may cross" in said(mistakes(data))[0]


def test_more_formulas_than_can_be_read_are_refused_before_they_are() -> None:
    data = bare()
    data["checks"] = [
        {"quantity": "ball.speed", "formula": f"{i} + {'g*' * 240}1", "tolerance": 1}
        for i in range(700)
    ]
    start = process_time()

    assert "has formulas of 34" in said(mistakes(data))[0]
    assert process_time() - start < 1
    assert len(json.dumps(data)) < 5_000_000
