"""A level's JSON text: its values, their positions, and reports of mistakes."""

import json
import re
import sys
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import islice
from typing import Any, NoReturn

from sandbox.model import json_positions, parser_error_messages
from sandbox.model.comments import members
from sandbox.model.errors import MAX_MISTAKES, LevelError, Mistake, brief
from sandbox.model.json_positions import Origin, Path, Position, Value
from sandbox.model.level_parts import Fault
from sandbox.model.translatable_message import Message, message

_NOT_FINITE = frozenset({"NaN", "Infinity", "-Infinity"})
_HALF = re.compile(r"\\u[dD][89a-fA-F]")
"""The beginning of an escape for a surrogate; a pair of them is one character."""

DEEPEST = 100
"""The nesting of brackets above which an unreadable text is too deep; a level has ten."""


def refuse(
    source: str, rule: str, /, *, position: Position | None = None, **values: object
) -> NoReturn:
    """Raise a `LevelError` about a level as a whole, or about a position in its text."""
    line, column = position or (None, None)
    raise LevelError((Mistake(source, line, column, "", message(rule, values)),))


class Document(Origin):
    """The text of a level that is being read."""

    def read(self) -> Any:  # noqa: ANN401 (whatever JSON holds)
        """Return the value of the text; refuse repeated keys and numbers that are not finite."""
        if not self.text.strip():
            refuse(self.source, "is empty")
        suspects: list[str] = []

        def pairs(items: list[tuple[str, Any]]) -> dict[str, Any]:
            if len(dict(items)) < len(items):
                suspects.append("a key")
            return members(items)

        try:
            data = json.loads(self.text, object_pairs_hook=pairs, parse_constant=suspects.append)
        except json.JSONDecodeError as error:
            refuse(
                self.source,
                parser_error_messages.syntax(error),
                position=(error.lineno, error.colno),
            )
        except RecursionError:
            self.refuse_depth()
        except ValueError:
            at = json_positions.long_number(self.text, sys.get_int_max_str_digits())
            self._refuse_at(at, Message("has a whole number with thousands of digits"))
        suspected = suspects or _HALF.search(self.text)
        if suspected and (found := list(islice(self._suspects(), MAX_MISTAKES + 1))):
            self._raise(found)
        return data

    def refuse(self, faults: Iterable[Fault]) -> NoReturn:
        """Raise all faults, in the order of the text; of copies, only the first's."""
        found = islice(_distinct(faults), MAX_MISTAKES + 1)
        once: dict[Any, Mistake] = {}
        for mistake in map(self._mistake, found):
            once.setdefault((mistake.line, mistake.column, mistake.rule), mistake)
        self._raise(sorted(once.values(), key=lambda m: (m.line or 0, m.column or 0)))

    def refuse_depth(self) -> NoReturn:
        """Refuse too deeply nested brackets, at the first of them."""
        at = json_positions.nested_beyond(self.text, DEEPEST)
        rule = Message("is nested too deeply: more than {most} levels of brackets", most=DEEPEST)
        self._refuse_at(at, rule)

    def _refuse_at(self, index: int, rule: Message) -> NoReturn:
        refuse(self.source, rule, position=json_positions.position(self.text, index))

    def start(self, path: Path) -> int:
        """Return the index in the text of a part or, if it is missing, of what encloses it."""
        return self.nearest(path).start

    def _raise(self, mistakes: Iterable[Mistake]) -> NoReturn:
        found = list(islice(mistakes, MAX_MISTAKES + 1))
        if len(found) > MAX_MISTAKES:
            more = Message("and more mistakes like these")
            found[-1] = Mistake(self.source, None, None, "", more)
        raise LevelError(tuple(found))

    def _suspects(self) -> Iterator[Mistake]:
        """Yield what JSON parsers accept, but a level must not contain."""
        for value in json_positions.values(self.text):
            if value.repeated:
                key = brief(str(value.path[-1]))
                rule = Message("the key '{key}' occurs twice in one object", key=key)
                yield self._at(value, value.path, rule)
            if value.text in _NOT_FINITE:
                rule = Message("{value} is not a number for a level", value=value.text)
                yield self._at(value, value.path, rule)
            if _halved(value):
                rule = Message(
                    "half of a character: \\ud800 to \\udbff need \\udc00 to \\udfff next"
                )
                yield self._at(value, value.path, rule)

    def _mistake(self, fault: Fault) -> Mistake:
        """Locate a fault; if the part is missing, at what encloses it."""
        value = self.nearest(fault.path)
        mistake = self._at(value, fault.path, fault.rule)
        there = value.path == self.typed(fault.path)
        tells = there and value.text not in "{[" and not _says(fault, value)
        return replace(mistake, value=brief(value.text)) if tells else mistake

    def _at(self, value: Value, path: Path, rule: Message) -> Mistake:
        line, column = json_positions.position(self.text, value.start)
        shown = ".".join(brief(str(step)) for step in path)
        return Mistake(self.source, line, column, shown, rule)


def _halved(value: Value) -> bool:
    """Whether the key or the text of a value contains a lone surrogate."""
    texts = [str(step) for step in value.path[-1:]]
    texts += [json.loads(value.text)] if value.text.startswith('"') else []
    return any("\ud800" <= letter <= "\udfff" for text in texts for letter in text)


def _says(fault: Fault, value: Value) -> bool:
    """Whether the message already names the value, or is about the key."""
    known = brief(value.text.strip('"'))
    about_key = bool(fault.path) and f"'{fault.path[-1]}'" in fault.rule
    return about_key or bool(re.search(rf"(?<![\w.]){re.escape(known)}(?![\w.])", fault.rule))


def _distinct(faults: Iterable[Fault]) -> Iterator[Fault]:
    """Yield each fault once; no more are made than are taken, as explaining one takes time."""
    seen: set[Fault] = set()
    for fault in faults:
        if fault not in seen:
            seen.add(fault)
            yield fault
