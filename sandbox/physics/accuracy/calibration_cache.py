"""A cache of calibrated settings, in the user's cache folder.

The key of an entry is a hash of everything that the result depends on: the level, its parameters,
the accuracy, the sandbox's code and the versions of its dependencies. No stale entry is ever used.
"""

import platform
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from hashlib import sha256
from json import dumps
from math import isfinite
from pathlib import Path

import numpy as np
import platformdirs
import pymunk
from pydantic import TypeAdapter, ValidationError

from sandbox import version
from sandbox.model.atomic_file_writing import make_folder, write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.file_reading import read_ordinary
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import digest
from sandbox.physics.accuracy.compared_runs import Stop, never
from sandbox.physics.accuracy.refinement_scheduling import Progress
from sandbox.physics.accuracy.requested_accuracy import Setting, calibrate
from sandbox.physics.scene.usable_schemes import require
from sandbox.physics.state.simulation_errors import SchemeError

_SETTING = TypeAdapter(Setting)
_ENTRY = TypeAdapter(tuple[str, str, Setting])
"""A hash, a key and its setting; the hash covers both, so that an edited entry is ignored."""

_unkept: dict[str, Setting] = {}
"""The entries that could not be written, for as long as this process lives."""

LARGEST = 10_000
"""The largest file that is read [bytes]; a larger one was not written by this program."""


def calibrated(
    level: Level,
    values: Values | None = None,
    target: float = 1e-6,
    stop: Stop = never,
    tell: Callable[[str], None] | None = None,
    also: Sequence[str] = (),
    progress: Progress | None = None,
) -> Setting:
    """Return the cheapest setting that reaches an accuracy, from the cache if it is there.

    The arguments are those of `calibrate`, and so are the errors; a search that `stop` ends stores
    nothing. `tell` gets the reason if the setting cannot be stored.
    """
    values = level.defaults if values is None else values
    if found := recalled(level, values, target, also):
        return found
    setting = calibrate(level, values, target, progress=progress, stop=stop, also=also)
    keep(level, values, setting, tell, also)
    return setting


def recalled(
    level: Level, values: Values, target: float, also: Sequence[str] = ()
) -> Setting | None:
    """Return the setting that was found for an accuracy earlier; None if there is none."""
    key = _key(level, values, target, also)
    return _unkept.get(key) or _read(_path(key), key, level)


def keep(
    level: Level,
    values: Values,
    setting: Setting,
    tell: Callable[[str], None] | None = None,
    also: Sequence[str] = (),
) -> None:
    """Store a setting on disk or, if that fails, in memory for the rest of this process.

    `tell` gets the reason of a failure; `also` are the other quantities that are as accurate.
    """
    key = _key(level, values, setting.target, also)
    path = _path(key)
    try:
        make_folder(path.parent)
        if link := _link(path.parent):
            raise SandboxError("{link} is a link, which may lead anywhere", link=link)
        entry = _ENTRY.dump_json((key, _hash(key, setting), setting))
        write_atomically(path, entry, follow=False)
    except (OSError, SandboxError) as error:
        _unkept[key] = setting
        if tell:
            tell(f"the setting is not kept for the next time: {error}")


def resolved(
    level: Level, values: Values, stepping: Stepping, also: Sequence[str] = ()
) -> Stepping:
    """Return the stepping of a level, calibrated if the level asks for an accuracy.

    `also` are further quantities that must be as accurate as those of the checks and the motion.
    """
    if stepping.accuracy is None:
        return stepping
    return calibrated(level, values, stepping.accuracy, also=also).chosen.stepping


def folder() -> Path:
    """Return the folder of the cached settings, which may not exist."""
    return platformdirs.user_cache_path("mechanics-sandbox") / "accuracy"


def _path(key: str) -> Path:
    return folder() / f"{key}.json"


def _read(path: Path, key: str, level: Level) -> Setting | None:
    """Return the setting in a file; None if the file was not written by `_write`."""
    try:
        if _link(path.parent) or (content := read_ordinary(path, LARGEST)) is None:
            return None
        held, checked, setting = _ENTRY.validate_json(content)
        require(level, setting.chosen.stepping.scheme)
    except (OSError, ValidationError, SchemeError):
        return None
    chosen = setting.chosen
    sound = isfinite(chosen.cost) and 0 <= chosen.error <= setting.target
    return setting if sound and held == key and checked == _hash(key, setting) else None


def _link(entries: Path) -> Path | None:
    """Return whichever of the sandbox's own folders is a symbolic link; None if neither is."""
    own = entries, entries.parent
    return next((path for path in own if path.is_symlink()), None)


def _hash(key: str, setting: Setting) -> str:
    return sha256(key.encode() + _SETTING.dump_json(setting)).hexdigest()


def _key(level: Level, values: Values, target: float, also: Sequence[str]) -> str:
    key = (digest(level), sorted(values.items()), target, sorted(set(also)), _code())
    return sha256(dumps(key).encode()).hexdigest()[:32]


@cache
def _code() -> str:
    """Return a hash of everything that decides how a level runs, and of the machine."""
    found = sha256()
    root = Path(version.__file__).parent
    for part in (*_versions(), *_sources(root)):
        found.update(part)
    return found.hexdigest()


def _versions() -> Iterator[bytes]:
    for name in (platform.python_version(), np.__version__, pymunk.version, platform.node()):
        yield name.encode()


def _sources(root: Path) -> Iterator[bytes]:
    for package in ("model", "physics"):
        for path in sorted((root / package).rglob("*.py")):
            yield str(path.relative_to(root)).encode()
            yield path.read_bytes()
