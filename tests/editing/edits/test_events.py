"""Events made from the selected parts."""

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_disc
from sandbox.editing.edits.events import cut, is_cut
from sandbox.editing.edits.joint_creation import Pick, add_joint
from sandbox.editing.text_patches import put
from sandbox.model.loading import parse
from sandbox.physics.run import build


def hanging() -> str:
    text = Draft.empty().text
    text = add_disc(text, parse(text), (0, 3), (0.5, 3)).text
    return add_joint(text, parse(text), "rope", [Pick((0, 3), "disc1"), Pick((0, 6))]).text


def test_a_joint_that_is_cut_lets_go_after_a_second() -> None:
    level = parse(cut(hanging(), parse(hanging()), "rope1"))
    assert is_cut(level, "rope1")
    world = build(level)
    disc = list(level.bodies).index("disc1")
    heights = [world.advance(60).position[disc, 1] for _ in range(2)]
    assert heights[0] == 3
    assert heights[1] < 0.6


def test_of_a_short_run_it_is_half_way_and_every_event_has_a_name_of_its_own() -> None:
    text = put(hanging(), ("duration",), 0.5)
    text = add_joint(text, parse(text), "rod", [Pick((0, 3), "disc1"), Pick((0, 6))]).text
    text = cut(text, parse(text), "rope1")
    level = parse(cut(text, parse(text), "rod1"))
    assert list(level.events) == ["event1", "event2"]
    assert all(event.at.source == 0.25 for event in level.events.values())  # type: ignore[union-attr]
