"""Groups are placed as a whole: turned about their origin, then moved."""

import json
from cmath import rect
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import Joint, bodies_of, ends_of
from sandbox.model.joints.stops import AngleStop
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.model.shorthand.groups import TURNED
from tests.model.levels import Data, bare

DISC = {"shape": {"type": "disc", "radius": 0.1}, "mass": "m"}
VALUES = {"m": 2.0, "g": 9.81}

DUMBBELL: Data = {
    "bodies": {
        "a": DISC,
        "b": DISC | {"position": [1, 0.5], "angle": 0.2, "velocity": [1, 0]},
    },
    "joints": {
        "rod": {"type": "rod", "ends": ["a", {"body": "b", "at": [0.1, 0]}]},
        "hook": {"type": "rope", "ends": ["a", [0, 2]]},
        "rail": {"type": "rail", "ends": ["b", [1, 0.5]], "direction": [1, 0]},
    },
}


def level(**changes: object) -> Data:
    return {**bare(), "checks": [], "ghosts": {}, "effects": {"rotation": {}, **bare()["effects"]},
            "groups": {"pair": DUMBBELL}, **changes}  # fmt: skip


def read(data: Data) -> Level:
    return parse(json.dumps(data, indent=1))


def told(data: Data) -> str:
    with pytest.raises(LevelError) as caught:
        read(data)
    return str(caught.value)


@pytest.mark.sweep
@given(x=st.floats(-5, 5), y=st.floats(-5, 5), angle=st.floats(-6, 6), as_text=st.booleans())
def test_a_group_is_turned_and_moved_as_one(
    x: float, y: float, angle: float, as_text: bool
) -> None:
    turn: object = f"{angle!r}*m/2" if as_text else angle
    found = read(level(bodies={"left": {"copy": "pair", "position": [x, y], "angle": turn}}))

    def there(px: float, py: float) -> complex:
        return complex(x, y) + rect(1, angle) * complex(px, py)

    places = {name: end_position(name, found.bodies, VALUES) for name in found.bodies}
    assert places["left_a"] == pytest.approx(there(0, 0), abs=1e-12)
    assert places["left_b"] == pytest.approx(there(1, 0.5), abs=1e-12)
    assert found.bodies["left_b"].angle(VALUES) == pytest.approx(0.2 + angle, abs=1e-12)
    speed = complex(*(part(VALUES) for part in found.bodies["left_b"].velocity))
    assert speed == pytest.approx(rect(1, angle), abs=1e-12)
    (_, first), (_, hook) = ends_of(found.joints["left_hook"])
    assert first == "left_a"
    assert end_position(hook, found.bodies, VALUES) == pytest.approx(there(0, 2), abs=1e-12)
    direction = found.joints["left_rail"].direction  # type: ignore[union-attr]
    way = complex(*(part(VALUES) for part in direction))
    assert way == pytest.approx(rect(1, angle), abs=1e-12)


def test_a_group_is_placed_several_times_by_repeating() -> None:
    found = read(
        level(bodies={"p{i}": {"repeat": {"i": 3}, "copy": "pair", "position": ["2*{i}", 0]}})
    )

    assert list(found.bodies) == ["p0_a", "p0_b", "p1_a", "p1_b", "p2_a", "p2_b"]
    assert len(found.joints) == 9


def test_its_bodies_stand_where_it_is_placed_and_its_joints_behind_all_others() -> None:
    joints = {"own": {"type": "rope", "ends": ["ball", "left_a"]}}
    bodies = {"ball": DISC, "left": {"copy": "pair"}, "last": DISC}
    found = read(level(bodies=bodies, joints=joints))

    assert list(found.bodies) == ["ball", "left_a", "left_b", "last"]
    assert list(found.joints) == ["own", "left_rod", "left_hook", "left_rail"]


def test_a_joint_of_a_group_may_hold_on_to_what_is_outside() -> None:
    tie = {"type": "rope", "ends": [{"body": "a", "at": [0.1, 0]}, "post"]}
    group = {"bodies": {"a": DISC}, "joints": {"tie": tie}}
    found = read(level(groups={"pair": group}, bodies={"post": DISC, "one": {"copy": "pair"}}))

    assert list(bodies_of(found.joints["one_tie"])) == ["one_a", "post"]


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"bodies": {"x": {"copy": "pari"}}}, "unknown group 'pari'; did you mean 'pair'?"),
        ({"bodies": {"x": {"copy": 5}}}, "unknown group '5'"),
        ({"bodies": {"x": {"copy": "pair", "mass": 2}}}, "unknown key 'mass' of a copy of a group"),
        ({"bodies": {"x": {"copy": "pair", "position": [0]}}}, "must be two numbers"),
        ({"bodies": {"x": {"copy": "pair", "angle": [0]}}}, "must be a number"),
        ({"bodies": {"ball": DISC}}, "this group is never placed"),
        ({"groups": 5, "bodies": {"ball": DISC}}, "must be an object"),
        ({"groups": {"pair": {}}}, "'bodies' is missing"),
        ({"groups": {"pair": DUMBBELL | {"checks": []}}}, "unknown key 'checks'; known: bodies"),
        ({"groups": {"pair": {"bodies": {"a": {"copy": "pair"}}}}}, "cannot contain another one"),
        ({"bodies": {"x_a": DISC, "x": {"copy": "pair"}}}, "there are two of 'x_a'"),
        ({"bodies": {"x": {"copy": "pair", "position": ["q", 0]}}}, "unknown parameter 'q'"),
    ],
)
def test_a_mistake_is_told(changes: Data, rule: str) -> None:
    assert rule in told(level(**{"bodies": {"x": {"copy": "pair"}}, **changes}))


