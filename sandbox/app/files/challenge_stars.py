"""The stars of solved challenges, kept in the user's data folder."""

from pathlib import Path
from typing import Annotated

from pydantic import Field, TypeAdapter

from sandbox.app.files import json_files
from sandbox.app.words.language import say
from sandbox.model.atomic_file_writing import data_folder

_STARS = TypeAdapter(dict[str, Annotated[int, Field(ge=1, le=3)]])


def file() -> Path:
    """Return the path of the stars; the file need not exist."""
    return data_folder() / "stars.json"


class ChallengeStars:
    """The number of stars that each challenge has earned, by the title of its level.

    A file that is missing or not valid counts as empty.
    """

    def __init__(self) -> None:
        self._stars = _read()

    def stars(self, title: str) -> int:
        """Return the most stars that a level's challenge has earned."""
        return self._stars.get(title, 0)

    def earn(self, title: str, stars: int) -> str:
        """Save stars if they are more than before; return why that fails, else an empty string."""
        if stars <= self.stars(title):
            return ""
        self._stars = {**_read(), **self._stars, title: stars}  # with those of other windows
        why = json_files.write(file(), _STARS, self._stars)
        return say("the stars could not be saved: {why}", why=why) if why else ""


def _read() -> dict[str, int]:
    return json_files.read(file(), _STARS, {})
