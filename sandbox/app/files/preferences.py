"""The user's settings of the window, kept in the data folder."""

from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, TypeAdapter

from sandbox.app.drawing.theme import DARK, NAMES, Name
from sandbox.app.files import json_files
from sandbox.app.words.language import Name as Language
from sandbox.app.words.language import say, system_language
from sandbox.model.atomic_file_writing import data_folder

SIZES = (80, 90, 100, 110, 125, 150, 175, 200)
"""The sizes of text, in per cent of the standard size."""
USUAL = 100  # %
DENSE = 2000  # px, the height of a desktop from which pixels are too small for the standard size
ON_DENSE = 150  # %


def _one_of_the_sizes(size: int | None) -> int | None:
    if size is not None and size not in SIZES:
        raise ValueError(f"no size of text: {size} %; there are {SIZES}")
    return size


class Preferences(BaseModel):
    """The settings; unknown ones, of another version of the app, are ignored."""

    model_config = ConfigDict(frozen=True, extra="ignore")

    theme: Name = DARK
    size: Annotated[int | None, AfterValidator(_one_of_the_sizes)] = None
    """size of text [%]; None to suit the screen"""
    language: Language | None = None
    """language of the window; None for that of the system"""
    sound: bool = False
    """whether impacts are heard"""
    reduced: bool = False
    """whether nothing but the simulation moves or flashes"""


_KIND = TypeAdapter(Preferences)


def file() -> Path:
    """Return the path of the settings; the file need not exist."""
    return data_folder() / "settings.json"


def size_for_desktop(height: int) -> int:
    """Return the size of text [%] for a desktop of some height [px]: larger for small pixels."""
    return ON_DENSE if height >= DENSE else USUAL


class WindowPreferences:
    """The preferences of a window, initially those that were saved last.

    `desktop` is the height of the desktop [px]; 0 if unknown.
    """

    def __init__(self, desktop: int = 0) -> None:
        usual = Preferences()
        self.chosen = json_files.read(file(), _KIND, usual)
        """The current settings; every change replaces the object."""
        self.unreadable = self.chosen is usual and file().exists()
        """Whether there are saved settings that cannot be read."""
        self._suiting = size_for_desktop(desktop)

    @property
    def size(self) -> int:
        """The size of text [%]."""
        return self._suiting if self.chosen.size is None else self.chosen.size

    @property
    def language(self) -> Language:
        """The language of the window."""
        return self.chosen.language or system_language()

    @property
    def scale(self) -> float:
        """The factor by which text, and everything around it, is larger than the standard size."""
        return self.size / 100

    def complaint(self) -> str:
        """Return, once, that saved settings cannot be read; an empty string if they can."""
        unreadable, self.unreadable = self.unreadable, False
        if not unreadable:
            return ""
        return say("{file} cannot be read: the settings are those of a first start", file=file())

    def choose(self, **changes: object) -> str:
        """Change settings and save them; return why that fails, else an empty string."""
        self.chosen = _KIND.validate_python({**self.chosen.model_dump(), **changes})
        why = json_files.write(file(), _KIND, self.chosen)
        return say("the settings could not be saved: {why}", why=why) if why else ""

    def resize(self, direction: int) -> str:
        """Choose the next larger or smaller size of text; see `choose`."""
        beyond = [size for size in SIZES if (size - self.size) * direction > 0]
        if not beyond:
            return ""
        return self.choose(size=min(beyond) if direction > 0 else max(beyond))

    def next_theme(self) -> str:
        """Choose the theme after this one; see `choose`."""
        index = NAMES.index(self.chosen.theme)
        return self.choose(theme=NAMES[(index + 1) % len(NAMES)])
