"""The challenges that were solved, kept in the user's data folder."""

from pathlib import Path
from typing import Annotated

from pydantic import Field, TypeAdapter

from sandbox.app.files import user_data
from sandbox.app.words.language import say
from sandbox.model.files import data_folder

_STARS = TypeAdapter(dict[str, Annotated[int, Field(ge=1, le=3)]])


def file() -> Path:
    """Return where the stars are kept; it need not be there."""
    return data_folder() / "stars.json"


class Progress:
    """How many stars each challenge has earned so far, by the title of its level.

    A file that is missing, or that something else has written, counts as none.
    """

    def __init__(self) -> None:
        self._stars = _read()

    def stars(self, title: str) -> int:
        """Return the most stars that a level's challenge has earned."""
        return self._stars.get(title, 0)

    def earn(self, title: str, stars: int) -> str:
        """Note stars, if they are more than before; return why they cannot be kept, if so."""
        if stars <= self.stars(title):
            return ""
        self._stars = {**_read(), **self._stars, title: stars}  # another window may have some, too
        why = user_data.keep(file(), _STARS, self._stars)
        return say("the stars could not be saved: {why}", why=why) if why else ""


def _read() -> dict[str, int]:
    return user_data.read(file(), _STARS, {})
