"""Which schemes of integration a level may have."""

from collections.abc import Iterator
from typing import get_args

from sandbox.model.level import Level, Scheme
from sandbox.model.schemes import unsmooth
from sandbox.physics.forces.declared_laws import any_law
from sandbox.physics.state.errors import SchemeError


def require(level: Level, scheme: Scheme) -> None:
    """Refuse a scheme that is not for a level.

    Raises
    ------
    SchemeError
        If it is not.
    """
    if scheme == "fourth-order" and (rule := unsmooth(level)):
        raise SchemeError(rule)


def usable(level: Level) -> Iterator[Scheme]:
    """Yield the schemes that are for a level and differ there.

    Without a force law there is nothing that explicit Euler takes at another place.
    """
    for scheme in get_args(Scheme):
        if scheme == "fourth-order" and unsmooth(level):
            continue
        if scheme == "explicit-euler" and not any_law(level):
            continue
        yield scheme
