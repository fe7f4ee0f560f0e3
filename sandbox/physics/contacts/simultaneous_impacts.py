"""Impacts within a pile: the fastest pair first, and what is left all at once.

The pair that approaches fastest collides first, which may make neighbours approach, and so on.
Pairs that approach equally fast collide at once, so that what was symmetric stays so. Bodies with
e < 1 that stay together would collide for ever, ever more gently. From some point on they no longer
bounce, and what is left is solved at once: no pair may approach, and only pushes are allowed.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.message import Message
from sandbox.physics.contacts.endless_impacts import EndlessImpacts
from sandbox.physics.engine.batch import Integers
from sandbox.physics.state.cancellation import cancellation_point

ROUNDING = 1e-12
"""An approach slower than this share of the speeds that it is the difference of is none."""

EQUAL = 1e-9
"""The share of an approach by which another may be slower and count as equally fast: mirror images
differ by what was rounded on the way."""

MANY = 100
"""How many impacts each contact of a pile-up may have before what is left stops bouncing. Twice as
many as 50 equal balls in a row with e = 0.9 need; those with less stay together by then."""

GENTLE = 0.01
"""The share of its approach that many impacts must leave of each for that, e to their number: balls
with e = 0.99 have 459."""

MOST = 100_000
"""How many impacts all contacts together may have; where elastic ones go on, nothing may be left. A
ball between a wall and another that comes has as many if that is 1e9 times as heavy. They take 0.4
s."""

SEVERAL = 10
"""As many count where several collide at once and share bodies: that takes so much longer."""

CROWD = 500
"""With so many contacts an impact takes twice as long, and only half as many may be."""

PRESSED = 1e-6
"""Bodies are wedged in if so much of their approach is left by whatever may push them apart."""

LOST = 8
"""How many units in the last place of all that is added up may be lost: a light body between two
heavy ones feels but the difference of what they push with."""

WEDGED = Message(
    "elastic bodies are wedged in, and would collide for ever: what presses them together does"
    " not give way; let their 'restitution' be less than 1, or leave them room",
)

TINY = 1e-300


def responses(jacobian: Array, inverse_mass: Array, holds: Array | None) -> Array:
    """Return how bodies respond to a unit impulse along each row of the Jacobian: (k, n, 3).

    Joints included: `holds`, (m, n, 3), are the Jacobian of those that push as well as pull.
    """
    response = jacobian * inverse_mass
    if holds is None:
        return response
    holds = holds.reshape(-1, inverse_mass.size)
    held = holds * inverse_mass.reshape(-1)
    flat = response.reshape(len(response), -1)
    return (flat - np.linalg.solve(held @ holds.T, holds @ flat.T).T @ held).reshape(response.shape)


class Pile:
    """Contacts that may collide with each other; k of them.

    Parameters
    ----------
    delassus
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
        delassus: Array,
        parting: Array,
        allowed: Array,
        restitution: Array,
        partner: Integers,
    ) -> None:
        self._delassus, self._parting, self._allowed = delassus, parting.copy(), allowed
        self._restitution, self._partner = restitution, partner
        self._impulse = np.zeros(len(parting))

    def settle(self, bodies: Integers) -> Array:
        """Return the impulses after which nothing approaches: (k,) [N s].

        Raises
        ------
        EndlessImpacts
            If elastic bodies are wedged in, or collide more often than can be followed.
        """
        count = len(bodies)
        if not self._restitution.any():
            return self._rest()
        most, until = MOST * CROWD // (CROWD + count), MANY * count
        impacts, work, liveliest = 0, 0, 0.0  # the largest e since it was looked at last
        while work < most:
            cancellation_point()
            equal, e = self._bounce()
            if not equal:
                return self._impulse
            impacts, work = impacts + equal, work + (1 if equal == 1 else _work(equal))
            liveliest = max(liveliest, e)
            if impacts >= until:
                if self._ends(bodies, impacts / count, liveliest):
                    return self._rest()
                until, liveliest = impacts + MANY * count, 0.0
        if liveliest == 1:
            raise EndlessImpacts(self._blamed(bodies))
        return self._rest()

    def _ends(self, bodies: Integers, had: float, liveliest: float) -> bool:
        """Whether nothing is left of a bounce after so many impacts a contact, or ever will be."""
        if had < 2 * MANY and self._wedged():  # once is enough
            if liveliest == 1:
                raise EndlessImpacts(self._blamed(bodies), WEDGED)
            return True
        return bool(liveliest**had < GENTLE)

    def _blamed(self, bodies: Integers) -> int:
        """Return a body of those that approach fastest."""
        return int(bodies[(self._parting + self._allowed).argmin()].max())

    def _rest(self) -> Array:
        """Let what is left stop bouncing, and return the impulses: (k,) [N s]."""
        self._impulse += pushes(self._delassus, self._parting)
        return self._impulse

    def _wedged(self) -> bool:
        """Whether some would approach whatever pushed them apart, by more than rounding."""
        push = pushes(self._delassus, self._parting)
        left = self._parting + self._delassus @ push
        rounding = LOST * np.finfo(float).eps * (np.abs(self._delassus) @ push)
        return bool((left + rounding).min() < PRESSED * self._parting.min())

    def _bounce(self) -> tuple[int, float]:
        """Turn round the fastest approach, and those with the same e that are equally fast.

        Returns how many those are, 0 if nothing approaches, and their e.
        """
        approach = self._parting + self._allowed
        first = approach.argmin()
        fastest, e = approach[first], float(self._restitution[first])
        if fastest >= 0:
            return 0, e
        equal = approach <= (1 - EQUAL) * fastest
        if np.count_nonzero(equal) == 1 and self._partner[first] < 0:
            push = -(1 + e) * self._parting[first] / self._delassus[first, first]
            self._impulse[first] += push
            self._parting += push * self._delassus[first]
            return 1, e
        group = self._with_partners(np.flatnonzero(equal & (self._restitution == e)))
        delassus = self._delassus[group]
        sizes = _at_once(delassus[:, group], (1 + e) * self._parting[group])
        self._impulse[group] += sizes
        self._parting += sizes @ delassus
        return len(group), e

    def _with_partners(self, group: Integers) -> Integers:
        """Add the other points of the same sides, as far as they approach."""
        beside = self._partner[group]
        beside = beside[beside >= 0]
        beside = beside[self._parting[beside] < -self._allowed[beside]]
        return np.union1d(group, beside) if len(beside) else group


