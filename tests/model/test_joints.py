# ruff: noqa: E501 (a table is read by its rows)
"""Joints, drags and forces: mistakes are refused with their name and rule."""

import json
from typing import Any

import pytest

from tests.model.levels import mistakes_in, said
from tests.physics.scenes import GRAVITY, disc, fixed

HOOK = {"type": "disc", "radius": 0.1}


def tied(joint: dict[str, Any], **effects: object) -> list[str]:
    """Return the mistakes of a ball and a block, 5 m apart, tied by a joint."""
    data = {
        "format": 1,
        "title": "Tied",
        "effects": {**GRAVITY, **effects},
        "bodies": {
            "ball": disc(),
            "block": disc((3, 4)),
            "wall": fixed(HOOK, (0, 4)),
            "post": fixed(HOOK, (9, 9)),
        },
        "joints": {"tie": joint},
    }
    return said(mistakes_in(json.dumps(data)))


def joint(kind: str, *ends: object, **rest: object) -> dict[str, Any]:
    return {"type": kind, "ends": list(ends) or ["ball", "block"], **rest}


AT = {"body": "block", "at": [0.1, 0]}


def wire(
    x: str = "3 + s",
    y: str = "4 - s**2",
    first: float = -1,
    last: float = 1,
    bead: object = "block",
) -> dict[str, Any]:
    return {"type": "wire", "bead": bead, "curve": [x, y], "s": [first, last]}


@pytest.mark.parametrize(
    "made",
    [
        joint("rod"),
        joint("rod", length=5),
        joint("rod", length="5 - t/4"),
        joint("rod", [0, 1], AT),
        joint("rope", length=6),
        joint("spring", stiffness=0),
        joint("spring", "ball", AT, stiffness=3, length=0, damping=1),
        joint("pulley", "ball", [1, 1], over=["block", "wall"]),
        joint("pivot", [3, 4], "block"),
        joint("rail", direction=[-30, -40]),
        joint("rail", "ball", [7, 0], direction=["sqrt(2)", 0]),
        joint("pivot", "ball", {"body": "block", "at": [-3, -4]}),
        wire(),
        wire("3.1 + s", bead=AT),
        wire("5*cos(s)", "5*sin(s)", 0, 7, bead={"body": "block"}) | {"s": [0, "2*pi"]},
        wire("3 + 3*s", "4 + asin(0.95*sin(9*s))"),
        joint("weld"),
        joint("weld", "ball", [1, 1]),
        joint("winding", "ball", "wall", radius=0.1, unwinds="clockwise"),
        joint("pulley", over=[{"body": "wall", "at": [-1, 0]}, {"body": "wall", "at": [1, 0]}]),
    ],
    ids=str,
)
def test_what_makes_sense_is_let_through(made: dict[str, Any]) -> None:
    assert not tied(made)


