"""The work of checking a level is bounded before it is done."""

import json
from time import process_time

import pytest

from sandbox.model.expressions import Values
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.rules import level_validation
from sandbox.model.rules.conditions import conditions, effects, time_dependent_formulas
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.rules.conditions.time_dependent_formulas import Times
from sandbox.model.rules.level_validation import FEWEST, MAX_CORNERS, corners
from sandbox.model.shapes import Point, evaluate
from sandbox.model.translatable_message import Message
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


def moving(count: int, along: str) -> Data:
    """Return a level of kinematic bodies."""
    motion = {"displacement": [along, "t"], "turn": "t"}
    body = {"type": "kinematic", "shape": {"type": "disc", "radius": 1}, "motion": motion}
    bodies = {f"b{i}": {**body, "position": [3 * i, 0]} for i in range(count)}
    free = {"shape": {"type": "disc", "radius": 1}, "mass": 1, "position": [0, 9]}
    return {"format": 1, "title": "x", "bodies": {**bodies, "free": free}}


def blown(count: int, fields: int, *force: str) -> Data:
    """Return a level of bodies in many equal fields."""
    disc = {"shape": {"type": "disc", "radius": 1}, "mass": 1}
    bodies = {f"b{i}": {**disc, "position": [i, 0]} for i in range(count)}
    effects = {"field": [{"force": list(force)}] * fields}
    return {"format": 1, "title": "x", "effects": effects, "bodies": bodies}


@pytest.mark.sweep
def test_many_motions_are_looked_through_soon() -> None:
    """Each was looked at 40 times at a thousand times: these took 3.7 s."""
    start = process_time()

    assert not mistakes(moving(300, 40 * "sin(" + "t" + 40 * ")"))
    assert process_time() - start < 1.8  # 0.6 s


@pytest.mark.sweep
def test_of_motions_beyond_number_only_the_default_values_are_tried(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At the ends of eight ranges as well, 900 bodies took 4.4 s."""
    data, work = moving(900, f"p1*sin(t*p2) + ({SUM})*t"), 0.0
    made = level({**data, "parameters": MANY})

    def counted(condition: Condition, _: object) -> None:
        nonlocal work
        work += condition.work

    monkeypatch.setattr(Condition, "fault", counted)
    assert level_validation.faults(made) == []
    assert work < sum(c.work for c in conditions(made)) + 1.5 * level_validation.PATIENCE


def test_places_are_evaluated_once_for_all_that_asks_for_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A thousand bodies about 2,000 centres took 10 s, and 300 potentials on 300 bodies 2.5 s."""
    data, asked = crowd(40), list[object]()
    for i, body in enumerate(data["bodies"].values()):
        data["bodies"][f"b{i}"] = {**body, "position": ["p0", i]}
    data["effects"] = {
        "attraction": [{"mu": 1, "center": ["p1", -9 - i]} for i in range(50)],
        "potential": [{"energy": "p2*x"}] * 50,
    }

    def counted(point: Point, values: Values) -> tuple[float, float]:
        asked.append(point)
        return evaluate(point, values)

    monkeypatch.setattr(effects, "evaluate", counted)

    assert not mistakes(data)

    tries = 1 + 2**4
    assert len(asked) < tries * 50 + 2 * tries * 2 * 40


def test_a_jump_of_one_among_many_motions_is_found() -> None:
    data = moving(100, "sin(t)")
    data["bodies"]["b57"] = {
        **data["bodies"]["b57"],
        "motion": {"displacement": ["sin(t) + (0.1 if t > 3.21 else 0)", 0]},
    }

    assert "the motion jumps by 0.1 m at t = 3.21 s" in said(mistakes(data))[0]


def test_more_motions_than_can_be_looked_through_are_refused() -> None:
    found = said(mistakes(moving(1001, "t")))

    assert found == ["bodies: have 1,001 motions; at most 1,000 can be checked for jumps"]


def test_motions_with_more_to_parse_than_can_be_looked_through_are_refused() -> None:
    """999 motions, each with another formula of 29 sines, took 4.3 s."""
    data = moving(420, "t")
    for number, body in enumerate(data["bodies"].values()):
        if "motion" in body:
            body["motion"] = {"displacement": [f"{1000 + number}*t" + 60 * "+t*t", 0]}

    assert said(mistakes(data)) == [
        "bodies: have motions with formulas of 103,323 characters in all; at most 100,000 can be"
        " checked for jumps"
    ]


def test_equal_formulas_of_motions_are_looked_through_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """999 motions with the same 40 sines took 3.1 s."""
    asked: list[str] = []
    jumps = time_dependent_formulas._jumps

    def counted(at: Times, what: Message, formula: Formula, values: Values) -> Message | None:
        asked.append(str(formula.source))
        return jumps(at, what, formula, values)

    monkeypatch.setattr(time_dependent_formulas, "_jumps", counted)

    assert not mistakes(moving(30, "sin(t)"))
    assert asked.count("sin(t)") == 1


def test_many_fields_on_many_bodies_are_looked_at_soon() -> None:
    """A formula was evaluated body by body: 200 fields of 300 bodies took 1.8 s."""
    data = blown(300, 200, "sin(x + t)", "y")
    start = process_time()

    assert not mistakes(data)
    assert process_time() - start < 0.8  # 0.2 s


def test_the_body_where_a_field_has_no_value_is_named() -> None:
    data = blown(5, 1, "1/(x - 3)", "1")

    assert "has no finite value where 'b3' starts" in said(mistakes(data))[0]