def _work(count: int) -> int:
    """Return how many impacts one by one take as long as some at once."""
    return SEVERAL + count**3 // 1000


def _at_once(delassus: Array, parting: Array) -> Array:
    """Return impulses that push and let nothing approach: (k,) [N s].

    After them nothing parts either, unless some would have to pull for that.
    """
    if np.count_nonzero(delassus) == len(parting):  # they do not reach each other
        return np.asarray(-parting / delassus.diagonal())
    if np.isfinite(delassus).all() and np.isfinite(parting).all():
        sizes: Array = np.asarray(np.linalg.lstsq(delassus, -parting, rcond=None)[0], np.float64)
        left = np.abs(parting + delassus @ sizes).max()
        if sizes.min() >= 0 and left <= ROUNDING * np.abs(parting).max():
            return sizes
    return pushes(delassus, parting)


def pushes(delassus: Array, parting: Array) -> Array:
    """Return the smallest impulses after which nothing approaches, all at once: (k,) [N s].

    They are no numbers where the matrix, or the rates, are none.

    Of all impulses that push, those that leave the least kinetic energy: impulse · (parting +
    delassus · impulse / 2) is least. C. L. Lawson, R. J. Hanson: Solving Least Squares Problems,
    chapter 23.
    """
    if not (np.isfinite(delassus).all() and np.isfinite(parting).all()):
        return np.full(len(parting), np.nan)  # LAPACK never comes back from an infinity
    impulse, active = np.zeros(len(parting)), np.zeros(len(parting), dtype=bool)
    close = ROUNDING * np.abs(parting).max()
    for _ in range(3 * len(parting)):
        approach = np.where(active, -np.inf, -(parting + delassus @ impulse))
        worst = int(approach.argmax())
        if approach[worst] <= close:
            break
        active[worst] = True
        while True:
            now = np.flatnonzero(active)
            wanted = np.linalg.lstsq(delassus[np.ix_(now, now)], -parting[now], rcond=None)[0]
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
