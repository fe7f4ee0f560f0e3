"""The schemes of integration that suit a level."""

from collections.abc import Iterator
from typing import get_args

from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.scheme_requirements import unsmooth
from sandbox.physics.forces.declared_laws import any_law
from sandbox.physics.state.simulation_errors import SchemeError


def require(level: Level, scheme: Scheme) -> None:
    """Raise `SchemeError` if a scheme does not suit a level."""
    if Stepping(scheme=scheme).is_composed and (rule := unsmooth(level)):
        raise SchemeError(rule)


def usable(level: Level) -> Iterator[Scheme]:
    """Yield the schemes that suit a level and differ from each other there.

    Explicit Euler differs from leapfrog only by where force laws are evaluated.
    """
    for scheme in get_args(Scheme):
        if Stepping(scheme=scheme).is_composed and unsmooth(level):
            continue
        if scheme == "explicit-euler" and not any_law(level):
            continue
        yield scheme
