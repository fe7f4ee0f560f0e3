"""Every value of a JSON text is found at its position."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.model.json_positions import Path, nested_beyond, position, values

json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=20,
)


def _every(data: object, path: Path = ()) -> dict[Path, object]:
    """Return every value of some data by its path."""
    found: dict[Path, object] = {path: data}
    items = enumerate(data) if isinstance(data, list) else ()
    for step, child in data.items() if isinstance(data, dict) else items:
        found |= _every(child, (*path, step))
    return found


@given(json_values, st.sampled_from([None, 0, 2]), st.booleans())
def test_every_value_is_found_at_its_path(
    data: object, indent: int | None, ascii_only: bool
) -> None:
    text = json.dumps(data, indent=indent, ensure_ascii=ascii_only)

    found = {value.path: value for value in values(text)}

    assert list(found) == list(_every(data))
    for path, child in _every(data).items():
        start = found[path].start
        if path and isinstance(path[-1], str):
            key, start = json.JSONDecoder().raw_decode(text, start)
            assert key == path[-1]
            start = text.index(":", start) + 1
            start += len(text[start:]) - len(text[start:].lstrip(" \n"))
        decoded, end = json.JSONDecoder().raw_decode(text, start)
        assert repr(decoded) == repr(child)
        scalar = not isinstance(child, dict | list)
        assert found[path].text == (text[start:end] if scalar else text[start])


@pytest.mark.sweep
@given(json_values)
def test_no_key_is_repeated_in_what_python_writes(data: object) -> None:
    assert not any(value.repeated for value in values(json.dumps(data)))


@pytest.mark.parametrize(
    ("text", "repeated"),
    [
        ('{"a": 1, "a": 2}', [(("a",), 9)]),
        ('{"a": 1, "b": {"a": 2, "a": 3}}', [(("b", "a"), 23)]),
        ('{"a": {"x": 1}, "b": {"x": 2}}', []),
        ('{"a": {"x": 1}, "a": {"x": 2}}', [(("a",), 16)]),
        ('[{"a": 1}, {"a": 2}]', []),
        ('{"a": "a", "b": "a"}', []),
        (r'{"a": 1, "\u0061": 2}', [(("a",), 9)]),
        ('{"": 1, "": 2}', [(("",), 8)]),
        ('{"a": 1, "a": 2, "a": [3]}', [(("a",), 9), (("a",), 17)]),
    ],
)
def test_a_repeated_key_is_told_from_the_same_key_elsewhere(
    text: str, repeated: list[tuple[Path, int]]
) -> None:
    assert [(value.path, value.start) for value in values(text) if value.repeated] == repeated


@given(st.text(alphabet="ab\nµ", min_size=1), st.data())
def test_a_position_is_the_line_and_column_of_an_editor(text: str, data: st.DataObject) -> None:
    index = data.draw(st.integers(0, len(text) - 1))

    line, column = position(text, index)

    assert text.split("\n")[line - 1][column - 1 : column] == text[index].strip("\n")
    assert len("\n".join(text.split("\n")[: line - 1])) + (line > 1) + column - 1 == index


def test_the_first_bracket_within_more_than_so_many_is_found() -> None:
    text = '{"[[[": [1, [2]], "b": {"c": [3]}}'

    assert nested_beyond(text, 2) == text.index("[2]")
    assert nested_beyond(text, 3) == 0
