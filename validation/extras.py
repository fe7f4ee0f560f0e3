"""What only some commands need, and not every installation has."""

from collections.abc import Iterator
from contextlib import contextmanager

from sandbox.model.errors import SandboxError


@contextmanager
def needed_for(what: str) -> Iterator[None]:
    """Import within this what something needs: if it is not installed, say how to install it.

    Raises
    ------
    SandboxError
        If a library is not there.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        raise SandboxError(
            f"{what} needs the library {error.name!r}, which is not installed:"
            " python -m pip install 'mechanics-sandbox[report]' (in a checkout: -e '.[report]')"
        ) from error
