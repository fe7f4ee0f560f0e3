"""A repetition is the same level, to the bit, as its parts written out."""

import json
import time
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.model.level_writing import formatted
from sandbox.model.loading import digest, parse
from sandbox.model.shorthand import write_out
from sandbox.physics.run import build
from tests.model.levels import Data, bare

DISC = {"shape": {"type": "disc", "radius": 0.1}, "mass": "m"}


def level(**changes: object) -> Data:
    return {**bare(), "checks": [], "ghosts": {}, **changes}


def chain(count: int) -> Data:
    """Return a chain of balls on rods, with a check and a ghost for each."""
    ball = DISC | {"repeat": {"i": count}, "position": ["0.3*{i}", "m*{i - 1}"]}
    rod = {"repeat": {"i": count - 1}, "type": "rod", "ends": ["ball{i}", "ball{i + 1}"]}
    check = {
        "repeat": {"i": count}, "label": "ball {i + 1}", "quantity": "ball{i}.position.x",
        "formula": "0.3*{i}", "tolerance": 1e-9,
    }  # fmt: skip
    return level(
        bodies={"ball{i}": ball},
        joints={"top": {"type": "rod", "ends": [[0, 1], "ball0"]}, "rod{i}": rod},
        checks=[check],
        ghosts={"ball{i}": {"repeat": {"i": count}, "each": ["0.3*{i}", "-g*t**2/2"]}},
    )


def typed_out(count: int) -> Data:
    """Return the same chain without shorthand."""
    numbers = range(count)

    def height(i: int) -> str:
        return f"m*{i - 1}" if i else "m*(-1)"

    return level(
        bodies={f"ball{i}": DISC | {"position": [f"0.3*{i}", height(i)]} for i in numbers},
        joints={"top": {"type": "rod", "ends": [[0, 1], "ball0"]}}
        | {
            f"rod{i}": {"type": "rod", "ends": [f"ball{i}", f"ball{i + 1}"]}
            for i in range(count - 1)
        },
        checks=[
            {
                "label": f"ball {i + 1}", "quantity": f"ball{i}.position.x",
                "formula": f"0.3*{i}", "tolerance": 1e-9,
            }
            for i in numbers
        ],
        ghosts={f"ball{i}": [f"0.3*{i}", "-g*t**2/2"] for i in numbers},
    )  # fmt: skip


def read(data: Data) -> Level:
    return parse(json.dumps(data, indent=1))


def told(data: Data) -> list[str]:
    with pytest.raises(LevelError) as caught:
        read(data)
    return [str(mistake).removeprefix("<text>:") for mistake in caught.value.mistakes]


@given(count=st.integers(1, 12))
@settings(max_examples=12, deadline=None)
def test_what_repeats_is_the_level_that_is_typed_out(count: int) -> None:
    short, long = read(chain(count)), read(typed_out(count))

    assert short == long
    assert digest(short) == digest(long)
    assert list(short.bodies) == list(long.bodies), "the order decides about bits"


def test_what_repeats_moves_to_the_same_bits() -> None:
    short, long = (build(read(made(5))) for made in (chain, typed_out))
    for world in (short, long):
        world.advance(60)

    assert np.array_equal(short.snapshot.position, long.snapshot.position)
    assert np.array_equal(short.snapshot.tension, long.snapshot.tension)


@given(rows=st.integers(1, 6), columns=st.integers(1, 6))
@settings(deadline=None)
def test_the_last_index_runs_fastest_and_may_depend_on_the_first(rows: int, columns: int) -> None:
    grid = {"box{i}_{j}": DISC | {"repeat": {"i": rows, "j": columns}}}
    pile = {"box{i}_{j}": DISC | {"repeat": {"i": [1, rows], "j": [1, "{i}"]}}}

    assert list(read(level(bodies=grid)).bodies) == [
        f"box{i}_{j}" for i in range(rows) for j in range(columns)
    ]
    assert list(read(level(bodies=pile)).bodies) == [
        f"box{i}_{j}" for i in range(1, rows + 1) for j in range(1, i + 1)
    ]


def test_a_power_of_a_negative_index_keeps_its_sign() -> None:
    ball = DISC | {"repeat": {"i": [-2, 2]}, "position": ["{i}**2", 0]}
    values = {"m": 1.0}

    found = [
        b.position[0](values) for b in read(level(bodies={"ball{i + 2}": ball})).bodies.values()
    ]

    assert found == [4, 1, 0, 1, 4], "-2**2 would be -4"


def test_points_and_names_in_lists_repeat_too() -> None:
    corners = {"repeat": {"i": 6}, "each": ["cos({i}*60*deg)", "sin({i}*60*deg)"]}
    data = level(
        bodies={
            "hexagon": {"shape": {"type": "polygon", "vertices": [corners]}, "mass": 1},
            "ball{i}": DISC | {"repeat": {"i": 3}},
        },
        effects={"drag": {"linear": 1, "bodies": [{"repeat": {"i": 3}, "each": "ball{i}"}]}},
        parameters={"m": bare()["parameters"]["m"]},
    )
    found = read(data)

    assert len(found.bodies["hexagon"].shape.vertices) == 6  # type: ignore[union-attr]
    assert found.effects.drag
    assert found.effects.drag.bodies == ("ball0", "ball1", "ball2")


def test_a_parameter_for_each_copy() -> None:
    each = {"repeat": {"i": 2}, "value": 1, "min": 1, "max": 2}
    ball = DISC | {"repeat": {"i": 2}, "mass": "m{i}"}
    data = level(bodies={"ball{i}": ball}, parameters={"m{i}": each}, effects={})

    assert list(read(data).parameters) == ["m0", "m1"]


