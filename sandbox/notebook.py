"""Levels and traces that display themselves in a notebook.

A level is shown as a picture of its run, a trace as a table. `animation` makes a film of a trace.
`from sandbox import load` is enough for that; after `import sandbox.api`, `%load_ext
sandbox.notebook` does the same.
"""

import os
from base64 import b64encode
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.quantities import column_heading
from sandbox.physics.measuring.recording import Trace

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell


class Animation:
    """A film that a notebook shows."""

    def __init__(self, gif: bytes) -> None:
        self.gif = gif

    def _repr_html_(self) -> str:
        """Show it."""
        return f'<img src="data:image/gif;base64,{b64encode(self.gif).decode()}">'


def picture(level: Level, at: float | None = None) -> bytes:
    """Return a PNG of a level's run at a time [s], with its checks; a telling moment if left out.

    Raises `SandboxError` if the run has to stop before that time.
    """
    _draw_without_window()
    from sandbox.app.level_picture import png, render

    return png(render(level, level.defaults, at))


def animation(trace: Trace) -> Animation:
    """Return a film of the run that a trace was recorded of, in its own time.

    The run is taken again, from the level, its parameters and its setting. Raises `SandboxError` if
    it cannot be: PyAV and Pillow make the film, which the extra `film` brings.
    """
    _draw_without_window()
    from sandbox.app.film import film
    from sandbox.app.runs.run_file import run_of
    from sandbox.app.runs.session import Session

    level = trace.level.model_copy(update={"stepping": trace.stepping})
    session = Session(level, trace.values)
    whole = run_of(session).model_copy(update={"steps": len(trace.t) - 1})
    with TemporaryDirectory() as folder:
        path = Path(folder) / "run.gif"
        *_, outcome = film(whole, path, "gif")
        if not path.exists():
            raise SandboxError("{outcome}", outcome=outcome)
        return Animation(path.read_bytes())


def _draw_without_window() -> None:
    os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")


def load_ipython_extension(shell: "InteractiveShell") -> None:
    """Let IPython show levels and traces."""
    assert shell.display_formatter is not None
    formatters = shell.display_formatter.formatters
    formatters["image/png"].for_type(Level, picture)
    formatters["text/html"].for_type(Trace, _table)


def _table(trace: Trace) -> str:
    """Return a trace as a table in HTML: its first and last rows."""
    title = f"<b>{escape(trace.level.title)}</b>: {len(trace.t):,} instants"
    frame = trace.to_pandas()
    frame.columns = [column_heading(name, trace.units[name]) for name in frame.columns]
    return f"{title}{frame.to_html(max_rows=10)}"
