"""Bodies that overlap at the start are a mistake, unless the level says that it wants them to."""

import re
from math import cos, pi, sin, sqrt

import pymunk
import pytest

from sandbox.physics.advising.preflight_faults import refusal
from sandbox.physics.contacts.detection import overlaps_at_start
from sandbox.physics.engine.shape_pairs import overlap
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import Spec, box, disc, fixed, floor, level

LINE: Spec = {
    "shape": {"type": "segment", "start": [-1, 0], "end": [1, 0]},
    "mass": 1,
    "position": [0, 0.4],
}
HOOP: Spec = {"type": "hoop", "radius": 1}
HALF: Spec = {"type": "arc", "radius": 1, "start": "180*deg", "end": "360*deg"}


def refused(bodies: dict[str, Spec], **contact: object) -> str:
    """Return why bodies may not start, nothing if they may."""
    error = refusal(level(bodies, {"contact": contact}))
    return error.reason if error else ""


@pytest.mark.parametrize(
    ("bodies", "depth"),
    [
        ({"a": disc((0, 0.4)), "b": floor()}, 0.1),
        ({"a": disc(), "b": disc((0.9, 0))}, 0.1),
        ({"a": box(), "b": box((0.3, 0.1))}, 0.2),
        ({"a": box((0, 0.2)), "b": floor()}, 0.05),
        ({"a": box((0, 0.2), angle=0.1), "b": floor()}, 0.25 * (cos(0.1) + sin(0.1)) - 0.2),
        ({"a": box((0, 0.7)), "b": fixed({"type": "disc", "radius": 0.5})}, 0.05),
        ({"a": LINE, "b": fixed({"type": "disc", "radius": 0.5})}, 0.1),
        ({"a": disc((0.6, 0)), "b": fixed(HOOP)}, 0.1),
        ({"a": disc((1.4, 0)), "b": fixed(HOOP)}, 0.1),
        ({"a": disc((0, -0.6)), "b": fixed(HALF)}, 0.1),
        ({"a": box((0, 0.75), size=(0.1, 0.7)), "b": fixed(HOOP)}, sqrt(1.1**2 + 0.05**2) - 1),
    ],
)
def test_an_overlap_is_told_with_both_names_and_its_depth(
    bodies: dict[str, Spec], depth: float
) -> None:
    reason = refused(bodies)

    assert reason.startswith(f"'a' and 'b' overlap by {depth:.3g} m at the start; move them apart")
    assert refused(bodies, overlaps=True) == ""


@pytest.mark.parametrize(
    "bodies",
    [
        {"a": disc((0, 0.5)), "b": floor()},
        {"a": disc((0, 0.5 - 9e-7)), "b": floor()},
        {"a": disc((0.5, 0)), "b": fixed(HOOP)},
        {"a": disc((0, 0.2)), "b": fixed(HALF)},
        {"a": {"shape": HALF, "mass": 1, "position": [0, 2], "angle": pi + 0.2}, "b": floor(0)},
        {"a": fixed({"type": "disc", "radius": 1}), "b": fixed(HOOP), "c": disc((5, 0))},
        {"a": box((0, 0), size=(sqrt(2), sqrt(2))), "b": fixed(HOOP)},
        {"a": fixed(HALF), "b": fixed(HALF), "c": disc((5, 0))},
        {
            "a": {"shape": HALF, "mass": 1},
            "b": {"shape": HALF, "mass": 1, "angle": pi, "position": [0, 4 / pi]},
        },
    ],
    ids=[
        "touching",
        "by a micrometre",
        "in a hoop",
        "above a hollow",
        "above a long floor",
        "static",
        "inscribed",
        "static arcs",
        "arcs end to end",
    ],
)
def test_what_only_touches_does_not_overlap(bodies: dict[str, Spec]) -> None:
    assert refused(bodies) == ""


def test_what_is_welded_may_overlap_and_what_is_pinned_may_not() -> None:
    bodies = {"a": box(), "b": box((0.3, 0))}
    ends = [{"body": "a", "at": [0.15, 0]}, {"body": "b", "at": [-0.15, 0]}]
    scenes = {
        kind: level(
            bodies,
            {"contact": {}, "rotation": {}},
            joints={"joint": {"type": kind, "ends": ends}},
        )
        for kind in ("weld", "pivot")
    }

    assert refusal(scenes["weld"]) is None
    assert "'a' and 'b' overlap by 0.2 m" in str(refusal(scenes["pivot"]))


def test_the_values_of_the_parameters_that_bring_bodies_together_are_told() -> None:
    scene = level(
        {"a": disc(), "b": {**disc(mass=1), "position": ["x", "y"]}},
        {"contact": {}},
        parameters={
            "x": {"value": 2, "min": 0.75, "max": 3},
            "y": {"value": 0, "min": 0, "max": 2},
        },
    )

    assert "overlap by 0.25 m" in str(refusal(scene))
    assert str(refusal(scene)).endswith("when x = 0.75")


