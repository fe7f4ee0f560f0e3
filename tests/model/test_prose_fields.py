"""Texts for people are marked where a field is declared, and found wherever they are used."""

import json
from collections.abc import Iterator
from typing import Any, get_args, get_type_hints

import pytest

from sandbox.model.annotated_field_search import Words, prose
from sandbox.model.base import Model
from sandbox.model.level import Level, Parameter
from sandbox.model.loading import parse
from sandbox.model.reference_fields import Mention
from tests.model.levels import bare

NO_WORDS = {"unit", "color", "schema_", "name"}
"""Texts that no person reads as words."""


def models(kind: Any, known: set[type[Model]]) -> Iterator[type[Model]]:  # noqa: ANN401
    """Yield the models that a type is made of, each once."""
    if isinstance(kind, type) and issubclass(kind, Model):
        if kind not in known:
            known.add(kind)
            yield kind
            for hint in get_type_hints(kind, include_extras=True).values():
                yield from models(hint, known)
        return
    for part in get_args(kind):
        yield from models(part, known)


def texts(hint: Any, marks: tuple[object, ...] = ()) -> Iterator[tuple[object, ...]]:  # noqa: ANN401
    """Yield, for each text that a type may be or contain as a value, its marks."""
    if hint is str:
        yield marks
    metadata = getattr(hint, "__metadata__", None)
    if metadata is not None:
        yield from texts(hint.__origin__, (*marks, *metadata))
    elif len(parts := get_args(hint)) == 2 and "Mapping" in str(hint):
        yield from texts(parts[1])
    else:
        for part in parts:
            yield from texts(part, marks)


def test_every_text_of_a_level_is_words_or_a_name() -> None:
    """A new text of the format must say which, or nobody would translate it."""
    unsaid = {
        f"{model.__name__}.{field}"
        for model in models(Level, set())
        for field, hint in get_type_hints(model, include_extras=True).items()
        if field not in NO_WORDS
        for marks in texts(hint)
        if not any(isinstance(mark, Words | Mention) for mark in marks)
    }

    assert unsaid == set()


def test_words_are_found_with_their_places() -> None:
    data = bare() | {"view": {"labels": [{"text": "here", "at": [0, 1]}]}}
    data["checks"][0]["label"] = "fallen"

    assert dict(prose(parse(json.dumps(data)))) == {
        ("title",): "A ball",
        ("parameters", "m", "label"): "mass",
        ("checks", 0, "label"): "fallen",
        ("view", "labels", 0, "text"): "here",
    }


@pytest.mark.parametrize(("label", "found"), [("", []), ("mass", ["mass"])])
def test_an_empty_text_has_no_words(label: str, found: list[str]) -> None:
    parameter = Parameter(value=1, min=0, max=2, unit="kg", label=label)

    assert [text for _, text in prose(parameter)] == found
