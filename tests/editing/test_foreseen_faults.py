"""The faults of an edit that was not made yet are those that the level would be refused for."""

import json
from functools import partial
from pathlib import Path

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits import bodies, moving_and_aligning
from sandbox.editing.edits.edit_result import EditResult
from sandbox.editing.edits.joint_creation import Pick, add_joint
from sandbox.editing.edits.resizing import drag_handle
from sandbox.editing.foreseen_faults import MOST, ForeseenFaults, Foresight, Proposed
from sandbox.editing.text_patches import Changes, put, put_all
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.sample import sampled

LEVELS = sorted(level_catalog.root().glob("*/*.json"))

Edits = Proposed[str] | Proposed[EditResult]


def scene() -> str:
    """A disc and a box above the ground, two metres apart."""
    text = Draft.empty().text
    text = bodies.add_disc(text, parse(text), (0, 3), (0.5, 3)).text
    return bodies.add_box(text, parse(text), (2, 3), (3, 4)).text


def foreseen(text: str, proposed: Edits) -> ForeseenFaults:
    found = Foresight(json.loads(text), parse(text)).of(proposed)
    assert found is not None
    return found


def told(text: str, proposed: Edits) -> list[str]:
    return [str(fault.reason) for fault in foreseen(text, proposed).faults]


def move(name: str, *by: float) -> Proposed[str]:
    return Proposed(partial(moving_and_aligning.move, names=[name], by=(by[0], by[1])), [name])


def test_a_body_that_is_moved_into_another_overlaps_it() -> None:
    (fault,) = foreseen(scene(), move("disc1", 1.75, 0.5)).faults
    assert fault.names == {"disc1", "box1"}
    assert "overlap by 0.25 m" in str(fault.reason)


def test_a_body_that_is_moved_away_overlaps_nothing_although_it_did() -> None:
    text = moving_and_aligning.move(scene(), parse(scene()), ["disc1"], (1.75, 0.5))
    assert told(text, move("disc1", -1, 0)) == []


def test_every_overlap_is_found_not_the_worst_alone() -> None:
    wide = Proposed(partial(bodies.add_box, corner=(-0.1, 2.9), opposite=(2.5, 3.5)))
    assert {name for fault in foreseen(scene(), wide).faults for name in fault.names} == {
        "box1",
        "box2",  # the one that is drawn
        "disc1",
    }


def test_a_body_grows_into_another() -> None:
    grows = partial(drag_handle, name="disc1", index=0, to=(2.25, 3.0))
    assert "'box1' and 'disc1' overlap" in told(scene(), Proposed(grows, ["disc1"]))[0]


def test_a_turned_body_overlaps_what_it_lay_on() -> None:
    text = moving_and_aligning.move(scene(), parse(scene()), ["box1"], (0, -3))
    turn = partial(moving_and_aligning.turn, names=["box1"], angle=0.3)
    assert "'box1' and 'ground' overlap" in told(text, Proposed(turn, ["box1"]))[0]


def test_a_rod_that_repeats_another_is_found_before_it_is_tied() -> None:
    ends = Pick((0, 3), "disc1"), Pick((2.5, 3.5), "box1")
    text = add_joint(scene(), parse(scene()), "rod", ends).text
    again = Proposed(partial(add_joint, kind="rod", chosen=ends), ["disc1", "box1"])
    (fault,) = foreseen(text, again).faults
    assert fault.names == {"rod2"}
    assert "is redundant" in str(fault.reason)


def test_a_rod_beside_another_is_no_fault() -> None:
    ends = Pick((0, 3), "disc1"), Pick((2.5, 3.5), "box1")
    text = add_joint(scene(), parse(scene()), "rope", ends).text
    other = Pick((0, 3), "disc1"), Pick((0, 6))
    assert told(text, Proposed(partial(add_joint, kind="rod", chosen=other), ["disc1"])) == []


def test_a_joint_that_is_refused_says_so() -> None:
    picks = Pick((0, 3), "disc1"), Pick((0, 6))
    gear = Proposed(partial(add_joint, kind="gear", chosen=picks), ["disc1"])
    assert told(scene(), gear) == ["a gear connects two wheels; pick two bodies"]


def test_bodies_that_are_joined_while_they_overlap_no_longer_collide() -> None:
    text = put_all(scene(), {("bodies", "box1", "position"): [0.5, 3.0]})
    pin = partial(add_joint, kind="pivot", chosen=[Pick((0, 3), "disc1"), Pick((0, 3), "box1")])
    assert told(text, Proposed(pin, ["disc1", "box1"])) == []


def test_bodies_that_are_kept_apart_may_overlap() -> None:
    text = put(scene(), ("effects", "contact", "apart"), [["box1", "disc1"]])
    assert told(text, move("disc1", 1.75, 0.5)) == []


def test_what_hangs_in_a_long_chain_is_looked_at_as_well() -> None:
    text, links = scene(), 2 * MOST
    made: Changes = {
        ("bodies", f"link{i}"): {
            "shape": {"type": "disc", "radius": 0.1},
            "mass": 1,
            "position": [i, 20],
        }
        for i in range(links)
    }
    ties: Changes = {
        ("joints", f"tie{i}"): {"type": "rod", "ends": [f"link{i}", f"link{i + 1}"]}
        for i in range(links - 1)
    }
    text = put_all(text, {**made, **ties})
    assert "'link0' and 'link1' overlap" in told(text, move("link0", 0.9, 0.0))[0]


def test_more_bodies_than_can_be_looked_at_in_a_frame_are_left_to_the_edit() -> None:
    text = scene()
    names = [f"one{i}" for i in range(MOST + 1)]
    made: Changes = {
        ("bodies", name): {
            "shape": {"type": "disc", "radius": 0.1},
            "mass": 1,
            "position": [i, 20],
        }
        for i, name in enumerate(names)
    }
    text = put_all(text, made)
    all_moved = Proposed(partial(moving_and_aligning.move, names=names, by=(0, 1)), names)
    assert Foresight(json.loads(text), parse(text)).of(all_moved) is None


@pytest.mark.parametrize("path", sampled(LEVELS, "foreseen"))
def test_a_moved_body_of_a_level_is_refused_exactly_if_that_was_foreseen(path: Path) -> None:
    text = expanded(path.read_text(encoding="utf-8"))
    level = parse(text)
    look = Foresight(json.loads(text), level)
    for name in [name for name, body in level.bodies.items() if body.type == "dynamic"][:2]:
        proposed = move(name, 0.3, -0.2)
        found = look.of(proposed)
        try:
            changed = parse(proposed.edit(text, level))
        except SandboxError:  # a formula of the level no longer fits
            continue
        if found is not None:
            assert [str(fault.reason) for fault in found.faults][:1] == refusal(changed)


def refusal(level: Level) -> list[str]:
    """Return why a level cannot start, if it cannot, unless only a kick finds that."""
    try:
        build(level)
    except SimulationError as error:
        reason = str(error.reason)
        found = reason.startswith(("no forces were found", "what is driven presses"))
        return [] if found else [reason]
    return []
