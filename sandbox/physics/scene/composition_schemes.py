"""Composition schemes: the drifts and kicks that make up a step of fourth to eighth order.

A scheme of higher order is a sequence of drifts and kicks of different durations, some of which go
back in time. The kick at the end of a step belongs in equal parts to that step and to the next.
pymunk's kick lasts as long as the drift before it; forces are scaled to give the impulse of the
intended duration.
"""

from collections.abc import Sequence
from itertools import accumulate, pairwise
from math import fsum
from typing import NamedTuple

from sandbox.physics.scene.substep import Substep


class Composition(NamedTuple):
    """Alternating drifts and kicks, as fractions of a step; the sum of each is 1."""

    drifts: Sequence[float]
    kicks: Sequence[float]
    """after each drift; the last is shared with the next step"""
    stability_limit: float
    """the largest stable ω h of an oscillation, at which the trace of the step's matrix leaves the
    range from −2 to 2"""


def _composed(half: Sequence[float], limit: float) -> Composition:
    """Return a symmetric composition of leapfrog steps, from the first half and the middle one.

    The duration of each kick is the mean of the drifts before and after it.
    """
    drifts = (*half, *half[-2::-1])
    around = pairwise((*drifts, drifts[0]))
    return Composition(drifts, [(a + b) / 2 for a, b in around], limit)


def _split(drifts: Sequence[float], kicks: Sequence[float], limit: float) -> Composition:
    """Return a symmetric scheme, from its first drifts and kicks; the rest follows.

    The scheme begins with its first kick, which is half of the kick at the end of a step here. As
    many kicks as drifts are given if a drift is in the middle, and else one more.
    """
    first, *inner = kicks
    if len(kicks) > len(drifts):
        half = (*drifts, 0.5 - fsum(drifts))
        drifts, inner = (*half, *half[::-1]), [*inner, 1 - 2 * fsum(kicks), *inner[::-1]]
    else:
        inner = [*inner, 0.5 - fsum(kicks)]
        drifts, inner = (*drifts, 1 - 2 * fsum(drifts), *drifts[::-1]), [*inner, *inner[::-1]]
    return Composition(drifts, (*inner, 2 * first), limit)


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

SOFRONIOU_SPALETTA = _composed(
    (
        0.21375583945878254555518066964857,
        0.18329381407425713911385974425217,
        0.17692819473098943794898811709929,
        -0.44329082681170215849622829626258,
        0.11728560432865935385403585669136,
        0.50405474843802736404832781714239,
    ),
    2.957286,
)
"""Eleven steps of leapfrog, of sixth order; M. Sofroniou and G. Spaletta, Optim. Methods Softw. 20
(2005) 597. For steps with exact joints, as Suzuki's."""

BLANES_MOAN_11 = _split(
    (
        0.123229775946271,
        0.290553797799558,
        -0.127049212625417,
        -0.246331761062075,
        0.357208872795928,
    ),
    (
        0.0414649985182624,
        0.198128671918067,
        -0.0400061921041533,
        0.0752539843015807,
        -0.0115113874206879,
    ),
    3.141431,
)
"""Eleven kicks of sixth order, SRKN11b of the same paper as `BLANES_MOAN`, and like it without
exact joints."""

KAHAN_LI = _composed(
    (
        0.13020248308889008088,
        0.56116298177510838456,
        -0.38947496264484728641,
        0.15884190655515560090,
        -0.39590389413323757734,
        0.18453964097831570709,
        0.25837438768632204729,
        0.29501172360931029887,
        -0.60550853383003451170,
    ),
    3.0964386,
)
"""Seventeen steps of leapfrog, of eighth order, with or without exact joints; W. Kahan and R.-C.
Li, Math. Comput. 66 (1997) 1089."""

_SCHEMES = {
    4: (BLANES_MOAN, SUZUKI),
    6: (BLANES_MOAN_11, SOFRONIOU_SPALETTA),
    8: (KAHAN_LI, KAHAN_LI),
}
"""The scheme of each order, without and with exact joints."""


def composition(order: int, *, is_constrained: bool) -> Composition:
    """Return the scheme of an order, with (`is_constrained`) or without exact joints."""
    return _SCHEMES[order][is_constrained]


def substeps(shares: Composition, dt: float) -> list[Substep]:
    """Return the substeps of a step [s]; the drift after the last is the first of the next step.

    >>> [round(part.drift, 3) for part in substeps(SUZUKI, 0.5)]
    [0.207, 0.207, -0.329, 0.207, 0.207]
    """
    ends = [*list(accumulate(shares.drifts))[:-1], 1]
    after = (*shares.drifts[1:], shares.drifts[0])
    rows = zip(shares.drifts, ends, shares.kicks, after, strict=True)
    return [Substep(d * dt, ahead, k * dt, f * dt) for d, ahead, k, f in rows]
