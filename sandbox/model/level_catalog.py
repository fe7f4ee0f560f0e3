"""The levels that come with the project: one JSON file each, in a folder a chapter."""

import os
from functools import cache
from pathlib import Path

from sandbox.model.did_you_mean import did_you_mean, suggestion
from sandbox.model.errors import MisuseError, brief
from sandbox.model.json_document import refuse
from sandbox.model.translatable_message import Message

CHAPTERS = (
    "kinematics",
    "newton",
    "energy",
    "momentum",
    "rotation",
    "lagrange",
    "machines",
    "challenges",
)
"""The folders in the order of the chapter, then those made of it; any others follow by name."""

ORDER = "order.txt"
"""The file with the order of a chapter's levels; any others follow by name."""

SCHEMA = "level.schema.json"
"""The file of the format's JSON Schema, beside the chapters."""

CHALLENGES = "challenges"
"""The folder of the levels that set a task."""

HARD = "hard"
"""The folder of the hard cases: scenes that break engines, written by `validation.stability`."""


@cache
def root() -> Path:
    """Return the folder of the levels: inside an installed package, beside it in a checkout."""
    package = Path(__file__).resolve().parents[1]
    installed = package / "levels"
    return installed if installed.is_dir() else package.parent / "levels"


def sources() -> Path:
    """Return the folder of the project's sources; raise `MisuseError` if they are not installed."""
    folder = Path(__file__).resolve().parents[2]
    if not (folder / "pyproject.toml").is_file():
        package = Path(__file__).resolve().parents[1]
        raise MisuseError(
            "this is written in a checkout of the project; {package} is installed", package=package
        )
    return folder


def names() -> list[str]:
    """Return the names of all levels, such as `newton/atwood`, chapter by chapter."""
    order = root() / ORDER
    listed = order.read_text("utf-8").split() if order.is_file() else []
    place = {name: i for i, name in enumerate(listed)}

    def by_chapter(found: tuple[str, str]) -> tuple[int, str, int, str]:
        chapter, level = found
        known = CHAPTERS.index(chapter) if chapter in CHAPTERS else len(CHAPTERS)
        return known, chapter, place.get(f"{chapter}/{level}", len(place)), level

    levels = ((path.parent.name, path.stem) for path in root().glob("*/*.json"))
    return [f"{chapter}/{level}" for chapter, level in sorted(levels, key=by_chapter)]


def textbook() -> list[str]:
    """Return the names of the levels that belong to the document, part by part."""
    return [name for name in names() if name.partition("/")[0] not in (HARD, CHALLENGES)]


def challenges() -> list[str]:
    """Return the names of the levels that set a task, with what the document teaches."""
    return [name for name in names() if name.startswith(f"{CHALLENGES}/")]


def find(level: str) -> Path:
    """Return the path of a level's file.

    The level is a path, a name such as `newton/atwood`, or the last part of a name if only one
    level's name ends with it. Raises `LevelError` if there is no such level; the message suggests
    what was probably meant.
    """
    if _is_file(level):
        return Path(level)
    known = names()
    name = level.replace("\\", "/").removesuffix(".json")
    if name in known:
        return root() / f"{name}.json"
    if level.endswith(".json"):
        if os.path.lexists(level):  # such as a folder or a broken link, which the reader refuses
            return Path(level)
        hint = did_you_mean(Path(level).stem, _endings(known))
        refuse(brief(level), "there is no such file{hint}", hint=hint)
    ending = [other for other in known if other.endswith(f"/{name}")]
    if not ending:
        refuse(brief(level), "is neither a level nor a file{hint}", hint=_hint(name, known))
    if len(ending) > 1:
        refuse(brief(level), "is the name of several levels: {names}", names=", ".join(ending))
    return root() / f"{ending[0]}.json"


def _is_file(path: str) -> bool:
    try:
        return Path(path).is_file()
    except (OSError, ValueError):  # an impossible file name, or a locked folder
        return False


def _hint(name: str, known: list[str]) -> Message:
    """Suggest a level by its whole name, or by its last part if only that was given."""
    return suggestion(name, known if "/" in name else _endings(known))


def _endings(known: list[str]) -> list[str]:
    return [name.rpartition("/")[2] for name in known]
