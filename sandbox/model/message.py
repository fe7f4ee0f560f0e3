"""Messages to people: English, with the values in them, so that they can be translated."""

from collections.abc import Iterable, Mapping
from functools import reduce
from typing import Self


class Message(str):
    """A text in English that keeps its template and its values.

    It is a `str` to whoever prints, compares or searches it. Whoever speaks another language looks
    up its template, which therefore stands as a literal in the code, and fills in its values. An
    f-string or a `+` makes a `str` of it that is English for good; a template with a place for it
    does not.

    Attributes
    ----------
    template
        With a `{name}` in braces for each value.
    values
        What stands in the place of the names; messages among them are translated, too.
    """

    __slots__ = ("template", "values")
    template: str
    values: Mapping[str, object]

    def __new__(cls, template: str, /, **values: object) -> Self:
        """Make it; without values, braces in the template are braces."""
        made = super().__new__(cls, template.format(**values) if values else template)
        made.template, made.values = template, values
        return made

    def filled(self, **values: object) -> "Message":
        """Return the same with values for its places, if it was made without."""
        return Message(self.template, **values)

    def __reduce__(self) -> tuple[object, ...]:
        """Keep the values on the way to another process."""
        return _made, (self.template, self.values)


def _made(template: str, values: Mapping[str, object]) -> Message:
    return Message(template, **values)


def word(name: str) -> Message:
    """Return a name that the format declares, such as a type of body: catalogues have them all."""
    return Message(name)


def either(names: Iterable[str]) -> Message:
    """Return a choice of names: "a or b"."""
    made = reduce(lambda one, other: Message("{one} or {other}", one=one, other=other), names)
    return Message("{made}", made=made)


def both(names: Iterable[str]) -> Message:
    """Return all of some names: "a and b"."""
    made = reduce(lambda one, other: Message("{one} and {other}", one=one, other=other), names)
    return Message("{made}", made=made)


def joined(parts: Iterable[Message], separator: str) -> Message:
    """Return one message of several, which are separated by signs alone."""
    values = {f"part{index}": part for index, part in enumerate(parts)}
    return Message(separator.join(f"{{{name}}}" for name in values), **values)


NOTHING = joined((), "")
