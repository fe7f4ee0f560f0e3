"""Any text is a level, or gives one error that says what is wrong."""

import json
from copy import deepcopy
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.model.level import Level
from sandbox.model.loading import parse
from tests.model.levels import bare, hanging, mistakes_in, touching

TEXTS = [json.dumps(data, indent=1) for data in (bare(), touching(), hanging())]


PIECES = [
    *'{}[]:,"0-. \n\\',
    "null",
    "true",
    "NaN",
    "1e999",
    '"m"',
    '"type": "box",',
    "-1",
    "[1, 2]",
    "{}",
    '"t"',
    '"1/0"',
]


@st.composite
def mangled(draw: st.DrawFn) -> str:
    """Draw the text of a level with a few pieces cut out, doubled or replaced."""
    text = draw(st.sampled_from(TEXTS))
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(text)))
        end = min(len(text), start + draw(st.integers(0, 20)))
        piece = draw(
            st.one_of(st.sampled_from(PIECES), st.text(max_size=3), st.just(text[start:end] * 2))
        )
        text = text[:start] + piece + text[end:]
    return text


@st.composite
def bent(draw: st.DrawFn) -> str:
    """Draw the text of a level in which a few values are something else."""
    data = json.loads(draw(st.sampled_from(TEXTS)))
    anything: st.SearchStrategy[Any] = st.sampled_from(
        [None, True, 0, -1, 1e308, "m", "x", "t", "", [], {}, [0, 0], "ball"]
    )
    for _ in range(draw(st.integers(1, 3))):
        part: Any = data
        while True:
            steps = list(part) if isinstance(part, dict) else list(range(len(part)))
            if not steps:
                break
            step = draw(st.sampled_from(steps))
            if not isinstance(part[step], dict | list) or draw(st.booleans()):
                part[step] = deepcopy(draw(anything))
                break
            part = part[step]
    return json.dumps(data)


@pytest.mark.sweep
@given(st.one_of(mangled(), bent(), st.text()))
def test_any_text_is_a_level_or_a_level_error(text: str) -> None:
    found = mistakes_in(text)

    assert found or isinstance(parse(text), Level)
    assert all(mistake.rule for mistake in found)
    assert all(str(mistake).isprintable() for mistake in found)
