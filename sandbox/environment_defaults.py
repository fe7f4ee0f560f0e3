"""Defaults of environment variables that libraries read when they are imported."""

import os

_DEFAULTS = {
    # A step solves systems of a few equations. Beside other processes the threads of OpenBLAS
    # wait for each other: a chain of 40 links then takes seven times as long.
    "OPENBLAS_NUM_THREADS": "1",
    # pydantic would read what every installed package declares, to look for plug-ins: 50 ms at
    # each start, and the sandbox uses none.
    "PYDANTIC_DISABLE_PLUGINS": "__all__",
}


def install() -> None:
    """Set the variables that the user has not set."""
    for name, value in _DEFAULTS.items():
        os.environ.setdefault(name, value)
