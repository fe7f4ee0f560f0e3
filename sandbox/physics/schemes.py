"""The substeps of which a step is made.

pymunk's step is a drift and a kick. A scheme of higher order is a composition of several of
different lengths, some of which go back in time. A kick stands between two drifts and belongs in
equal parts to both, so it lasts as long as half of each: its force is scaled by the mean of the two
drifts over the one before it, with which pymunk takes the step.
"""

from collections.abc import Sequence
from itertools import accumulate, chain, pairwise
from typing import NamedTuple

from sandbox.model.level import Level, Scheme
from sandbox.model.schemes import unsmooth
from sandbox.physics.errors import SchemeError

YOSHIDA = 1 / (2 - 2 ** (1 / 3))
"""The share of the outer substeps of fourth order; H. Yoshida, Phys. Lett. A 150 (1990) 262."""

_SHARES: dict[Scheme, Sequence[float]] = {"yoshida": (YOSHIDA, 1 - 2 * YOSHIDA, YOSHIDA)}
"""The drifts of a step, which add up to 1."""


REACH: dict[Scheme, float] = {"yoshida": 1.5732944}
"""The largest ω h at which an oscillation stays what it is, of 2 for the others: there the trace of
the step's matrix leaves −2 to 2."""


class Substep(NamedTuple):
    """A drift and the kick after it."""

    drift: float
    """s, backwards if negative"""
    ahead: float
    """how much of the step the drift brings to an end"""
    scale: float
    """what forces are multiplied by in the kick"""


def require(level: Level, scheme: Scheme) -> None:
    """Refuse a scheme that is not for a level.

    Raises
    ------
    SchemeError
        If it is not.
    """
    if scheme == "yoshida" and (rule := unsmooth(level)):
        raise SchemeError(rule)


def substeps(scheme: Scheme, dt: float) -> list[Substep]:
    """Return what a step of a scheme is made of [s]; the last is followed by the next one's first.

    >>> substeps("leapfrog", 0.5)
    [Substep(drift=0.5, ahead=1, scale=1.0)]
    """
    shares = _SHARES.get(scheme, (1.0,))
    places = [*list(accumulate(shares))[:-1], 1]
    between = pairwise(chain(shares, shares[:1]))
    return [
        Substep(share * dt, ahead, (share + after) / (2 * share))
        for ahead, (share, after) in zip(places, between, strict=True)
    ]