@pytest.mark.parametrize(
    ("made", "told"),
    [
        (joint("rod", "ball", "blok"), "joints.tie.ends.1: unknown body 'blok'; did you mean 'block'?"),
        (joint("rod", "ball", {"body": "blok"}), "joints.tie.ends.1.body: unknown body 'blok'; did you mean 'block'?"),
        (joint("pulley", over=["wal"]), "joints.tie.over.0: unknown body 'wal'; did you mean 'wall'?"),
        (joint("rod", "ball", {"body": "ball", "at": [1, 0]}), "joints.tie.ends: 'ball' is connected to itself"),
        (joint("pulley", over=["ball"]), "joints.tie.ends: 'ball' is connected to itself"),
        (joint("rod", [0, 0], "wall"), "joints.tie.ends: at least one end must be a dynamic body"),
        (joint("rod", [0, 0], "ball"), "joints.tie.length: a rod cannot be 0 m long"),
        (joint("rod", length=4), "joints.tie.length: the rod is 4 m long at the start, but its ends are 5 m apart"),
        (joint("rod", length="4 + t"), "joints.tie.length: the rod is 4 m long at the start, but its ends are 5 m apart"),
        (joint("rope", length=4), "joints.tie.length: the string is 4 m long, but its path is 5 m"),
        (joint("pivot"), "joints.tie.ends: the two ends of a pivot must coincide, but they are 5 m apart"),
        (joint("rail"), "joints.tie.direction: 'direction' is missing"),
        (joint("rail", direction=[0, 0]), "joints.tie.ends: a rail needs a 'direction' that is not [0, 0]"),
        (joint("rail", direction=[1, 0]), "joints.tie.ends: the first end must start on the rail, but it is 4 m away from it"),
        (joint("rail", [0, 1], "wall", direction=[0, 1]), "joints.tie.ends: at least one end must be a dynamic body"),
        (joint("weld", "wall", [1, 1]), "joints.tie.ends: at least one end must be a dynamic body"),
        (joint("weld", "ball", "bal"), "joints.tie.ends.1: unknown body 'bal'; did you mean 'ball'?"),
        (joint("motor", rate=1), "joints.tie: 'motor' is used but the effect 'rotation' is not declared"),
        (joint("motor", rate=1), "joints.tie.ends: the two ends of a motor must coincide, but they are 5 m apart"),
        (joint("motor", [0, 0], "ball"), "joints.tie.rate: 'rate' is missing"),
        (joint("winding", radius=1, unwinds="clockwise"), "joints.tie: 'winding' is used but the effect 'rotation' is not declared"),
        (joint("winding", radius=5, unwinds="clockwise"), "joints.tie.ends: the string's end is 5 m from the wheel's centre, within its radius of 5 m; it must lie outside"),
        (joint("winding", radius=1, unwinds="clockwis"), "joints.tie.unwinds: must be 'clockwise' or 'counterclockwise'; did you mean 'clockwise'?"),
        (joint("winding", radius=0, unwinds="clockwise"), "joints.tie.radius: is 0, but must be greater than 0"),
        (joint("winding", "ball", [1, 1], radius=1, unwinds="clockwise"), "joints.tie.ends.1: must be a text in double quotes"),
        (joint("winding", "ball", "blok", radius=1, unwinds="clockwise"), "joints.tie.ends.1: unknown body 'blok'"),
        (joint("winding", "ball", "ball", radius=1, unwinds="clockwise"), "joints.tie.ends: 'ball' is connected to itself"),
        (joint("spring"), "joints.tie.stiffness: 'stiffness' is missing"),
        (joint("spring", stiffness=-1), "joints.tie.stiffness: is -1, but must be at least 0"),
        (joint("sprig", stiffness=1), "joints.tie: unknown type 'sprig'; did you mean 'spring'?"),
        (joint("rod", [0, 0], 3), "joints.tie.ends.1: must be a body's name, a point of one"),
        (joint("rod", "ball", {"body": "block", "att": [1, 1]}), "joints.tie.ends.1.att: unknown key 'att'; did you mean 'at'?"),
        (wire(bead="blok"), "joints.tie.bead: unknown body 'blok'; did you mean 'block'?"),
        (wire(bead={"body": "blok"}), "joints.tie.bead.body: unknown body 'blok'; did you mean 'block'?"),
        (wire(bead="wall"), "joints.tie.bead: the bead must be a dynamic body"),
        (wire(bead=[3, 4]), "joints.tie.bead: the bead must be a dynamic body"),
        (wire("3 + u"), "joints.tie.curve.0: unknown parameter 'u'; known: s"),
        (wire("3 + t"), "joints.tie.curve.0: the time 't' has no meaning here"),
        (wire(first=1), "joints.tie.curve: 's' must increase, but it goes from 1 to 1"),
        (wire("3 + s*0", "4"), "joints.tie.curve: the wire does not advance with s at [3, 4]"),
        (wire("3 + sqrt(s)"), "joints.tie.curve: the wire has no finite point at s = -1"),
        (wire(y="4 - abs(s)"), "joints.tie.curve: the wire must not have sharp corners, but has one at [3, 4]"),
        (wire("5*cos(s)", "5*abs(sin(s))", -3.14159265358979, 3.14159265358979), "joints.tie.curve: the wire must not have sharp corners, but has one at ["),
        (wire("3 + sin(2*s)", "4 - sin(s)", -1, 4), "joints.tie.curve: the wire must not cross itself, but it does near [2.99, 4]"),
        (wire("4 + s"), "joints.tie.curve: the bead must start on the wire, but it is 0.537841 m away"),
        (wire("3 + s", "4 - s**2", 0.5), "joints.tie.curve: the bead must start on the wire, but it is 0.559"),
    ],
    ids=str,
)  # fmt: skip
def test_what_makes_no_sense_is_told(made: dict[str, Any], told: str) -> None:
    assert any(mistake.startswith(told) for mistake in tied(made)), tied(made)


