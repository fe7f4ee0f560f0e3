"""Comments are keys that begin with //, in any object; they change nothing, and stay."""

import json

import pytest

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import remove_parts
from sandbox.editing.edits.copying import duplicate
from sandbox.editing.edits.joint_creation import Pick, add_joint
from sandbox.editing.edits.moving_and_aligning import move
from sandbox.editing.edits.resizing import drag_handle
from sandbox.editing.renaming import rename
from sandbox.model import level_catalog
from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.model.level_writing import formatted
from sandbox.model.loading import parse

COMMENTED = """{
  "// about": "two bodies on a rod",
  "format": 1,
  "title": "T",
  "// what acts": ["a list", {"is": "allowed, too"}],
  "effects": {"gravity": {"// where": "on Earth", "acceleration": [0, -9.81]}},
  "bodies": {
    "//": "the box comes first",
    "box": {"shape": {"type": "box", "// m": "", "width": 1, "height": 1},
            "mass": 1, "position": [0, 3]},
    "ball": {"shape": {"type": "disc", "radius": 0.3}, "mass": 1, "position": [2, 3]}
  },
  "joints": {"rod": {"//": "light", "type": "rod", "ends": ["box", "ball"], "length": 2}},
  "// the end": "of it"
}
"""


def test_comments_change_nothing() -> None:
    def stripped(part: object) -> object:
        if isinstance(part, list):
            return [stripped(item) for item in part]
        if not isinstance(part, dict):
            return part
        return {key: stripped(value) for key, value in part.items() if not key.startswith("//")}

    bare = json.dumps(stripped(json.loads(COMMENTED)))
    assert parse(COMMENTED).model_dump() == parse(bare).model_dump()
    assert list(parse(COMMENTED).bodies) == ["box", "ball"]


def test_a_mistake_beside_a_comment_is_told_where_it_is() -> None:
    with pytest.raises(LevelError, match=r":10:13: bodies\.box\.mass") as error:
        parse(COMMENTED.replace('"mass": 1, "position": [0', '"mass": -1, "position": [0'))
    assert len(error.value.mistakes) == 1


def test_the_layout_keeps_every_comment_before_what_it_was_written_before() -> None:
    shuffled = COMMENTED.replace('"format": 1,\n  "title": "T",', '"title": "T",\n  "format": 1,')
    laid_out = formatted(shuffled)
    assert laid_out == formatted(laid_out)
    keys = list(json.loads(laid_out))
    assert keys.index("// what acts") == keys.index("effects") - 1
    assert keys[-1] == "// the end"
    assert laid_out.count("//") == COMMENTED.count("//")


def test_edits_keep_comments() -> None:
    draft = Draft.of(COMMENTED)

    def change(text: str) -> None:
        draft.change(text, "edit")
        assert not draft.mistakes

    def level() -> Level:
        assert draft.level
        return draft.level

    change(move(draft.text, level(), ["box"], (1, 0)))
    change(drag_handle(draft.text, level(), "box", 4, (2, 4)))
    picks = Pick((0, 3), "box"), Pick((0, 6))
    change(add_joint(draft.text, level(), "spring", picks).text)
    change(rename(draft.text, ("bodies", "box"), "crate"))
    assert draft.text.count("//") == COMMENTED.count("//")
    change(duplicate(draft.text, level(), ["crate", "ball"], (5, 0)).text)
    assert draft.text.count("//") == COMMENTED.count("//") + 2  # of the shape and of the rod
    change(remove_parts(draft.text, level(), ["ball"]))
    assert '"// about": "two bodies on a rod"' in draft.text


def test_the_schema_allows_them() -> None:
    made = json.loads((level_catalog.root() / level_catalog.SCHEMA).read_text(encoding="utf-8"))
    assert made["patternProperties"]["^//"] == {}
    assert made["$defs"]["Body"]["patternProperties"]["^//"] == {}
