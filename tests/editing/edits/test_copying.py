"""Copies and mirror images: new names, the joints among them, and levels that load."""

import json

import pytest

from sandbox.editing.bodies_at_start import bounding_box, placed
from sandbox.editing.draft import Draft
from sandbox.editing.edits.copying import copy, duplicate, paste
from sandbox.editing.edits.mirroring import mirror
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.joints import bodies_of
from sandbox.model.loading import parse, read
from sandbox.physics.run import build
from tests.sample import sampled

LEVELS = [
    *level_catalog.textbook()[::3],
    *(f"machines/{n}" for n in ("ragdoll", "scissor-lift", "crane")),
]


@pytest.mark.parametrize("name", sampled(LEVELS, "beside"))
def test_a_whole_level_can_be_put_beside_itself(name: str) -> None:
    text = expanded(read(level_catalog.find(name)))
    level = parse(text)
    pasted = duplicate(text, level, list(level.bodies), (100, 0))
    after = parse(pasted.text)
    assert len(after.bodies) == 2 * len(level.bodies)
    assert set(pasted.names) == set(after.bodies) - set(level.bodies)
    free = sum(not set(bodies_of(joint)) for joint in level.joints.values())
    assert len(after.joints) == 2 * len(level.joints) - free
    old, new = placed(level), placed(after)
    for one, other in zip(level.bodies, pasted.names, strict=True):
        assert new[other].center == pytest.approx(old[one].center + 100)


def test_copies_are_joined_to_each_other_and_not_to_the_first() -> None:
    text = read(level_catalog.find("newton/atwood"))
    level = parse(text)
    after = parse(duplicate(text, level, ["left", "right"], (3, 0)).text)
    (new,) = set(after.joints) - set(level.joints)
    assert set(bodies_of(after.joints[new])) == {"left1", "right1"}
    assert after.joints["string"] == level.joints["string"]
    alone = parse(duplicate(text, level, ["left"], (3, 0)).text)
    assert list(alone.joints) == ["string"]


@pytest.mark.parametrize("name", sampled(LEVELS, "paste"))
def test_what_is_copied_can_be_pasted_into_an_empty_scene(name: str) -> None:
    text = expanded(read(level_catalog.find(name)))
    level = parse(text)
    empty = Draft.empty().text
    pasted = paste(empty, parse(empty), copy(text, level, list(level.bodies)))
    after = parse(pasted.text)
    assert len(after.bodies) == len(level.bodies) + 1


def swing(mass: float, unit: str = "kg") -> str:
    """A ball whose mass and place come from a parameter and constants."""
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": "m", "position": ["2*r", "r + m"]}
    return json.dumps(
        {
            "format": 1,
            "title": "T",
            "parameters": {"m": {"value": mass, "min": 0.1, "max": 9, "unit": unit}},
            "constants": {"r": "3*m"},
            "bodies": {"ball": ball},
        }
    )


def test_a_pasted_parameter_keeps_its_value_beside_one_of_the_same_name() -> None:
    text, other = swing(1), swing(2)
    pasted = parse(paste(text, parse(text), copy(other, parse(other), ["ball"])).text)
    assert {name: one.value for name, one in pasted.parameters.items()} == {"m": 1, "m1": 2}
    assert {name: one.source for name, one in pasted.constants.items()} == {
        "r": "3*m",
        "r1": "3*m1",  # it uses another mass, so it is another number, too
    }
    old, new = (placed(pasted)[name] for name in ("ball", "ball1"))
    assert (old.center, new.center) == (6 + 4j, 12 + 8j)
    assert str(pasted.bodies["ball1"].mass.source) == "m1"  # type: ignore[union-attr]


def test_a_pasted_parameter_that_is_the_same_is_shared() -> None:
    text = swing(1)
    pasted = parse(paste(text, parse(text), copy(text, parse(text), ["ball"])).text)
    assert list(pasted.parameters) == ["m"]
    assert list(pasted.constants) == ["r"]


def test_a_parameter_with_another_unit_is_another() -> None:
    text, other = swing(1), swing(1, "g")
    pasted = parse(paste(text, parse(text), copy(other, parse(other), ["ball"])).text)
    assert list(pasted.parameters) == ["m", "m1"]


@pytest.mark.parametrize("copied", ["", "{}", "[1]", '{"bodies": 3}', "hello"])
def test_what_is_no_level_is_not_pasted(copied: str) -> None:
    empty = Draft.empty().text
    with pytest.raises(SandboxError, match="not part of a level"):
        paste(empty, parse(empty), copied)


@pytest.mark.parametrize("name", sampled(LEVELS, "mirror"))
@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_mirror_image_of_all_is_as_wide_and_mirrored_again_the_same(name: str, axis: str) -> None:
    text = expanded(read(level_catalog.find(name)))
    level = parse(text)
    once = mirror(text, level, list(level.bodies), axis)  # type: ignore[arg-type]
    image = parse(once)
    box = bounding_box(placed(level).values())
    assert bounding_box(placed(image).values()) == pytest.approx(box, abs=1e-9)
    twice = parse(mirror(once, image, list(level.bodies), axis))  # type: ignore[arg-type]
    for body, one in placed(twice).items():
        other = placed(level)[body]
        assert one.center == pytest.approx(other.center, abs=1e-9)
        assert one.corners == pytest.approx(other.corners, abs=1e-9)


def test_a_mirrored_run_is_the_mirror_image_of_the_run() -> None:
    text = read(level_catalog.find("machines/trebuchet"))
    level = parse(text)
    image = parse(mirror(text, level, list(level.bodies)))
    low, high = bounding_box(placed(level).values())
    one, other = (build(scene).advance(30).position for scene in (level, image))
    assert other[:, 0] == pytest.approx((low + high).real - one[:, 0], abs=1e-6)
    assert other[:, 1] == pytest.approx(one[:, 1], abs=1e-6)


@pytest.mark.parametrize(
    ("shape", "hand"),
    [
        ({"type": "segment", "start": [-1, 0], "end": [1, 0]}, "right"),
        ({"type": "arc", "radius": 1, "start": 0, "end": 2}, "left"),
    ],
)
def test_the_mirror_image_of_a_one_way_line_holds_on_the_mirrored_side(
    shape: dict[str, object], hand: str
) -> None:
    """A segment runs the other way round in a mirror; an arc runs counter-clockwise there, too."""
    line = {"type": "static", "shape": shape, "one_way": "left"}
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": [0, 5]}
    bodies = {"line": line, "ball": ball}
    text = json.dumps({"format": 1, "title": "T", "effects": {"contact": {}}, "bodies": bodies})

    mirrored = parse(mirror(text, parse(text), ["line"]))
    assert mirrored.bodies["line"].one_way == hand
