"""Repeated members: `"ball{i}": {"repeat": {"i": 5}, ...}` stands for five bodies.

A member of a list, or of a part with named members, repeats if it has the key `repeat`. In its
copies, expressions in braces are replaced by numbers, in texts and names. A member that is not an
object, such as a point, is put under `each`:
`{"repeat": {"i": 6}, "each": ["cos({i}*60*deg)", "sin({i}*60*deg)"]}`.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, get_origin

from sandbox.model.errors import brief
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.shorthand.expansion_notes import Notes
from sandbox.model.shorthand.indices import IndexFault, Indices, filled, runs
from sandbox.model.translatable_message import Message

REPEAT = "repeat"
EACH = "each"

GROUPS = "groups"
POINTS = "points"

NAMED = (
    *(
        name
        for name, known in Level.model_fields.items()
        if get_origin(known.annotation) is Mapping
    ),
    GROUPS,
)
"""The parts of a level with named members."""

_IN_GROUP = 3
"""The depth of the bodies and joints in a group."""


def order(names: Iterable[str]) -> list[str]:
    """Return top-level keys in the order of the format, with the groups."""
    found = [name for name in names if name != GROUPS]
    found.insert(found.index("bodies"), GROUPS)
    return found


def repeated(data: Any, notes: Notes) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return a level with all repeated members expanded."""
    return _Copying(notes).part(data, (), (), {})


class _Copying:
    """Copies the parts of a level into their expansion."""

    def __init__(self, notes: Notes) -> None:
        self._notes = notes

    def part(self, part: Any, typed: Path, made: Path, indices: Indices) -> Any:  # noqa: ANN401
        """Return a copy of a part, given the paths at which it was typed and will be."""
        if indices:
            self._notes.charge(0, typed)
        if isinstance(part, dict):
            return self._object(part, typed, made, indices)
        if isinstance(part, list):
            return self._list(part, typed, made, indices)
        return self._text(part, typed, indices) if isinstance(part, str) else part

    def _object(self, part: Mapping[str, Any], typed: Path, made: Path, indices: Indices) -> Any:  # noqa: ANN401
        found: dict[str, Any] = {}
        named = _has_named_members(typed)
        for key, value in part.items():
            for member, where, inner in self._copies(value, (*typed, key), indices, named):
                name = self._text(key, (*typed, key), inner)
                if name in found and not self._notes.faults:
                    rule = Message(
                        "there is more than one '{name}'; put an index into the name, such as"
                        " {typed}{{{index}}}",
                        name=brief(name),
                        typed=name,
                        index=[*inner, "i"][0],
                    )
                    self._notes.refuse((*typed, key), rule)
                place = (*made, name)
                self._note(place, where, aside=name != key or where[-1] != key)
                found[name] = self.part(member, where, place, inner)
        return found

    def _list(self, part: list[Any], typed: Path, made: Path, indices: Indices) -> list[Any]:
        found: list[Any] = []
        for index, value in enumerate(part):
            for member, where, inner in self._copies(value, (*typed, index), indices, True):
                place = (*made, len(found))
                self._note(place, where, aside=place[-1:] != where[len(typed) :])
                found.append(self.part(member, where, place, inner))
        return found

    def _copies(
        self,
        value: Any,  # noqa: ANN401
        typed: Path,
        indices: Indices,
        repeats: bool,
    ) -> Iterator[tuple[Any, Path, Indices]]:
        """Yield the copies of a member, with their paths in the text and their indices."""
        if not (repeats and isinstance(value, dict) and REPEAT in value):
            yield value, typed, indices
            return
        rest = {key: inside for key, inside in value.items() if key != REPEAT}
        each = list(rest) == [EACH]
        if EACH in rest and not each:
            other = next(key for key in rest if key != EACH)
            rule = Message(
                "'{other}' cannot be combined with '{each}', which is the whole member",
                other=brief(other),
                each=EACH,
            )
            self._notes.refuse((*typed, other), rule)
            return
        for inner in runs(value[REPEAT], (*typed, REPEAT), indices, self._notes):
            yield (rest[EACH], (*typed, EACH), inner) if each else (rest, typed, inner)

    def _note(self, made: Path, typed: Path, *, aside: bool) -> None:
        if aside:
            self._notes.typed[made] = typed

    def _text(self, text: str, typed: Path, indices: Indices) -> str:
        if not indices:
            return text  # braces have no meaning outside repeated members
        self._notes.charge(len(text), typed)
        try:
            return filled(text, indices)
        except IndexFault as fault:
            self._notes.refuse(typed, fault.message)
            return text


def _has_named_members(path: Path) -> bool:
    if path[-1:] == (POINTS,) and path[-3:-2] == ("bodies",):
        return True
    if path[:1] == (GROUPS,):
        return len(path) in (1, _IN_GROUP)
    return len(path) == 1 and path[0] in NAMED
