"""Keeps pydantic from looking for plug-ins of its own, of which the sandbox uses none."""

import os


def spare() -> None:
    """Let pydantic, once it is imported, look for no plug-ins, unless the user says otherwise.

    It would read what all packages declare that are installed: 50 ms at each start.
    """
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
