"""Messages to people: English texts with values in them, prepared for translation."""

from collections.abc import Iterable, Mapping
from functools import reduce
from typing import Self


class Message(str):
    """An English text that keeps its template and its values.

    To code that prints, compares or searches it, it is a `str`. A translator looks up its template,
    which must therefore be a literal in the code, and fills in the values. An f-string or a `+`
    turns it into a `str` that stays English; inserting it into another template does not.
    """

    __slots__ = ("template", "values")
    template: str
    """The text, with `{name}` for each value."""
    values: Mapping[str, object]
    """The values by name; messages among them are translated as well."""

    def __new__(cls, template: str, /, **values: object) -> Self:
        """Make a message; without values, braces in the template are literal."""
        made = super().__new__(cls, template.format(**values) if values else template)
        made.template, made.values = template, values
        return made

    def filled(self, **values: object) -> "Message":
        """Return the message with values for its placeholders, if it was made without."""
        return Message(self.template, **values)

    def __reduce__(self) -> tuple[object, ...]:
        """Keep the values when pickled."""
        return _made, (self.template, self.values)


def _made(template: str, values: Mapping[str, object]) -> Message:
    return Message(template, **values)


def message(text: str, values: Mapping[str, object]) -> Message:
    """Return a message as it is, or make one of a template and its values."""
    return text if isinstance(text, Message) else Message(text, **values)


def word(name: str) -> Message:
    """Return a name of the format, such as a type of body, as a message for the catalogues."""
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
    """Join messages with a separator that needs no translation."""
    values = {f"part{index}": part for index, part in enumerate(parts)}
    return Message(separator.join(f"{{{name}}}" for name in values), **values)


NOTHING = joined((), "")
