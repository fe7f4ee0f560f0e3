"""A run as a film: replayed, drawn frame by frame, and encoded as GIF or MP4."""

import os
from collections.abc import Iterator
from fractions import Fraction
from io import BytesIO
from math import ceil
from pathlib import Path
from typing import Literal

from sandbox.app.runs.run_file import Run
from sandbox.app.words.language import later, say
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.errors import SandboxError

Kind = Literal["gif", "mp4"]

FRAMES = 25  # per second
SIZE: dict[Kind, tuple[int, int]] = {"gif": (640, 400), "mp4": (1280, 720)}  # px
LONGEST = 60.0
"""The longest duration of a film [s]; a longer run is cut off."""
LACKING = later("an MP4 needs PyAV: install mechanics-sandbox[film]; a GIF does not")


def film(run: Run, path: Path, kind: Kind, seen_from: str | None = None) -> Iterator[float | str]:
    """Make a film of a run at the speed of its own time, and write it completely or not at all.

    It is seen from a place, see `FrameOfReference`.

    Yields
    ------
    float or str
        The progress from 0 to 1, five times per second of film; at last a sentence that says where
        the film is, or why it could not be made.
    """
    os.environ["SDL_VIDEODRIVER"] = "dummy"  # the process has no window
    os.environ["SDL_AUDIODRIVER"] = "dummy"
    try:
        if kind == "mp4":
            import av  # noqa: F401 (to report at once that it is missing)
    except ImportError:
        yield say(LACKING)
        return
    try:
        yield from _filmed(run, path, kind, seen_from)
    except (SandboxError, OSError) as error:
        yield say("no film: {error}", error=error)
        return
    yield say("saved {path}", path=path)


def _filmed(run: Run, path: Path, kind: Kind, seen_from: str | None) -> Iterator[float]:
    frames: list[bytes] = []
    for done, frame in _frames(run, SIZE[kind], seen_from):
        frames.append(frame)
        if len(frames) % (FRAMES // 5) == 0:
            yield 0.9 * done
    encoded = _gif(frames) if kind == "gif" else _mp4(frames)
    write_atomically(path, encoded)


def _frames(
    run: Run, size: tuple[int, int], seen_from: str | None
) -> Iterator[tuple[float, bytes]]:
    """Yield the progress from 0 to 1, and the picture there: rows of red, green and blue bytes."""
    import pygame

    from sandbox.app.drawing.text import Pen
    from sandbox.app.runs.run_file import session_of
    from sandbox.app.stage.stage import Stage

    pygame.font.init()
    session = session_of(run)
    stage, picture = Stage(Pen(), size), pygame.Surface(size)
    stage.use(session.world)
    stage.fit()
    stage.observe(seen_from)
    dt = session.world.dt
    last = min(run.steps, session.world.stepping.steps(LONGEST))
    for count in range(ceil(last * dt * FRAMES) + 1):
        due = min(round(count / FRAMES / dt), last)
        while session.world.steps < due and session.failure is None:
            session.step()
            stage.note_speeds()
        stage.view.flashes = session.flashes
        stage.draw(picture, session.trail, session.milestones())
        yield (due / last if last else 1.0), pygame.image.tobytes(picture, "RGB")


def _gif(frames: list[bytes]) -> bytes:
    from PIL import Image

    images = [Image.frombytes("RGB", SIZE["gif"], frame) for frame in frames]
    palette = images[len(images) // 2].quantize(128)
    first, *others = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    encoded = BytesIO()
    first.save(encoded, "GIF", save_all=True, append_images=others, duration=1000 // FRAMES, loop=0)
    return encoded.getvalue()


def _mp4(frames: list[bytes]) -> bytes:
    import av
    import numpy as np

    width, height = SIZE["mp4"]
    encoded = BytesIO()
    with av.open(encoded, "w", format="mp4") as container:
        stream = container.add_stream("libx264", rate=Fraction(FRAMES))
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        for frame in frames:
            pixels = np.frombuffer(frame, np.uint8).reshape(height, width, 3)
            container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")))
        container.mux(stream.encode())
    return encoded.getvalue()