def test_a_mistake_within_a_group_is_told_where_it_is_typed() -> None:
    group = {"bodies": {"a{i}": DISC | {"repeat": {"i": 2}, "mass": 0}}}
    data = level(groups={"pair": group}, bodies={"x": {"copy": "pair"}, "y": {"copy": "pair"}})
    typed = json.dumps(data, indent=1).splitlines()
    line = next(i for i, text in enumerate(typed, 1) if '"mass": 0' in text)

    assert told(data).startswith(f"<text>:{line}:6: bodies.x_a0.mass: is 0, but must be greater")
    assert told(data).count("\n") == 0, "once for all copies"


def test_every_field_of_a_joint_that_has_a_place_is_turned() -> None:
    """Otherwise a new kind of joint with another pair of numbers would be placed wrongly."""
    for joint in get_args(get_args(Joint)[0]):
        for name, field in joint.model_fields.items():
            told = str(field.annotation)
            lies = any(word in told for word in ("Coordinate", "Held", "Curve"))
            assert name in TURNED or not lies, f"{joint.__name__}.{name}"


def test_a_stop_of_a_group_that_is_turned_lets_turn_as_far_from_where_it_stands() -> None:
    ends = [[0, 0], "door"]
    stop = {"type": "angle_stop", "ends": ends, "range": [-0.5, "0.25"]}
    inner = {"type": "angle_stop", "ends": ["frame", "door"], "range": [-0.5, 0.25]}
    group = {"bodies": {"door": DISC, "frame": DISC}, "joints": {"stop": stop, "inner": inner}}
    data: dict[str, Any] = {**bare(), "groups": {"g": group}}
    data["effects"] = {**data.get("effects", {}), "rotation": {}}
    data["bodies"]["k"] = {"copy": "g", "angle": 2, "position": [5, 5]}

    joints = read(data).joints

    stops = {name: joint for name, joint in joints.items() if isinstance(joint, AngleStop)}
    angles = {name: [angle(VALUES) for angle in stop.range] for name, stop in stops.items()}
    assert angles == {"k_stop": [1.5, 2.25], "k_inner": [-0.5, 0.25]}


@pytest.mark.sweep
def test_many_copies_of_a_large_group_exhaust_no_machine() -> None:
    group: Any = {"bodies": {"a{i}": DISC | {"repeat": {"i": 200}}}}
    data = level(groups={"pair": group}, bodies={"x{i}": {"repeat": {"i": 20_000}, "copy": "pair"}})

    assert "more than 5,000,000 characters when it is expanded" in told(data)


def test_a_motion_in_a_group_is_turned_with_it() -> None:
    slide = {"type": "kinematic", "shape": DISC["shape"], "motion": {"displacement": ["t", 0]}}
    data = {**bare(), "groups": {"g": {"bodies": {"slide": slide}}}}
    data["bodies"]["k"] = {"copy": "g", "angle": "90*deg", "position": [5, 5]}

    motion = read(data).bodies["k_slide"].motion

    assert motion is not None
    x, y = (float(formula.over(VALUES, np.array([2.0]))[0]) for formula in motion.displacement)
    assert x == pytest.approx(0, abs=1e-15)
    assert y == 2


@pytest.mark.parametrize(
    "bodies",
    [
        {"k": {"copy": "crowd", "angle": "0*" + "1" * 100_000}},
        {"b{i}" + "A" * 100_000: {"repeat": {"i": 1000}, "mass": 1}},
    ],
)
def test_what_would_fill_the_memory_is_refused_before_it_is_written_out(bodies: Data) -> None:
    crowd = {f"b{i}": DISC | {"velocity": [1, 0]} for i in range(100)}
    data = level(groups={"crowd": {"bodies": crowd}}, bodies=bodies)

    assert "more than 5,000,000 characters" in told(data)


def test_a_name_of_a_group_that_is_none_is_told_by_itself() -> None:
    group = {"bodies": {"at": 1.5}, "joints": {"axle{i}": {}}}

    assert "'k_axle{i}' is not a name" in told(
        {"groups": {"g": group}, "bodies": {"k": {"copy": "g"}}}
    )
