"""The docstrings of a model's fields: the text below each field in the source.

pydantic can read these texts when a class is made, but that takes as long as making it. Here they
are read on demand.
"""

import ast
import inspect
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import pairwise
from textwrap import dedent

from pydantic import BaseModel


@cache
def docs(model: type[BaseModel]) -> Mapping[str, str]:
    """Return the docstrings of a model's fields, including inherited ones."""
    documented: dict[str, str] = {}
    for kind in reversed(model.__mro__[: model.__mro__.index(BaseModel)]):
        own = dict(_docs(kind))
        documented = {
            name: text for name, text in documented.items() if name not in kind.__annotations__
        } | own
    texts = {name: field.description for name, field in model.model_fields.items()}
    return documented | {name: text for name, text in texts.items() if text is not None}


def _docs(kind: type) -> Iterator[tuple[str, str]]:
    """Yield the names and docstrings of the fields that a class declares itself."""
    try:
        source = ast.parse(dedent(inspect.getsource(kind))).body[0]
    except (OSError, TypeError):  # made from another class, or without a file
        return
    assert isinstance(source, ast.ClassDef)
    for field, below in pairwise(source.body):
        match field, below:
            case (
                ast.AnnAssign(target=ast.Name(id=name)),
                ast.Expr(value=ast.Constant(value=str(text))),
            ):
                yield name, inspect.cleandoc(text)
