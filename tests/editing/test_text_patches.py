"""Patches change one place, and keep everything else as it was typed."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.editing.json_spans import Spans
from sandbox.editing.text_patches import PatchError, put, put_all, remove, type_in, value_at
from sandbox.model import level_catalog, templates
from sandbox.model.errors import LevelError
from sandbox.model.json_positions import TOKEN
from sandbox.model.level_writing import formatted
from sandbox.model.loading import read
from tests.sample import sampled

OURS = [*sorted(level_catalog.root().glob("*/*.json")), *map(templates.path, templates.names())]
SMALL = [path for path in OURS if path.stat().st_size < 4000]

TYPED = """{
  "format": 1, "title": "Odd",
      "effects": {"gravity": {"acceleration": [0.0, "-  9.810"]}},
  "bodies": {
    "a": {"mass": 1.50,   "shape": {"type": "disc", "radius": 1e0}}
  }
}
"""

JSON = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-99, 99)
    | st.floats(-1e6, 1e6).map(lambda x: round(x, 6))
    | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=5,
)


def test_a_number_changes_and_nothing_beside_it() -> None:
    assert put(TYPED, ("bodies", "a", "mass"), 2) == TYPED.replace("1.50", "2")


def test_the_same_number_stays_as_it_was_typed() -> None:
    assert put(TYPED, ("bodies", "a", "mass"), 1.5) == TYPED
    assert put(TYPED, ("bodies", "a", "shape"), {"type": "disc", "radius": 1}) == TYPED


def test_what_is_typed_in_stays_to_the_character() -> None:
    assert type_in(TYPED, ("bodies", "a", "mass"), "2.500") == TYPED.replace("1.50", "2.500")


def test_rounding_is_not_written() -> None:
    assert value_at(put(TYPED, ("bodies", "a", "mass"), 0.1 + 0.2), ("bodies", "a", "mass")) == 0.3


def test_parts_are_put_in_the_order_in_which_levels_are_written() -> None:
    text = put(put(TYPED, ("view", "width"), 5), ("joints",), {})
    assert list(json.loads(text)) == ["format", "title", "effects", "bodies", "joints", "view"]


def test_parents_that_are_missing_are_made() -> None:
    text = put(TYPED, ("effects", "friction", "pairs", 0, "bodies"), ["a", "b"])
    said = {"pairs": [{"bodies": ["a", "b"]}]}
    assert json.loads(text)["effects"]["friction"] == said


def test_a_list_is_added_to_at_its_length_only() -> None:
    text = put(TYPED, ("checks", 0), {"quantity": "t"})
    assert value_at(put(text, ("checks", 1), 2), ("checks", 1)) == 2
    with pytest.raises(PatchError, match=r"checks has 1 items, so none at 3"):
        put(text, ("checks", 3), 2)


def test_a_number_holds_nothing() -> None:
    with pytest.raises(PatchError, match=r"bodies\.a\.mass has nothing named unit"):
        put(TYPED, ("bodies", "a", "mass", "unit"), "kg")


def test_null_gives_way() -> None:
    text = put(TYPED, ("effects", "contact"), None)
    assert value_at(put(text, ("effects", "contact", "piles"), value=True), ("effects",)) == {
        "gravity": {"acceleration": [0, "-  9.810"]},
        "contact": {"piles": True},
    }


def test_what_is_no_json_is_refused_with_its_place() -> None:
    with pytest.raises(LevelError, match="<text>:2:1"):
        put("{\n]", ("a",), 1)


def test_an_emptied_part_goes_but_an_effect_stays() -> None:
    text = put(put(TYPED, ("joints", "rod"), {}), ("effects", "contact", "located"), ["a"])
    text = remove(remove(text, ("joints", "rod")), ("effects", "contact", "located", 0))
    assert "joints" not in json.loads(text)
    assert json.loads(text)["effects"]["contact"] == {}
    assert json.loads(remove(text, ("bodies", "a")))["bodies"] == {}


def test_line_breaks_are_those_of_the_text() -> None:
    typed = TYPED.replace("\n", "\r\n")
    added = put(typed, ("bodies", "b"), {"mass": 1})
    assert added.count("\n") == added.count("\r\n") == typed.count("\n") + 1


@pytest.mark.parametrize("path", sampled(OURS, "patch"))
def test_what_is_put_and_taken_away_again_leaves_a_level_as_it_was(path: Path) -> None:
    text = read(path)
    added = put(text, ("bodies", "fresh1"), {"mass": 1, "shape": {"type": "disc", "radius": 1}})
    assert formatted(added) == added
    without = remove(added, ("bodies", "fresh1"))
    if '"bodies": {\n' in text:
        assert without == text
    assert TOKEN.findall(without) == TOKEN.findall(text)  # bodies on one line may have got several


@pytest.mark.sweep
@given(st.data())
def test_a_patch_does_what_it_would_do_to_the_data(data: st.DataObject) -> None:
    text = read(data.draw(st.sampled_from(SMALL)))
    path = data.draw(st.sampled_from(sorted(set(Spans(text)) - {()}, key=str)))
    value = data.draw(JSON)

    meant: Any = json.loads(text)
    inside = meant
    for step in path[:-1]:
        inside = inside[step]
    inside[path[-1]] = value
    assert json.loads(put(text, path, value)) == meant


@pytest.mark.sweep
@given(st.data())
def test_what_stood_before_and_behind_a_patch_stays_to_the_character(data: st.DataObject) -> None:
    text = read(data.draw(st.sampled_from(SMALL)))
    found = Spans(text)
    path = data.draw(st.sampled_from(sorted(set(found) - {()}, key=str)))
    changed = put(text, path, data.draw(JSON))
    assert changed.startswith(text[: found[path].begin])
    assert changed.endswith(text[found[path].end :])


def test_many_patches_are_the_same_as_one_after_the_other() -> None:
    one = put(put(TYPED, ("bodies", "a", "mass"), 3), ("view", "width"), 2)
    assert put_all(TYPED, {("bodies", "a", "mass"): 3, ("view", "width"): 2}) == one


def test_two_values_in_one_place_are_refused() -> None:
    with pytest.raises(PatchError, match="two values"):
        put_all(TYPED, {("bodies", "a"): {}, ("bodies", "a", "mass"): 1})
