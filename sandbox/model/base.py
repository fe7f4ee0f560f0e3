"""The base class of every part of a level, and the names of its parts."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from sandbox.model.field_docstrings import docs


class Model(BaseModel):
    """A frozen part of a level that refuses keys it does not know."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True, strict=True)

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Return the schema, with the docstrings of the fields as descriptions."""
        made = handler(core)
        properties = handler.resolve_ref_schema(made)["properties"]
        for name, text in docs(cls).items():
            properties[cls.model_fields[name].alias or name].setdefault("description", text)
        return made


NAME = r"[A-Za-z][A-Za-z0-9_]{0,30}"
Name = Annotated[str, Field(pattern=f"^{NAME}$")]
"""The name of a body, joint, parameter or event: a letter, then letters, digits or _."""
