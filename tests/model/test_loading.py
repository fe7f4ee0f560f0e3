# ruff: noqa: E501 (a table is read by its rows)
"""Any file is a level, or gives a list of its mistakes."""

import gc
import json
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from sandbox.model import level_catalog
from sandbox.model.errors import LevelError, ValueRangeError
from sandbox.model.level import Level
from sandbox.model.loading import MAX_BYTES, choose, digest, load, parse
from tests.model.levels import (
    bare,
    changed,
    hanging,
    level,
    mistakes,
    mistakes_in,
    said,
    setting,
    touching,
)
from tests.sample import sampled
from validation.case import textbook

SHIPPED = [(level_catalog.root() / f"{name}.json") for name in level_catalog.names()]


@contextmanager
def refused(told: str) -> Iterator[None]:
    """Expect a short `LevelError` within a second of computing."""
    started = time.process_time()
    with pytest.raises(LevelError) as caught:
        yield
    assert time.process_time() - started < 1
    assert told in str(caught.value)
    assert all(len(str(mistake)) < 800 for mistake in caught.value.mistakes)
    assert all(str(mistake).isprintable() for mistake in caught.value.mistakes)


# Files


def test_a_file_is_read(tmp_path: Path) -> None:
    path = tmp_path / "ball.json"
    path.write_text(json.dumps(bare()), encoding="utf-8")

    assert load(path) == level(bare())


def test_a_mark_at_the_start_of_a_file_moves_no_column(tmp_path: Path) -> None:
    path = tmp_path / "ball.json"
    path.write_text(json.dumps(bare()), encoding="utf-8-sig")
    assert load(path) == level(bare())

    path.write_text("{'", encoding="utf-8-sig")
    with refused(f"{path}:1:2:"):
        load(path)


def test_windows_line_ends_move_no_line(tmp_path: Path) -> None:
    path = tmp_path / "ball.json"
    path.write_bytes(
        changed(bare(), setting("bodies.ball.mass", -1)).replace("\n", "\r\n").encode()
    )
    [expected] = mistakes(bare(), setting("bodies.ball.mass", -1))

    with refused(f"{path}:{expected.line}:{expected.column}: bodies.ball.mass"):
        load(path)


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with refused("there is no such file"):
        load(tmp_path / "none.json")
    with refused("there is no such file"):
        load(tmp_path / "none" / "none.json")


@pytest.mark.skipif(os.name == "nt", reason="not everybody may make links there")
def test_a_link_that_leads_nowhere_is_told(tmp_path: Path) -> None:
    (tmp_path / "link.json").symlink_to("none.json")
    (tmp_path / "circle.json").symlink_to("circle.json")

    with refused("is a link to a file that does not exist"):
        load(level_catalog.find(str(tmp_path / "link.json")))
    with refused("Too many levels of symbolic links"):
        load(level_catalog.find(str(tmp_path / "circle.json")))


def test_a_folder_is_told(tmp_path: Path) -> None:
    with refused("is a folder"):
        load(tmp_path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes")
def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.json")

    with refused("is not an ordinary file"):
        load(tmp_path / "pipe.json")


def test_an_unreadable_file_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "ball.json"
    path.write_text("{}")

    def deny(*_: object) -> int:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "open", deny)
    with refused("cannot be read: Permission denied"):
        load(path)


@pytest.mark.parametrize("name", ["a\0b", "x" * 5000])
def test_an_impossible_name_is_told(name: str) -> None:
    with pytest.raises(LevelError):
        load(Path(name))


def test_a_file_of_a_hundred_megabytes_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "large.json"
    with path.open("wb") as file:
        file.truncate(100_000_000)

    with refused("larger than"):
        load(path)


def test_a_byte_that_is_not_utf_8_is_located(tmp_path: Path) -> None:
    path = tmp_path / "latin.json"
    path.write_bytes('{"format": 1,\n "title": "µ'.encode() + b"\xb5")

    with refused(f"{path}:2:13: is not UTF-8"):
        load(path)


