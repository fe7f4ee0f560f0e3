"""The names of bodies, joints, parameters and events."""

from typing import Annotated

from pydantic import Field

NAME = r"[A-Za-z][A-Za-z0-9_]{0,30}"
Name = Annotated[str, Field(pattern=f"^{NAME}$")]
"""A letter, then letters, digits or _."""
