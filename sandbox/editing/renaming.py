"""Renaming a body, a joint or a parameter everywhere in its level."""

import json
import re
from collections.abc import Collection, Iterator, Mapping

from sandbox.editing.cleanup_after_edit import accepted
from sandbox.editing.formula_arithmetic import renamed
from sandbox.editing.json_spans import Spans
from sandbox.editing.text_patches import spliced
from sandbox.model.base import NAME
from sandbox.model.comments import read_level
from sandbox.model.errors import SandboxError, brief
from sandbox.model.expression_compiler import RESERVED
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions
from sandbox.model.loading import parse
from sandbox.model.quantities import quantity
from sandbox.model.rules.consistency.references_by_name import mentions

PARTS = {"parameter": "parameters", "joints": "joints", "forces": ""}
"""For each kind of mention, the part of a level that it names; all other kinds name bodies."""


def rename(text: str, path: Path, name: str) -> str:
    """Return a level in which a body, a joint or a parameter has a new name.

    All mentions are replaced: in the ends of joints, effects, quantities and ghosts; for a
    parameter, in formulas and the challenge. Prose is left unchanged. The path of a part is, for
    example, `("bodies", "box1")`. Raises `LevelError` if the level has mistakes, or would have some
    with the new name. Raises `SandboxError` if nothing has the old name, the new name is taken, or
    it is not a valid name.
    """
    level = parse(text)
    part, old = path
    if part not in ("bodies", "joints", "parameters") or old not in getattr(level, str(part)):
        raise SandboxError("there is no {path} to be renamed", path=".".join(map(str, path)))
    if name == old:
        return text
    _refuse_taken(level, str(part), name)
    return accepted(_renamed_in(text, level, path, name))


def rename_numbers(text: str, level: Level, names: Mapping[str, str]) -> str:
    """Return a level in which parameters and constants have new names, free ones, by the old.

    The level, that of the text, may have mistakes beyond its form.
    """
    for old, name in names.items():
        part = "parameters" if old in level.parameters else "constants"
        text = _renamed_in(text, level, (part, old), name)
        level = read_level(text)
    return text


def _renamed_in(text: str, level: Level, path: Path, name: str) -> str:
    part, old = map(str, path)
    kind = "parameters" if part == "constants" else part  # formulas mention both alike
    renamed = dict(_renamed(level, kind, old, name))
    solution: list[Path] = [("challenge", "solution", old)] if kind == "parameters" else []
    return _replaced(text, renamed, [path, *solution], name)


def _refuse_taken(level: Level, part: str, name: str) -> None:
    if not re.fullmatch(NAME, name):
        raise SandboxError(
            "'{name}' is not a name: a letter, then letters, digits or _", name=brief(name)
        )
    numbers = {**level.parameters, **level.constants}
    among = numbers if part == "parameters" else {**level.bodies, **level.joints}
    if name in among or (part == "parameters" and name in RESERVED):
        raise SandboxError("the name '{name}' is taken; choose another one", name=name)


def _renamed(level: Level, part: str, old: str, name: str) -> Iterator[tuple[Path, str]]:
    """Yield the path of each mention of a name, and its new text."""
    for path, value, mention in mentions(level):
        texts = [(path, value)]
        if not isinstance(value, str):
            texts = [((*path, index), item) for index, item in enumerate(value)]
        of = PARTS.get(mention.of, "bodies")
        for place, text in texts:
            if mention.of == "quantity":
                if part != "parameters" and (new := _quantity(text, level, old, name)) != text:
                    yield place, new
            elif (of, text) == (part, old):
                yield place, name
    if part == "parameters":
        yield from _in_formulas(level, old, name)


def _quantity(text: str, level: Level, old: str, name: str) -> str:
    """Return the name of a quantity after a body or joint was renamed."""
    words = text.split(".")
    if words[0] == old:
        words[0] = name
    if quantity(text, level).other == old:
        words[2] = name  # as in a.contact.b.normal
    return ".".join(words)


def _in_formulas(level: Level, old: str, name: str) -> Iterator[tuple[Path, str]]:
    for path, expression in expressions(level):
        if old in expression.names_written:
            yield path, renamed(str(expression.source), old, name)


def _replaced(text: str, renamed: Mapping[Path, str], keys: Collection[Path], name: str) -> str:
    """Return a text in which strings at some paths are replaced, and the keys of other values."""
    found, pieces = Spans(text), []
    for path in filter(found.__contains__, (*renamed, *keys)):
        span = found[path]
        is_word = path not in keys and text.startswith('"', span.begin)
        start = span.begin if is_word else span.start
        end = json.JSONDecoder().raw_decode(text, start)[1]
        pieces.append((start, end, json.dumps(renamed[path] if is_word else name)))
    return spliced(text, pieces)