# Texts


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "is empty"),
        (" \n", "is empty"),
        ("level", "<text>:1:1: is not JSON"),
        ("{'a': 1}", "<text>:1:2: is not JSON: text needs double quotes, not single ones"),
        ('{"a": 1} // one', '<text>:1:10: is not JSON: comments are keys: "//": "..."'),
        ('{"a": 1,5}', "<text>:1:9: is not JSON: a decimal point is written ., not a comma"),
        ('{"a": 1,}', "<text>:1:"),
        ('{"a": 1\n "b": 2}', "<text>:2:2: is not JSON: a comma"),
        ('{"a" 1}', "a colon is missing"),
        ('{"a": }', "a value is missing here"),
        ('{"a": "b}', "double quotes that end this text"),
        ('{"a": "b\n"}', "must not run over the end of a line"),
        ('{"a": "b\0"}', "<text>:1:9: is not JSON: the control character U+0000 must be removed"),
        ("\0\0", "<text>:1:1: is not JSON: the control character U+0000"),
        ("\ufeff{}", "<text>:1:1: is not JSON: the byte order mark"),
        ("// a ball\n{}", "<text>:1:1: is not JSON: comments are keys"),
        ('{"a": 1} # b', "<text>:1:10: is not JSON: comments are keys"),
        ('{"a": +1}', "<text>:1:7: is not JSON: a number begins with a digit"),
        ('{"a": .5}', "<text>:1:7: is not JSON: a number begins with a digit"),
        ('{"a": "\\x"}', "<text>:1:8: is not JSON: a backslash in a text is written"),
        ('{"a": "\\u12"}', "is not JSON: \\u must be followed by four hexadecimal digits"),
        (f'{{"format": {10**40}}}', "format: is too large a number"),
        (f"[{'0,' * 300_000}0]", "has more than 300,000 values"),
        (f"[{'{},' * 150_000}0]", "has more than 300,000 values"),
        ("{}}", "one bracket too many"),
        ("{", "<text>:1:2"),
        ("[]", "<text>:1:1: must be an object"),
        ("1", 'must be an object, {"format": ..., "title": ..., "bodies": ...} (found 1)'),
        ("null", "must be an object"),
        ('"level"', "must be an object"),
        ("{}", "'title' is missing"),
        ("[" * 100_000, "<text>:1:101: is nested too deeply"),
        ("[" * 900 + "]" * 900, "<text>:1:101: is nested too deeply"),
        ('{"a":' * 300 + "1" + "}" * 300, "<text>:1:501: is nested too deeply"),
        ('{"copy":' * 300 + "1" + "}" * 300, "<text>:1:801: is nested too deeply"),
        ('{"repeat":1,"each":' * 330 + "1" + "}" * 330, "<text>:1:1901: is nested too deeply"),
        ('["9' + "9" * 5000 + '",\n ' + "9" * 5000 + "]", "<text>:2:2: has a whole number"),
        ('{"title": "\\ud83d\\ude00"}', "'format' is missing"),
        ('{"title": "a",\n "summary": "\\ud800"}', "<text>:2:2: summary: half of a character"),
        ('{"\\udc00": {"repeat": {}}}', "<text>:1:2: \\udc00: half of a character"),
        ('{"title": "NaN",\n"format": NaN}', "<text>:2:1: format: NaN is not a number"),
        ('{"a": [1, -Infinity]}', "<text>:1:11: a.1: -Infinity is not a number"),
        ('{"a": 1, "a": 1}', "<text>:1:10: a: the key 'a' occurs twice"),
        ('{"a": {"x": 1},\n"b": {"x": 1, "x": 2}}', "<text>:2:15: b.x: the key 'x' occurs twice"),
        ('{"x' + "x" * 10**6 + '": 1}', "unknown key 'xxx"),
        ("[" + "0," * 10**5 + "0]", "must be an object"),
    ],
    ids=lambda text: text[:20],
)
def test_what_is_not_the_json_of_a_level_is_told(text: str, told: str) -> None:
    with refused(told):
        parse(text)


