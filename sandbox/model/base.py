"""The base class of every part of a level."""

from pydantic import BaseModel, ConfigDict


class Model(BaseModel):
    """A frozen part of a level that refuses keys it does not know."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", defer_build=True, use_attribute_docstrings=True, strict=True
    )