def test_a_world_does_not_start_with_an_overlap_and_says_where_it_stands() -> None:
    scene = level({"floor": floor(), "ball": disc((0, 0.3))}, {"contact": {}})

    with pytest.raises(SimulationError, match=r"'ball' and 'floor' overlap by 0\.2 m") as told:
        build(scene)
    assert told.value.place


def test_an_overlap_is_found_whatever_the_rate_that_an_accuracy_takes() -> None:
    scene = level(
        {"floor": floor(), "ball": disc((0, 0.3))}, {"contact": {}}, stepping={"accuracy": 1e-3}
    )

    assert refusal(scene)


@pytest.mark.parametrize("solver", ["iterative", "direct"])
@pytest.mark.parametrize("depth", [2e-5, 1e-3, 0.05])
def test_an_overlap_is_a_mistake_however_shallow_and_whoever_solves_contacts(
    solver: str, depth: float
) -> None:
    bodies = {"ball": disc((0, 0.5 - depth)), "floor": floor()}

    told = f"'ball' and 'floor' overlap by {depth:.3g} m"
    assert refused(bodies, solver=solver).startswith(told)


SQUARE, ROUND = box(size=(0.6, 0.6)), disc(radius=0.3)
LYING = {**LINE, "position": [0, 0]}
BENT: Spec = {"shape": HALF, "mass": 1}
TURNED: Spec = {**BENT, "angle": 3, "position": [2 / pi * sin(3), 2 / pi * (1 - cos(3))]}


@pytest.mark.parametrize("solver", ["iterative", "direct"])
@pytest.mark.parametrize("wanted", [False, True])
@pytest.mark.parametrize(
    ("bodies", "depth"),
    [
        ((SQUARE, SQUARE), 0.6),
        ((SQUARE, ROUND), 0.6),
        ((SQUARE, LYING), 0.3),
        ((LYING, fixed({"type": "segment", "start": [-3, 0], "end": [5, 0]})), 0),
        ((BENT, BENT), 0),
        ((BENT, TURNED), 0),
    ],
    ids=["boxes", "disc in box", "line in box", "lines", "arcs", "parts of arcs"],
)
def test_what_lies_in_each_other_has_no_way_to_part_and_is_refused(
    bodies: tuple[Spec, Spec], depth: float, *, wanted: bool, solver: str
) -> None:
    """pymunk finds no contact of boxes with the same centre: they stayed so, and fell through."""
    scene = {"a": bodies[0], "b": bodies[1]}
    reason = refused(scene, overlaps=wanted, solver=solver)

    told = re.match(r"'a' and 'b' lie in each other at the start, (\S+) m deep", reason)
    assert told
    assert float(told[1]) == pytest.approx(depth, abs=2e-8)  # two skins


@pytest.mark.parametrize("solver", ["iterative", "direct"])
@pytest.mark.parametrize("shape", [ROUND["shape"], HOOP])
def test_discs_in_one_place_part(shape: Spec, solver: str) -> None:
    """Solved directly, their normal was not finite, and they stayed where they were."""
    bodies = {name: {"shape": shape, "mass": 1, "friction": 0.5} for name in "ab"}
    scene = level(bodies, {"contact": {"overlaps": True, "solver": solver}, "friction": {}})
    end = build(scene).advance(60).position

    assert abs(complex(*(end[1] - end[0]))) == pytest.approx(2 * shape["radius"], rel=1e-4)
    assert end.sum(axis=0) == pytest.approx(0, abs=1e-12)


def test_what_hardly_lies_apart_is_parted() -> None:
    """However near the centres are: a direction is enough."""
    scene = {"a": SQUARE, "b": {**SQUARE, "position": [1e-9, 0]}}

    assert "overlap by 0.6 m" in refused(scene)
    assert refused(scene, overlaps=True) == ""


def test_each_pair_is_looked_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """300 polygons in one place took 2.9 s, as each pair was found from both of its shapes."""
    asked: list[tuple[object, object]] = []

    def counted(one: pymunk.Shape, other: pymunk.Shape) -> tuple[bool, float] | None:
        asked.append((one, other))
        return overlap(one, other)

    monkeypatch.setattr(overlaps_at_start, "overlap", counted)
    crowd = {f"b{i}": box((0.01 * i, 0)) for i in range(10)}
    build(level({**crowd, "far": box((5, 0))}, {"contact": {"overlaps": True}}))

    assert len(set(map(frozenset, asked))) == len(asked) == 10 * 9 // 2
