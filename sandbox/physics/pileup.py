"""Bodies that touch each other and collide: one pair after the other, and all at once.

The pair that approaches fastest collides first, which may make neighbours approach, and so on.
Bodies with e < 1 that stay together would collide for ever, ever more gently. From some point on
they no longer bounce, and what is left is solved at once: no pair may approach, and only pushes are
allowed.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.batch import Integers
from sandbox.physics.errors import EndlessImpacts

ROUNDING = 1e-12
"""An approach slower than this share of the speeds that it is the difference of is none."""

MANY = 100
"""How many impacts each contact of a pile-up may have before what is left stops bouncing. Twice as
many as 50 equal balls in a row with e = 0.9 need; those with less stay together by then."""

MOST = 300_000
"""The same for all contacts together where one is elastic: there, nothing may be left."""

TINY = 1e-300

PARALLEL = 1e-9
"""The determinant, of two points' answers to impulses, below which they are one point."""


def answers(gradient: Array, agility: Array, holds: Array | None) -> Array:
    """Return how bodies answer a unit impulse along each gradient: (k, n, 3).

    Joints included: `holds`, (m, n, 3), are the gradients of those that push as well as pull.
    """
    answer = gradient * agility
    if holds is None:
        return answer
    holds = holds.reshape(-1, agility.size)
    held = holds * agility.reshape(-1)
    flat = answer.reshape(len(answer), -1)
    return (flat - np.linalg.solve(held @ holds.T, holds @ flat.T).T @ held).reshape(answer.shape)


class Pile:
    """Contacts that may collide with each other; k of them.

    Parameters
    ----------
    answers
        (k, k), how fast each parts by a unit impulse of each [1/kg].
    parting
        (k,), how fast each parts [m/s].
    allowed
        (k,), the approach that is none [m/s].
    restitution
        (k,).
    partner
        (k,), the other point of the same two sides; −1 if there is none.
    """

    def __init__(
        self,
        answers: Array,
        parting: Array,
        allowed: Array,
        restitution: Array,
        partner: Integers,
    ) -> None:
        self._answers, self._parting, self._allowed = answers, parting.copy(), allowed
        self._restitution, self._partner = restitution, partner
        self._impulse = np.zeros(len(parting))

    def settle(self, bodies: Integers) -> Array:
        """Return the impulses after which nothing approaches: (k,) [N s]."""
        bounces = self._restitution > 0
        most = MANY * len(bounces) if bounces.any() else 0
        if (self._restitution == 1).any():
            most = MOST
        for _ in range(most):
            fastest = int((self._parting + self._allowed).argmin())
            if self._parting[fastest] >= -self._allowed[fastest]:
                return self._impulse
            self._bounce(fastest)
        fastest = int((self._parting + self._allowed).argmin())
        if most and self._restitution[fastest] == 1:
            raise EndlessImpacts(int(bodies[fastest].max()))
        self._impulse += pushes(self._answers, self._parting)
        return self._impulse

    def _bounce(self, first: int) -> None:
        """Turn round the approach of a point, and of its partner if that approaches too."""
        e, second = self._restitution[first], int(self._partner[first])
        if second >= 0 and self._parting[second] < -self._allowed[second]:
            both = np.array((first, second))
            block = self._answers[np.ix_(both, both)]
            if np.linalg.det(block) > PARALLEL * block[0, 0] * block[1, 1]:
                size = -(1 + e) * np.linalg.solve(block, self._parting[both])
                if size.min() >= 0:
                    self._impulse[both] += size
                    self._parting += size @ self._answers[both]
                    return
        push = -(1 + e) * self._parting[first] / self._answers[first, first]
        self._impulse[first] += push
        self._parting += push * self._answers[first]


def pushes(answers: Array, parting: Array) -> Array:
    """Return the smallest impulses after which nothing approaches, all at once: (k,) [N s].

    They are no numbers where the answers, or the rates, are none.

    Of all impulses that push, those that leave the least kinetic energy: impulse · (parting +
    answers · impulse / 2) is least. C. L. Lawson, R. J. Hanson: Solving Least Squares Problems,
    chapter 23.
    """
    if not (np.isfinite(answers).all() and np.isfinite(parting).all()):
        return np.full(len(parting), np.nan)  # LAPACK never comes back from an infinity
    impulse, active = np.zeros(len(parting)), np.zeros(len(parting), dtype=bool)
    close = ROUNDING * np.abs(parting).max()
    for _ in range(3 * len(parting)):
        approach = np.where(active, -np.inf, -(parting + answers @ impulse))
        worst = int(approach.argmax())
        if approach[worst] <= close:
            break
        active[worst] = True
        while True:
            now = np.flatnonzero(active)
            wanted = np.linalg.lstsq(answers[np.ix_(now, now)], -parting[now], rcond=None)[0]
            if wanted.min() > 0:
                impulse[now] = wanted
                break
            pulls = np.flatnonzero(~(wanted > 0))
            left = impulse[now][pulls]
            share = left / np.maximum(left - wanted[pulls], TINY)
            first = int(share.argmin())
            gone = share == share[first]
            gone[first] = True  # even where that is no number: one less each time, or it never ends
            impulse[now] += share[first] * (wanted - impulse[now])
            active[now[pulls[gone]]] = False
            impulse[~active] = 0.0
            if not active.any():
                break
    return impulse