def test_braces_mean_nothing_where_nothing_repeats() -> None:
    assert read(level(summary="a set {i}", bodies=chain(2)["bodies"])).summary == "a set {i}"


def test_a_body_may_still_be_called_repeat() -> None:
    assert list(read(level(bodies={"repeat": DISC})).bodies) == ["repeat"]


@pytest.mark.parametrize(
    ("place", "value", "rule"),
    [
        ("repeat", {"i": 0.5}, "must be a count"),
        ("repeat", {"i": True}, "must be a count"),
        ("repeat", {"i": [1]}, "must be a count"),
        ("repeat", {"i": [3, 1]}, "ends before it begins, from 3 to 1"),
        ("repeat", {"i": 20_001}, "counts too far, beyond 20,000"),
        ("repeat", {"i": 10**400}, "counts too far"),
        ("repeat", {}, "must name an index"),
        ("repeat", 5, "must name an index"),
        ("repeat", {"pi": 5}, "already has a meaning"),
        ("repeat", {"1": 5}, "is not a name"),
        ("repeat", {"i": "{k}"}, "'k' is not one"),
        ("position", ["{i/2}", 0], "is 0.5, not a whole number"),
        ("position", ["{k}", 0], "'k' is not one; known: i"),
        ("position", ["{m}", 0], "may use only indices, and 'm' is not one"),
        ("position", ["{1/(i - 1)}", 0], "not a finite number"),
        ("position", ["i", 0], "unknown parameter 'i'; the index is typed {i}"),
        ("each", 1, "cannot be combined with 'each'"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_where_it_is_typed(place: str, value: object, rule: str) -> None:
    ball: Data = DISC | {"repeat": {"i": 3}, place: value}
    data = level(bodies={"ball{i}": ball})
    (found, *others) = told(data)

    assert rule in found
    assert not others, "once for all copies"
    line = int(found.split(":")[0])
    typed = json.dumps(data, indent=1).splitlines()
    first = next(i for i, text in enumerate(typed, 1) if '"ball{i}"' in text)
    assert first < line <= len(typed)


def test_a_wrong_value_is_told_once_at_its_place_with_the_first_copy() -> None:
    data = level(bodies={"ball{i}": DISC | {"repeat": {"i": 3}, "mass": -1}})
    text = json.dumps(data, indent=1)
    line = next(i for i, said in enumerate(text.splitlines(), 1) if '"mass": -1' in said)

    assert told(data) == [f"{line}:4: bodies.ball0.mass: is -1, but must be greater than 0"]


def test_what_comes_behind_what_repeats_keeps_its_place() -> None:
    data = chain(3)
    data["checks"].append({"quantity": "ball0.sped", "formula": 0, "tolerance": 1})
    text = json.dumps(data, indent=1)
    line = next(i for i, said in enumerate(text.splitlines(), 1) if "sped" in said)

    (found,) = told(data)
    assert found.startswith(f"{line}:4: checks.3.quantity: 'ball0.sped' is not a quantity")


def test_a_name_without_its_index_is_told() -> None:
    (found,) = told(level(bodies={"ball": DISC | {"repeat": {"i": 2}}}))

    assert "there is more than one 'ball'; put an index into the name, such as ball{i}" in found


@pytest.mark.sweep
@pytest.mark.parametrize(
    "repeat",
    [
        {"i": 20_000, "j": 20_000},
        {"i": 20_000, "j": 20_000, "k": 20_000, "l": 0},
        {"i": 20_000, "j": "{i}"},
    ],
)
def test_a_small_file_exhausts_no_machine(repeat: Any) -> None:  # noqa: ANN401
    """400 million bodies in 300 bytes are refused, after 0.2 to 0.7 s of computing."""
    data = level(bodies={"b{i}_{j}": DISC | {"repeat": repeat}})
    begun = time.process_time()
    found = write_out(data, json.dumps(data))

    assert "more than 5,000,000 characters when it is expanded" in found.faults[0].rule
    assert time.process_time() - begun < 10


@pytest.mark.sweep
def test_copies_of_many_numbers_exhaust_no_machine() -> None:
    """Numbers count like texts: 20,000 polygons of 1,000 corners would be 20 million."""
    corners = [[i, i % 7] for i in range(1000)]
    shape = {"type": "polygon", "vertices": corners}
    data = level(bodies={"b{i}": DISC | {"repeat": {"i": 20_000}, "shape": shape}})

    assert "more than 5,000,000 characters" in told(data)[0]


def test_the_layout_stays_as_it_is_typed() -> None:
    text = json.dumps(chain(3))

    assert json.loads(formatted(text)) == json.loads(text)
    assert formatted(formatted(text)) == formatted(text)


@pytest.mark.sweep
@given(st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=6) | st.just("{i}"),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(
        st.sampled_from(["repeat", "each", "i", "copy", "bodies", "joints", "position", "angle"]),
        inner, max_size=4),
    max_leaves=20,
))  # fmt: skip
def test_nonsense_is_answered(nonsense: object) -> None:
    """Whatever is written instead of shorthand: a level or mistakes result, and no traceback."""
    for part in ("bodies", "joints", "groups", "checks", "constants", "ghosts"):
        data = {**level(), "bodies": {"ball": DISC}, part: nonsense}
        with suppress(LevelError):
            read(data)
