"""Optional packages, which only some commands need."""

from collections.abc import Iterator
from contextlib import contextmanager

from sandbox.model.errors import MisuseError


@contextmanager
def needed_for(what: str, extra: str = "report") -> Iterator[None]:
    """Import within this what something needs: if it is not installed, say how to install it.

    The message begins with `what`, and names the extra of the package that brings it. Raises
    `MisuseError` if a library is not there.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        raise MisuseError(
            "{what} needs the library {name!r}, which is not installed: python -m pip install"
            " 'mechanics-sandbox[{extra}]' (in a checkout: -e '.[{extra}]')",
            what=what,
            name=error.name,
            extra=extra,
        ) from error
