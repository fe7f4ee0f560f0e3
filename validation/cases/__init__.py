"""The cases, one phenomenon a file. A new file joins by being there."""

from collections.abc import Iterator
from importlib import import_module
from pkgutil import iter_modules

from sandbox.model import catalog
from validation.case import Case


def phenomena() -> list[tuple[Case, ...]]:
    """Return the cases of each file, in the order of the levels.

    Raises
    ------
    AttributeError
        If a file of this folder has no function `cases`.
    """
    place = {level: i for i, level in enumerate(catalog.names())}
    modules = (import_module(f"{__name__}.{found.name}") for found in iter_modules(__path__))
    found = [tuple(module.cases()) for module in modules]
    return sorted(found, key=lambda cases: min(place.get(c.level, len(place)) for c in cases))


def all_cases() -> Iterator[Case]:
    """Yield every case of every phenomenon."""
    for cases in phenomena():
        yield from cases