@pytest.mark.parametrize(
    ("path", "value", "told"),
    [
        # numbers
        ("bodies.ball.mass", 0, "is 0, but must be greater than 0"),
        ("bodies.ball.mass", -1, "is -1, but must be greater than 0"),
        ("bodies.ball.mass", True, "must be a number or an expression (found true)"),
        ("bodies.ball.mass", [1], "must be a number or an expression"),
        ("bodies.ball.mass", 10**400, "too large a number"),
        ("bodies.ball.mass", "9**9**9", "'9**9**9' is inf, not a finite number"),
        ("bodies.ball.mass", "1/0", "'1/0' divides by zero"),
        ("bodies.ball.mass", "m.real", "a dot is allowed only in a number"),
        ("bodies.ball.mass", "open('f')", "'open' is not a function here"),
        ("bodies.ball.mass", "-" * 400 + "1", "nested too deeply"),
        ("bodies.ball.mass", "1" + "+1" * 10**6, "longer than 500 characters"),
        ("bodies.ball.restitution", 1.5, "must be between 0 and 1"),
        ("parameters.m.value", "2", 'must be a number (found "2")'),
        ("parameters.m.value", True, "must be a number (found true)"),
        ("stepping", {"rate": 0}, "stepping.rate: must be at least 1 (found 0)"),
        ("stepping", {"rate": 1e9}, "must be at most 100000"),
        ("stepping", {"iterations": 2.5}, "must be a whole number (found 2.5)"),
        ("stepping", {"iterations": True}, "must be a whole number (found true)"),
        ("checks.0.tolerance", 0, "must be greater than 0"),
        # types
        ("format", 2, "format: must be 1 (found 2)"),
        ("format", True, "format: must be 1 (found true)"),
        ("title", "", "title: must not be empty"),
        ("title", 5, "title: must be a text in double quotes (found 5)"),
        ("title", "x" * 10**6, "must not be longer than 80 characters"),
        ("bodies", {}, "bodies: has 0 entries, but needs at least 1"),
        ("bodies", [], "bodies: must be an object"),
        ("bodies.ball", 5, 'bodies.ball: must be an object, {"shape": ...} (found 5)'),
        ("bodies.ball.position", 5, "must be a list, [x, y] (found 5)"),
        ("bodies.ball.position", [1], "is a list with too few entries"),
        ("bodies.ball.position", [1, 2, 3], "has 3 entries, but may have at most 2"),
        ("bodies.ball.color", "red", 'must be a colour such as #4cc9f0 (found "red")'),
        ("bodies.ball.type", "dynmic", "did you mean 'dynamic'?"),
        ("bodies.ball.type", 5, "must be 'dynamic', 'kinematic' or 'static' (found 5)"),
        ("bodies.ball.shape", {"type": "dsc"}, "unknown type 'dsc'; did you mean 'disc'?"),
        ("bodies.ball.shape", {"radius": 1}, "needs the key 'type'"),
        ("bodies.ball.shape", {"type": "disc"}, "'radius' is missing"),
        ("bodies.ball.shape", {"type": "x" * 10**6}, "unknown type 'xxx"),
        ("checks.0.at", {}, "needs the key 'event'"),
        ("checks.0.at", {"event": "appex"}, "unknown type 'appex'; did you mean 'apex'?"),
        # names
        ("effects.gravty", {}, "unknown effect 'gravty'; did you mean 'gravity'?"),
        ("effects.gravity.acc", 1, "unknown key 'acc'; known: acceleration"),
        ("group", {}, "unknown key 'group'; did you mean 'groups'?"),
        ("bodies.ball.mas", 1, "unknown key 'mas'; did you mean 'mass'?"),
        ("bodies.ball.shape.radus", 1, "bodies.ball.shape.radus: unknown key 'radus'; did you mean"),
        ("checks.0.formla", 1, "unknown key 'formla'; did you mean 'formula'?"),
        ("checks.0.at", {"event": "apex", "bdy": "ball"}, "unknown key 'bdy'; did you mean 'body'?"),
        ("bodys", {}, "unknown key 'bodys'; did you mean 'bodies'?"),
        ("bodies.my ball", bare()["bodies"]["ball"], "'my ball' is not a name"),
        ("bodies.1ball", bare()["bodies"]["ball"], "'1ball' is not a name"),
        ("ghosts.x\ny", [0, 0], "is not a name"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_place(path: str, value: object, told: str) -> None:
    text = changed(bare(), setting(path, value))

    with refused(told):
        parse(text)
    assert all(mistake.line and mistake.column for mistake in mistakes_in(text))


@pytest.mark.parametrize("literal", ["1e999", "-1e999"])
@pytest.mark.parametrize("path", ["bodies.ball.mass", "parameters.m.value", "checks.0.formula"])
def test_a_number_that_overflows_is_told_as_it_is_written(path: str, literal: str) -> None:
    text = changed(bare(), setting(path, "HERE")).replace('"HERE"', literal)

    with refused(f"(found {literal})"):
        parse(text)


def test_the_place_is_that_of_the_key() -> None:
    text = '{\n  "format": 1, "titel": "µ",\n  "bodies": {"ball": {"mass": "µ", "shape": [1]}}\n}'

    places = {mistake.path: (mistake.line, mistake.column) for mistake in mistakes_in(text)}

    assert places == {
        "title": (1, 1),
        "titel": (2, 16),
        "bodies.ball.shape": (3, 36),
    }


def test_a_mistake_in_a_list_is_not_told_as_an_empty_list() -> None:
    [found] = mistakes(bare(), setting("effects.force", [{"body": "ball"}]))

    assert str(found).endswith("effects.force.0.force: 'force' is missing")


def test_mistakes_of_every_kind_are_listed_together() -> None:
    found = mistakes(
        bare(),
        setting("title", 5),
        setting("effects.gravty", {}),
        setting("bodies.ball.mass", -1),
        setting("bodies.ball.colour", "red"),
        setting("bodies.ball.position", ["x", 0]),
        setting("checks.0.quantity", "bal.speed"),
        setting("ghosts.nobody", [0, "1/0"]),
    )

    assert [mistake.path for mistake in found] == [
        "title",
        "effects.gravty",
        "bodies.ball.mass",
        "bodies.ball.colour",
        "bodies.ball.position.0",
        "checks.0.quantity",
        "ghosts.nobody",
        "ghosts.nobody.1",
    ]


def test_contradictions_are_listed_together() -> None:
    found = mistakes(
        touching(),
        setting("bodies.ball.mass", "n"),
        setting("bodies.floor.mass", 1),
        setting("effects", {"rotation": {}}),
        setting("checks.0.quantity", "x"),
    )

    assert len(said(found)) >= 6


@pytest.mark.parametrize("name", ["x" * 10**6, "ba\nll", "\0all", "\x1b[31m", "m" * 400 + "!"])
@pytest.mark.parametrize(
    "path",
    [
        "title",
        "bodies.ball.mass",
        "bodies.ball.color",
        "bodies.ball.type",
        "joints.string.ends.0",
        "checks.0.quantity",
        "checks.0.formula",
        "checks.0.at.body",
        "checks.0.at.event",
        "effects.friction.pairs.0.bodies.1",
    ],
)
def test_a_message_shows_neither_a_long_value_nor_an_unprintable_one(path: str, name: str) -> None:
    data = hanging() | {"title": " "}
    data["checks"][0]["at"] = {"event": "apex", "body": "ball"}
    data["effects"]["contact"] = {}
    pair = {"bodies": ["ball", "other"], "coefficient": 1}
    data["effects"]["friction"] = {"pairs": [pair]}
    text = changed(data, setting(path, name))

    if path != "title" or len(name) > 80:
        with refused(path.removesuffix(".event")):
            parse(text)


@pytest.mark.parametrize("collects", [True, False])
def test_the_garbage_collector_is_left_as_it_was(collects: bool) -> None:
    before = gc.isenabled()
    (gc.enable if collects else gc.disable)()
    try:
        mistakes_in("{}")
        parse(json.dumps(bare()))

        assert gc.isenabled() == collects
    finally:
        (gc.enable if before else gc.disable)()


def test_one_mistake_is_not_told_twice() -> None:
    found = said(mistakes(bare(), setting("bodies.ball.position", [])))

    assert len(found) == len(set(found)) == 1


@pytest.mark.sweep
@pytest.mark.parametrize(
    "text",
    [
        json.dumps({"bodies": {f"b{i}": {} for i in range(20_000)}}),
        json.dumps({"bodies": {f"b{i}": {"mas": -1} for i in range(20_000)}}),
        json.dumps({f"k{i}": 0 for i in range(290_000)}),
        changed(bare(), setting("ghosts", {f"g{i}": ["q", "1/0"] for i in range(5000)})),
        changed(bare(), setting("checks", 200 * [{**bare()["checks"][0], "quantity": "x"}])),
    ],
    ids=["missing", "unknown", "keys", "ghosts", "checks"],
)
def test_thousands_of_mistakes_are_told_briefly_and_soon(text: str) -> None:
    started = time.process_time()

    assert 0 < len(mistakes_in(text)) <= 101
    assert time.process_time() - started < 5


# Any text at all


# Levels


@pytest.mark.parametrize("name", sampled(level_catalog.names(), "survive"))
def test_a_level_survives_being_written_and_read(name: str) -> None:
    _survives(textbook(name))


@pytest.mark.parametrize("make", [bare, touching, hanging])
def test_the_smallest_levels_survive_being_written_and_read(
    make: Callable[[], dict[str, Any]],
) -> None:
    _survives(level(make()))


def _survives(made: Level) -> None:
    again = parse(made.model_dump_json(by_alias=True))

    assert again == made
    assert digest(again) == digest(made)


def test_a_level_cannot_be_changed() -> None:
    made = level(bare())

    with pytest.raises(ValueError, match="frozen"):
        made.title = "other"


def test_a_digest_depends_on_what_is_said_and_not_on_the_layout() -> None:
    made = digest(level(bare()))

    assert digest(parse(json.dumps(bare(), indent=7))) == made
    assert digest(parse(json.dumps(dict(reversed(bare().items()))))) == made
    assert digest(level(bare(), setting("duration", 1.0))) == made
    assert digest(level(bare(), setting("$schema", "elsewhere.json"))) == made
    assert digest(level(bare(), setting("duration", 2))) != made
    assert digest(level(bare(), setting("parameters.m.value", 3))) != made


def test_whole_numbers_are_numbers() -> None:
    made = level(bare(), setting("stepping", {"rate": 60}))

    assert made.stepping.rate == 60.0
    assert made.defaults == {"m": 2.0, "g": 9.81}


# Parameters


def test_chosen_values_stand_beside_the_defaults() -> None:
    made = level(bare())

    assert choose(made, {}) == {"m": 2, "g": 9.81}
    assert choose(made, {"m": 4}) == {"m": 4, "g": 9.81}


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({"M": 1}, "unknown parameter 'M'; did you mean 'm'?"),
        ({"x": 1}, "m, the mass, between 1 and 4 kg; g between 0 and 25 m/s²"),
        ({"m": 5}, "'m' is 5, but must lie between 1 and 4 kg"),
        ({"m": 0.5}, "'m' is 0.5, but must lie between 1 and 4 kg"),
        ({"m": float("nan")}, "'m' is nan, not a finite number"),
        ({"m": float("inf")}, "'m' is inf, not a finite number"),
    ],
)
def test_a_choice_that_a_parameter_does_not_have_is_told(
    settings: dict[str, float], told: str
) -> None:
    with pytest.raises(ValueRangeError) as caught:
        choose(level(bare()), settings)

    assert told in str(caught.value)


def test_a_choice_for_which_the_level_has_no_value_is_told() -> None:
    made = level(bare(), setting("bodies.ball.position", ["1/(m - 3)", 0]))

    with pytest.raises(ValueRangeError, match=r"m = 3 is not possible: bodies\.ball\.position\.0"):
        choose(made, {"m": 3})


def test_the_largest_level_of_the_project_is_far_below_the_limit() -> None:
    assert max(path.stat().st_size for path in SHIPPED) < MAX_BYTES / 5
