"""After hours of building, only what is shown or could be lost is still in memory."""

import json

import pytest

from sandbox.app.building.kept_drafts import Drafts
from sandbox.app.building.partial_level import PartCache, PartialLevel, _body
from sandbox.editing.draft import Draft
from sandbox.model import level_catalog
from sandbox.model.body import Body
from sandbox.model.loading import load

LEVELS = level_catalog.textbook()[:5]


def disc(x: float) -> str:
    return json.dumps({"shape": {"type": "disc", "radius": 1}, "position": [x, 0]})


def test_a_level_that_was_only_looked_at_is_let_go() -> None:
    drafts = Drafts()
    for name in LEVELS:
        last = drafts.of(load(level_catalog.find(name)))

    assert list(drafts._kept) == [last]


def test_new_levels_that_nobody_has_edited_are_let_go() -> None:
    """Each press of the key for a new level kept one more."""
    drafts = Drafts()
    for _ in range(20):
        last = Draft.empty()
        drafts.add(last)

    assert list(drafts._kept) == [last]


@pytest.mark.parametrize("undone", [False, True])
def test_what_was_changed_stays_with_its_steps_but_is_not_held_as_a_level(undone: bool) -> None:
    drafts = Drafts()
    levels = [load(level_catalog.find(name)) for name in LEVELS]
    first = drafts.of(levels[0])
    first.change(first.text + "\n", "add a line")
    assert first.level is not None
    if undone:
        first.undo()
    for level in levels[1:]:
        drafts.of(level)

    assert first._loaded is None
    assert drafts.of(levels[0]) is first
    assert (first.redo_description if undone else first.undo_description) == "add a line"


def test_parts_are_read_once_and_let_go_with_the_scene_after_next() -> None:
    readings = PartCache(Body.model_validate_json)
    readings.begin()
    one = readings(disc(1))
    readings.begin()
    assert readings(disc(1)) is one
    assert readings("[]") is None

    for x in range(100):  # a disc that is dragged
        readings.begin()
        readings(disc(x))
    assert len(readings) == 2


def test_a_scene_that_is_drawn_again_and_again_holds_its_own_parts() -> None:
    for x in range(50):
        PartialLevel({"bodies": {"disc": json.loads(disc(x)), "other": json.loads(disc(-1))}})

    assert len(_body) == 3
