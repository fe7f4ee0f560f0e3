"""The layout of a level's text: what may change, and what never does."""

import json
import re
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.model import level_catalog, templates
from sandbox.model.level_writing import WIDTH, formatted, text, with_schema
from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd

LEVELS = sorted(level_catalog.root().glob("*/*.json"))
OURS = [*LEVELS, *map(templates.path, templates.names())]
SMALL = [path for path in OURS if path.stat().st_size < 4000]
PIECE = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"|[{}\[\],:]|[^\s{}\[\],:"]+')


def typed(path: Path) -> str:
    return path.read_bytes().decode()


def as_typed(said: str) -> Any:  # noqa: ANN401
    """Return the JSON data, with numbers as they are typed and keys in their order."""
    mark = "#{}".format
    return json.loads(said, object_pairs_hook=tuple, parse_int=mark, parse_float=mark)


def level(**parts: object) -> dict[str, Any]:
    ball = {"shape": {"type": "disc", "radius": 1}, "mass": 1}
    return {"format": 1, "title": "A level", "bodies": {"ball": ball}, **parts}


@st.composite
def scattered(draw: st.DrawFn) -> tuple[str, str]:
    """A level that ships, as it is, and with other spaces and line breaks in it."""
    before = typed(draw(st.sampled_from(SMALL)))
    spaces = st.sampled_from(["", "", " ", "\n", "\n  ", "\t", "\r\n", "\n\n"])
    pieces = PIECE.findall(before)
    gaps = draw(st.lists(spaces, min_size=40, max_size=40))
    start = draw(st.integers(0, 39))
    return before, "".join(
        piece + gaps[(start + i * i) % len(gaps)] for i, piece in enumerate(pieces)
    )


@pytest.mark.parametrize("path", OURS, ids=lambda path: path.stem)
def test_the_levels_that_ship_have_the_layout_already(path: Path) -> None:
    assert formatted(typed(path)) == typed(path)


@pytest.mark.sweep
@given(scattered())
def test_only_spaces_and_line_breaks_change(pair: tuple[str, str]) -> None:
    before, other = pair

    after = formatted(other)

    assert as_typed(after) == as_typed(before)
    assert parse(after) == parse(before)


@pytest.mark.sweep
@given(scattered())
def test_what_is_laid_out_stays_as_it_is(pair: tuple[str, str]) -> None:
    after = formatted(pair[1])

    assert formatted(after) == after


@pytest.mark.sweep
@given(st.sampled_from(SMALL), st.sampled_from([None, 1, 2, 4, "\t"]), st.randoms())
def test_what_a_program_writes_becomes_the_same_level(
    path: Path, indent: int | str | None, random: Random
) -> None:
    before = typed(path)
    items = list(json.loads(before).items())
    random.shuffle(items)

    after = formatted(json.dumps(dict(items), indent=indent))

    assert parse(after) == parse(before)
    assert list(json.loads(after)) == list(json.loads(before))
    assert formatted(after) == after


def test_numbers_stay_as_they_are_typed() -> None:
    said = json.dumps(level(duration="D")).replace('"D"', "1.50e+01")

    assert '"duration": 1.50e+01\n' in formatted(said)


def test_short_things_come_onto_one_line() -> None:
    said = formatted(json.dumps(level(effects={"gravity": {"acceleration": [0, -9.81]}}), indent=2))

    assert '\n  "effects": {"gravity": {"acceleration": [0, -9.81]}},\n' in said
    assert '\n    "ball": {"shape": {"type": "disc", "radius": 1}, "mass": 1}\n' in said


def test_what_does_not_fit_on_a_line_keeps_a_line_a_member() -> None:
    checks = [{"label": "x" * WIDTH, "quantity": "ball.speed", "formula": "0", "tolerance": 1}]

    said = formatted(json.dumps(level(checks=checks), indent=4))

    assert '\n      "quantity": "ball.speed",\n      "formula": "0",\n' in said


def test_lines_that_a_person_has_filled_stay() -> None:
    said = text(level())
    filled = said.replace(
        '{"shape": {"type": "disc", "radius": 1}, "mass": 1}',
        '{\n      "shape": {"type": "disc", "radius": 1}, "mass": 1,\n      "angle": 0\n    }',
    )

    assert formatted(filled) == filled


def test_windows_line_ends_stay() -> None:
    said = text(level()).replace("\n", "\r\n")

    assert formatted(said) == said
    assert formatted(said.replace(": ", ":")) == said


@pytest.mark.parametrize("kind", ["gas", "chain"])
def test_a_level_made_by_a_program_has_a_body_a_line(kind: str) -> None:
    said = text(crowd(kind, 20))

    assert formatted(said) == said
    assert sum(line.startswith('    "') for line in said.splitlines()) >= 20


def test_a_level_can_be_given_another_place_of_its_schema() -> None:
    said = text({"$schema": "old", **level()})

    assert with_schema(said, "new/schema.json") == said.replace("old", "new/schema.json")
    assert with_schema(text(level()), "old") == said
