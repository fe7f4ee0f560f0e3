"""A 2D sandbox for classical mechanics, on pymunk, held against its closed forms.

What programs and notebooks need stands here, and is imported when it is asked for: `load`, `make`,
`build`, `simulate`, `grade`. `sandbox.api` says what each does.
"""

import sys
from typing import TYPE_CHECKING, Any

from sandbox.version import __version__ as __version__

if TYPE_CHECKING:
    from sandbox.api import build as build
    from sandbox.api import grade as grade
    from sandbox.api import load as load
    from sandbox.api import make as make
    from sandbox.api import simulate as simulate

__all__ = ("__version__", "build", "grade", "load", "make", "simulate")


def __getattr__(name: str) -> Any:  # noqa: ANN401 (as different as what is asked for)
    """Import what is asked for: the commands start up sooner without it."""
    if name not in __all__:
        raise AttributeError(f"module 'sandbox' has no attribute '{name}'")
    from sandbox import api

    _show_in_notebooks()
    return getattr(api, name)


def _show_in_notebooks() -> None:
    """Let levels and traces show themselves if this runs in IPython."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is not None:
        from sandbox.notebook import load_ipython_extension

        load_ipython_extension(shell)


def __dir__() -> list[str]:
    """Return what can be asked for, so that an editor or a notebook can complete it."""
    return sorted({*globals(), *__all__})
