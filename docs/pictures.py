"""The pictures of the README: the window as it is now, which plays each scene by itself.

`make pictures` draws them anew.
"""

import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic, sleep

os.environ |= {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "LANGUAGE": "en"}

import pygame

from sandbox.app.files import challenge_stars, preferences, recent_files
from sandbox.app.home import picture_cache
from sandbox.app.window import Window
from sandbox.editing import draft_recovery

FOLDER = Path(__file__).parent / "images"
SIZE = 1280, 800  # px
FRAME = 1 / 60  # s
PATIENCE = 300.0
"""s that a picture may take to come about."""

ATWOOD = {
    "format": 1,
    "title": "New level",
    "effects": {"gravity": {"acceleration": [0, -9.81]}},
    "bodies": {
        "box1": {"shape": {"type": "box", "width": 1, "height": 1}, "mass": 1, "position": [-2, 2]},
        "box2": {"shape": {"type": "box", "width": 1, "height": 1}, "mass": 2, "position": [2, 2]},
    },
    "joints": {
        "pulley1": {"type": "pulley", "ends": ["box1", "box2"], "over": [[-2, 6], [2, 6]]},
    },
    "view": {"center": [0, 3.5], "width": 16},
}


def play(window: Window, level: str, page: str, until: float) -> None:
    """Play a level up to a time [s] with a page open."""
    window.open_level(level)
    window.do(page)
    session = window.session
    assert session is not None
    session.toggle()
    _show(window, lambda: session.world.t >= until)
    if session.playing:
        session.toggle()
    _settle(window)


def projectile(window: Window) -> None:
    """Draw a throw, its checks and its ghost."""
    play(window, "kinematics/projectile", "level page", 2.2)


def forces(window: Window) -> None:
    """Draw the forces on a block that slides."""
    play(window, "newton/incline-with-friction", "forces page", 0.8)


def build(window: Window) -> None:
    """Draw an Atwood machine that the editor recognises."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "new-level.json"
        path.write_text(json.dumps(ATWOOD), encoding="utf-8")
        window.open_level(str(path))
        window.do("build page")
        _settle(window)


def challenge(window: Window) -> None:
    """Draw a challenge that has been met with three stars."""
    window.open_level("challenges/into-the-bucket")
    session = window.session
    assert session
    assert session.level.challenge
    session.restart(dict(session.level.challenge.solution))
    session.toggle()
    _show(window, lambda: session.world.t >= session.duration)
    _settle(window)


def double_pendulum(window: Window) -> None:
    """Draw a double pendulum and what its rods keep."""
    play(window, "lagrange/double-pendulum", "level page", 2.5)


def accuracy(window: Window) -> None:
    """Draw what another digit costs on an orbit."""
    play(window, "energy/kepler-ellipse", "level page", 2.2)
    window.do("accuracy page")  # which begins to measure by itself
    _show(window, lambda: window.workers.running)
    _show(window, lambda: not window.workers.running)
    _settle(window)


def _show(window: Window, done: Callable[[], bool]) -> None:
    """Show frames, at the pace of a screen, until something is so."""
    begun = monotonic()
    while not done():
        if monotonic() > begun + PATIENCE:
            raise TimeoutError
        window.frame(FRAME)
        sleep(FRAME)


def _settle(window: Window) -> None:
    """Show as many frames as what follows the run may need."""
    for _ in range(30):
        window.frame(FRAME)


SCENES = {
    "projectile": projectile,
    "forces": forces,
    "build": build,
    "challenge": challenge,
    "double-pendulum": double_pendulum,
    "accuracy": accuracy,
}


def drawn(names: Sequence[str]) -> Iterator[tuple[str, pygame.Surface]]:
    """Yield each picture with its name, from a window of its own that nobody has used before."""
    for name in names:
        window = Window(SIZE)
        SCENES[name](window)
        yield name, window.surface
        window.close()


def main(names: Sequence[str]) -> None:
    """Write pictures, all without names, with nobody's settings, stars or drafts."""
    with TemporaryDirectory() as folder:
        own = Path(folder)
        preferences.file = lambda: own / "settings.json"
        challenge_stars.file = lambda: own / "stars.json"
        recent_files.file = lambda: own / "recent.json"
        draft_recovery.folder = lambda: own / "drafts"
        picture_cache.folder = lambda: own / "pictures"
        for name, surface in drawn(names or tuple(SCENES)):
            pygame.image.save(surface, FOLDER / f"{name}.png")


if __name__ == "__main__":
    main(sys.argv[1:])
