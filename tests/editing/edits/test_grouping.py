"""Groups: made, taken apart, and kept by every other edit of a level."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.editing.edits.bodies import remove_parts
from sandbox.editing.edits.copying import duplicate
from sandbox.editing.edits.grouping import group, group_of, ungroup
from sandbox.editing.edits.mirroring import mirror
from sandbox.editing.renaming import rename
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.run import build

NAMES = ("a", "b", "c", "d")


def scene(**view: object) -> str:
    """Four discs in a row."""
    bodies = {
        name: {"shape": {"type": "disc", "radius": 0.4}, "mass": 1, "position": [i, 0]}
        for i, name in enumerate(NAMES)
    }
    said = {"format": 1, "title": "Four", "effects": {"gravity": {"acceleration": [0, -1]}}}
    shown = {"view": view} if view else {}
    return json.dumps({**said, "bodies": bodies, **shown}, indent=2)


def grouped(*groups: str) -> tuple[str, Level]:
    text = scene(together=[list(names) for names in groups])
    return text, parse(text)


def together(text: str) -> list[str]:
    return ["".join(names) for names in parse(text).view.together]


def test_bodies_become_a_group_and_are_taken_apart_again() -> None:
    for text in (scene(), scene(width=5)):
        made = group(text, parse(text), ["c", "a"])

        assert together(made) == ["ac"]
        assert parse(ungroup(made, parse(made), ["a"])) == parse(text)


def test_who_joins_another_group_leaves_the_first() -> None:
    text, level = grouped("abc")
    made = group(text, level, ["c", "d"])

    assert together(made) == ["ab", "cd"]
    assert together(group(made, parse(made), ["b", "c"])) == ["bc"]


def test_a_body_is_selected_with_its_group_or_alone() -> None:
    _, level = grouped("ab")

    assert group_of(level, "b") == ("a", "b")
    assert group_of(level, "d") == ("d",)


@pytest.mark.sweep
@given(st.lists(st.lists(st.sampled_from(NAMES), min_size=2, unique=True), max_size=6))
def test_no_body_is_ever_in_two_groups(chosen: list[list[str]]) -> None:
    text = scene()
    for names in chosen:
        text = group(text, parse(text), names)
    told = [name for one in parse(text).view.together for name in one]

    assert len(told) == len(set(told))


def test_what_is_taken_out_leaves_its_group_and_the_last_one_takes_it_along() -> None:
    text, level = grouped("abc")
    left = remove_parts(text, level, ["a"])

    assert together(left) == ["bc"]
    alone = parse(remove_parts(left, parse(left), ["b"]))
    assert alone.view.together == ()
    assert list(alone.bodies) == ["c", "d"]


def test_what_is_taken_out_leaves_those_that_it_was_kept_apart_from_touching() -> None:
    said = json.loads(scene())
    said["effects"]["contact"] = {"apart": [["a", "b", "c"], ["a", "d"]]}
    text = json.dumps(said)
    contact = parse(remove_parts(text, parse(text), ["a"])).effects.contact

    assert contact is not None
    assert contact.apart == (("b", "c"),)


def test_copies_of_a_group_are_a_group() -> None:
    text, level = grouped("ab", "cd")
    made = duplicate(text, level, ["a", "b", "c"], (0, 3))

    assert together(made.text) == ["ab", "cd", "".join(made.names[:2])]


def test_names_and_mirrors_keep_a_group() -> None:
    text, level = grouped("ab")

    assert together(rename(text, ("bodies", "a"), "z")) == ["zb"]
    assert together(mirror(text, level, ["a", "b"])) == ["ab"]


def test_nothing_of_it_touches_the_physics() -> None:
    states = []
    for text in (scene(), grouped("abc")[0]):
        world = build(parse(text))
        world.advance(30)
        states.append(world.snapshot.position.tolist())

    assert states[0] == states[1]


def test_one_body_is_no_group_and_none_is_taken_apart_that_is_not_there() -> None:
    text, level = grouped("ab")
    with pytest.raises(SandboxError, match="at least two bodies"):
        group(text, level, ["a"])
    with pytest.raises(SandboxError, match="in a group"):
        ungroup(text, level, ["d"])


@pytest.mark.parametrize(
    ("groups", "rule"),
    [
        ([["a", "b"], ["b", "c"]], "'b' is already in another group"),
        ([["a", "x"]], "unknown body 'x'"),
        ([["a"]], r"view\.together\.0"),
    ],
)
def test_groups_that_cannot_be_are_told(groups: list[list[str]], rule: str) -> None:
    with pytest.raises(LevelError, match=rule):
        parse(scene(together=groups))
