"""Work that importing the format postpones: every start of the program waits for an import."""

import subprocess
import sys

from sandbox.model.base import Model
from sandbox.model.effects import Effects
from sandbox.model.field_docstrings import docs
from sandbox.model.level import Level, Stepping
from sandbox.model.view import View

UNBUILT = """
from sandbox.model.base import Model
from sandbox.model.level import Level
from sandbox.model import field_docstrings
kinds = [Model]
for kind in kinds:
    kinds += kind.__subclasses__()
print(len(kinds), sum(kind.__pydantic_complete__ for kind in kinds[1:]))
print(field_docstrings.docs.cache_info().misses)
"""


def test_no_schema_is_built_and_no_text_read_before_somebody_wants_them() -> None:
    run = [sys.executable, "-c", UNBUILT]
    said = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    kinds, complete, read = map(int, said.split())

    assert kinds > 50
    assert complete == 0
    assert read == 0


def test_what_a_level_leaves_out_is_what_an_empty_part_says() -> None:
    for name, empty in {"effects": Effects(), "stepping": Stepping(), "view": View()}.items():
        assert Level.model_fields[name].default == empty


class Told(Model):
    """Something with fields."""

    first: int
    """the first,
    on two lines"""
    second: int  # nothing is said of it


class Again(Told):
    """The same, for a repeated declaration."""

    first: int
    third: int
    """the third"""


def test_a_field_is_told_by_the_text_below_it() -> None:
    assert docs(Told) == {"first": "the first,\non two lines"}
    assert docs(Again) == {"third": "the third"}
    assert Told.model_json_schema()["properties"]["first"]["description"] == docs(Told)["first"]
