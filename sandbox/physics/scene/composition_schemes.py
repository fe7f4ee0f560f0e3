"""Composition schemes: the drifts and kicks that make up a fourth-order step.

A scheme of higher order is a sequence of drifts and kicks of different durations, some of which go
back in time. The kick at the end of a step belongs in equal parts to that step and to the next.
pymunk's kick lasts as long as the drift before it; forces are scaled to give the impulse of the
intended duration.
"""

from collections.abc import Sequence
from itertools import accumulate, pairwise
from math import fsum
from typing import NamedTuple

from sandbox.physics.scene.drift_and_kick import Substep


class Composition(NamedTuple):
    """Alternating drifts and kicks, as fractions of a step; the sum of each is 1."""

    drifts: Sequence[float]
    kicks: Sequence[float]
    """after each drift; the last is shared with the next step"""
    reach: float
    """the largest stable ω h of an oscillation, at which the trace of the step's matrix leaves the
    range from −2 to 2"""


def _composed(half: Sequence[float], reach: float) -> Composition:
    """Return a symmetric composition of leapfrog steps, from the first half and the middle one.

    The duration of each kick is the mean of the drifts before and after it.
    """
    drifts = (*half, *half[-2::-1])
    around = pairwise((*drifts, drifts[0]))
    return Composition(drifts, [(a + b) / 2 for a, b in around], reach)


def _split(drifts: Sequence[float], kicks: Sequence[float], reach: float) -> Composition:
    """Return a symmetric scheme, from its first drifts and kicks; the rest follows.

    The scheme begins with its first kick, which is half of the kick at the end of a step here.
    """
    first, *inner = kicks
    middle = 1 - 2 * fsum(kicks)
    half = (*drifts, 0.5 - fsum(drifts))
    return Composition((*half, *half[::-1]), (*inner, middle, *inner[::-1], 2 * first), reach)


_FIFTH = 1 / (4 - 4 ** (1 / 3))

SUZUKI = _composed((_FIFTH, _FIFTH, 1 - 4 * _FIFTH), 2.7209745)
"""Five steps of leapfrog, the middle one back in time; M. Suzuki, Phys. Lett. A 146 (1990) 319.

It composes any symmetric step of second order, so also steps with exact joints.
"""

BLANES_MOAN = _split(
    (0.245298957184271, 0.604872665711080),
    (0.0829844064174052, 0.396309801498368, -0.0390563049223486),
    3.1634650,
)
"""Six kicks, SRKN6b of S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313.

At the same cost its error is at most a thirtieth of Suzuki's. It is for x'' = f(x, t): its drifts
must be exact, and those of bodies with exact joints are not.
"""


def fourth_order(*, held: bool) -> Composition:
    """Return the scheme of fourth order, with (`held`) or without exact joints."""
    return SUZUKI if held else BLANES_MOAN


def substeps(shares: Composition, dt: float) -> list[Substep]:
    """Return the substeps of a step [s]; the drift after the last is the first of the next step.

    >>> [round(part.drift, 3) for part in substeps(SUZUKI, 0.5)]
    [0.207, 0.207, -0.329, 0.207, 0.207]
    """
    places = [*list(accumulate(shares.drifts))[:-1], 1]
    after = (*shares.drifts[1:], shares.drifts[0])
    rows = zip(shares.drifts, places, shares.kicks, after, strict=True)
    return [Substep(d * dt, ahead, k * dt, f * dt) for d, ahead, k, f in rows]
