"""Small pictures of levels, drawn by the stage and cached on disk by a hash of the level's file."""

import hashlib
import os
from collections.abc import Iterator
from contextlib import suppress
from math import ceil
from multiprocessing.connection import Connection
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import platformdirs
import pygame

from sandbox.app import level_picture
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.app.words import language
from sandbox.model.atomic_file_writing import without_links, write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.file_reading import read_ordinary
from sandbox.model.loading import MAX_BYTES, load
from sandbox.version import __version__

SIZE = 320, 200  # px
DRAWN = 480, 300  # px, before scaling down, which makes lines thinner
LOOK = 2
"""A number to raise when the stage draws levels differently, so that no older picture is shown."""
PATIENCE = 1.0  # s of computing, after which a run is drawn at its current step
MOST = 1000
"""The largest number of pictures in the cache; older ones are removed."""
LARGEST = 500_000
"""The largest picture that is read [bytes]; a larger one was not written by this program."""

_BEGIN, _END = b"\x89PNG\r\n\x1a\n", b"IEND\xaeB`\x82"
"""The first and the last bytes of a complete PNG file."""


class Picture(NamedTuple):
    """A picture of a level."""

    path: Path
    """the level's file"""
    key: str
    """the picture's key in the cache; empty if the file cannot be read"""
    png: bytes
    """the PNG file; empty if the level cannot be drawn"""


def folder() -> Path:
    """Return the folder of the cache; it need not exist."""
    return platformdirs.user_cache_path("mechanics-sandbox") / "pictures"


def key(path: Path) -> str:
    """Return the key of a level's picture, a hash of everything that the picture depends on.

    Raises `OSError` if the file cannot be read, or is larger than a level may be.
    """
    content = read_ordinary(without_links(path), MAX_BYTES)
    if content is None:
        raise OSError("not an ordinary file")
    spoken = language.used() if b'"labels"' in content else ""  # the picture contains text
    about = f"{__version__} {LOOK} {DRAWN} {SIZE} {theme.used()} {spoken}".encode()
    return hashlib.sha256(about + content).hexdigest()[:32]


def cached(cache_key: str, where: Path | None = None) -> bytes:
    """Return the cached picture with a key; empty if there is none."""
    try:
        png = read_ordinary((where or folder()) / f"{cache_key}.png", LARGEST) or b""
    except OSError:
        return b""
    return png if png.startswith(_BEGIN) and png.endswith(_END) else b""


def draw_all(where: Path, orders: Connection) -> Iterator[Picture]:
    """Draw levels in a process without a window, and cache the pictures in a folder.

    The latest of the `orders` is a list of levels; what is left of earlier ones is not drawn.
    """
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    pygame.font.init()
    pen = Pen()
    _forget_the_oldest(where)
    left: list[Path] = []
    while True:
        while not left or orders.poll():
            left = orders.recv()
        yield _made(left.pop(0), pen, where)


def _made(path: Path, pen: Pen, where: Path) -> Picture:
    try:
        cache_key = key(path)
        png = cached(cache_key, where) or level_picture.png(draw(path, pen))
    except OSError:
        return Picture(path, "", b"")
    except SandboxError:
        return Picture(path, cache_key, b"")
    with suppress(SandboxError, OSError):  # the picture is shown even if it cannot be cached
        where.mkdir(parents=True, exist_ok=True)
        write_atomically(where / f"{cache_key}.png", png, follow=False)
    return Picture(path, cache_key, png)


def draw(path: Path, pen: Pen) -> pygame.Surface:
    """Draw a level at a typical moment, or at the latest one reached in `PATIENCE` of computing.

    Raises `SandboxError` if the level cannot be opened.
    """
    session = Session(load(path), patient=False)
    stage, surface = Stage(pen, DRAWN, plain=True), pygame.Surface(DRAWN)
    stage.use(session.world)
    for overlay in stage.shown:
        stage.shown[overlay] = overlay == "trail"
    stage.fit()
    begun = perf_counter()
    for _ in range(ceil(session.end * level_picture.TELLING)):
        if session.waiting or session.failure or perf_counter() - begun > PATIENCE:
            break
        session.step()
        stage.note_speeds()
    stage.draw(surface, session.trail)
    return pygame.transform.smoothscale(surface, SIZE)


def _forget_the_oldest(where: Path) -> None:
    """Remove all but the latest pictures from the cache."""
    with suppress(OSError):
        found = [(entry.stat().st_mtime, entry.path) for entry in os.scandir(where)]
        for _, path in sorted(found)[:-MOST]:
            os.unlink(path)