@pytest.mark.parametrize(
    ("effects", "told"),
    [
        ({"drag": {}}, "effects.drag: needs 'linear' or 'quadratic' greater than 0"),
        ({"drag": {"linear": 1, "bodies": ["bal"]}}, "effects.drag.bodies.0: unknown body 'bal'; did you mean 'ball'?"),
        ({"drag": {"linear": 1, "bodies": ["wall"]}}, "effects.drag.bodies.0: 'wall' is static, so no force moves it"),
        ({"drag": {"linear": 1, "bodies": ["ball", "ball"]}}, "effects.drag.bodies: a body is named twice"),
        ({"force": [{"body": "wall", "force": [1, 0]}]}, "effects.force.0.body: 'wall' is static, so no force moves it"),
        ({"force": [{"body": "blok", "force": [1, 0]}]}, "effects.force.0.body: unknown body 'blok'"),
        ({"force": [{"body": "ball", "force": [1, "s*t"]}]}, "effects.force.0.force.1: unknown parameter 's'"),
        ({"force": [{"body": "ball", "force": [1, 0], "frame": "bodi"}]}, "effects.force.0.frame: must be 'world' or 'body'; did you mean 'body'?"),
        ({"sticking": {"pairs": [{"bodies": ["ball", "block"]}]}}, "effects.sticking: 'sticking' needs the effect 'contact'"),
        ({"contact": {}, "restitution": {"impacts": "sequence"}, "sticking": {"pairs": [{"bodies": ["ball", "block"]}]}}, "effects.sticking: 'sticking' cannot be combined with impacts in 'sequence'"),
        ({"contact": {}, "sticking": {"pairs": []}}, "effects.sticking.pairs: has 0 entries, but needs at least 1"),
        ({"contact": {}, "sticking": {"pairs": [{"bodies": ["ball", "blok"]}]}}, "effects.sticking.pairs.0.bodies.1: unknown body 'blok'; did you mean 'block'?"),
        ({"contact": {}, "sticking": {"pairs": [{"bodies": ["ball", "ball"]}]}}, "effects.sticking.pairs.0.bodies: 'ball' is named twice"),
        ({"contact": {}, "sticking": {"pairs": [{"bodies": ["wall", "post"]}]}}, "effects.sticking.pairs.0: at least one of the two must be a dynamic body"),
        ({"contact": {}, "sticking": {"pairs": [{"bodies": ["ball", "block"]}, {"bodies": ["block", "ball"]}]}}, "effects.sticking.pairs.1: the pair block and ball is already named"),
        ({"contact": {}, "restitution": {"pairs": [{"bodies": ["block", "ball"], "coefficient": 1}]}, "sticking": {"pairs": [{"bodies": ["ball", "block"]}]}}, "effects.restitution.pairs.0: these bodies stick together when they touch, so they do not bounce"),
        ({"rotation": {}}, "effects.rotation: 'rotation' is declared but nothing turns a body"),
    ],
    ids=str,
)  # fmt: skip
def test_an_effect_that_makes_no_sense_is_told(effects: dict[str, Any], told: str) -> None:
    found = tied(joint("rod"), **effects)

    assert any(mistake.startswith(told) for mistake in found), found


def test_a_parameter_is_not_called_as_what_runs_along_a_wire() -> None:
    data = {
        "format": 1,
        "title": "Bead",
        "parameters": {"s": {"value": 1, "min": 0, "max": 2}},
        "effects": {"gravity": {"acceleration": [0, "-s"]}},
        "bodies": {"block": disc((3, 4))},
        "joints": {"tie": wire()},
    }
    told = "parameters.s: 's' is the parameter along the wires; choose another name"
    assert said(mistakes_in(json.dumps(data))) == [told]


def test_a_wire_must_hold_over_the_whole_ranges_of_the_parameters() -> None:
    data = {
        "format": 1,
        "title": "Bead",
        "parameters": {"a": {"value": 1, "min": 0, "max": 2}},
        "effects": GRAVITY,
        "bodies": {"block": disc((3, 4))},
        "joints": {"tie": wire("3 + s", "4 + a - hypot(s, a)")},
    }
    told = (
        "joints.tie.curve: the wire must not have sharp corners, but has one at [3, 4] when a = 0"
    )
    assert said(mistakes_in(json.dumps(data))) == [told]


def test_a_parameter_that_only_a_force_of_time_uses_is_used_by_the_scene() -> None:
    data = {
        "format": 1,
        "title": "Pushed",
        "parameters": {"F": {"value": 1, "min": 0, "max": 2}},
        "effects": {"force": [{"body": "ball", "force": ["F*t", 0]}]},
        "bodies": {"ball": disc()},
    }
    assert not mistakes_in(json.dumps(data))


@pytest.mark.parametrize(
    "made",
    [
        joint("rod", exact=False),
        joint("rope", exact=False, length=6),
        joint("pivot", [3, 4], "block", exact=False),
    ],
)
def test_pymunks_own_joints_may_be_asked_for(made: dict[str, Any]) -> None:
    assert tied(made) == []


@pytest.mark.parametrize(
    ("made", "effects", "rule"),
    [
        (joint("rod", exact=False, length="5 - t"), {}, "joints.tie.exact: only an exact joint can change with the time 't'; leave out 'exact'"),
        (joint("motor", [0, 0], "ball", exact=False, rate="t"), {"rotation": {}}, "joints.tie.exact: only an exact joint can change with the time 't'; leave out 'exact'"),
        (joint("rod", exact=False), {"contact": {}, "sticking": {"pairs": [{"bodies": ["ball", "wall"]}]}}, "joints.tie.exact: 'ball' is also held exactly; what holds a body must be all exact, or all pymunk's own"),
        (joint("rod", exact=False), {"contact": {}, "restitution": {"impacts": "sequence", "pairs": [{"bodies": ["ball", "block"], "coefficient": 1}]}}, "joints.tie.exact: impacts in 'sequence' need exact joints; leave out 'exact'"),
    ],
)  # fmt: skip
def test_what_pymunks_own_joints_cannot_do_is_refused(
    made: dict[str, Any], effects: dict[str, Any], rule: str
) -> None:
    assert rule in tied(made, **effects)
