"""Impacts within a pile: the fastest pair first, and the remaining approaches all at once.

The pair that approaches fastest collides first, which may make neighbours approach, and so on.
Pairs that approach equally fast collide at once, to preserve symmetry. Bodies with e < 1 that stay
together would collide for ever, ever more gently. From some point on they no longer bounce, and the
remaining approaches are solved at once: afterwards no pair approaches, and all impulses are
repulsive.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.impacts.endless_impacts_error import EndlessImpacts
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.state.cancellation_points import cancellation_point

ROUNDING = 1e-12
"""An approach counts as zero if it is slower than this share of the speeds of the two bodies."""

EQUAL = 1e-9
"""The relative difference of approach velocities that count as equal: those of mirror images differ
by rounding."""

MANY = 100
"""After this many impacts per contact, the remaining approaches of a pile-up may stop bouncing. It
is twice as many as 50 equal balls in a row with e = 0.9 need; with a smaller e they stay together
by then."""

GENTLE = 0.01
"""They only stop if n impacts per contact leave less than this share of an approach velocity, e to
the power n: with e = 0.99 that takes 459."""

MOST = 100_000
"""The most impacts of all contacts together, which take 0.4 s; elastic bodies must be done by then.
A ball between a wall and an approaching ball of 1e9 times its mass has as many."""

SEVERAL = 10
"""The cost of simultaneous impacts with shared bodies, in single impacts."""

CROWD = 500
"""With this many contacts an impact takes twice as long, and the limit is halved."""

PRESSED = 1e-6
"""Bodies are wedged in if no repulsive impulses can reduce their approach below this share."""

LOST = 8
"""The rounding error of a sum of impulses, in units in the last place of its terms: a light body
between two heavy ones feels only the difference of their impulses."""

WEDGED = Message(
    "elastic bodies are wedged in and would collide for ever, since what presses them together"
    " does not yield; reduce their 'restitution' below 1, or give them room",
)

LARGE = 100
"""Above this number of contacts, singular values take more than ten times as long as Cholesky's
factors: 18 ms for 400 contacts."""

INDEPENDENT = 1e-4
"""Contacts are clearly independent if the ratio of the smallest to the largest of these factors is
above this."""

TINY = 1e-300


class Pile:
    """A pile of k contacts, whose impacts affect each other.

    `delassus`, (k, k), is the separation rate of each contact by a unit impulse on each [1/kg].
    `parting`, (k,), are the separation rates, `allowed`, (k,), is the approach velocity that counts
    as zero [m/s], and `restitution`, (k,), are the coefficients of restitution. `partner`, (k,), is
    the other contact point of the same two sides; −1 if there is none. `impact_groups` has the
    contacts of each impact, in order.
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
        self.impact_groups: list[Integers] = []

    def settle(self, bodies: Integers) -> Array:
        """Return the impulses after which no contact approaches: (k,) [N s].

        Raises `EndlessImpacts` if elastic bodies are wedged in, or collide more often than can be
        followed.
        """
        count = len(bodies)
        if not self._restitution.any():
            return self._rest()
        most, until = MOST * CROWD // (CROWD + count), MANY * count
        impacts, work, liveliest = 0, 0, 0.0  # the largest e since the last check
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
        """Return whether to stop bouncing after `had` impacts per contact, as gentle or endless."""
        if had < 2 * MANY and self._wedged():  # once is enough
            if liveliest == 1:
                raise EndlessImpacts(self._blamed(bodies), WEDGED)
            return True
        return bool(liveliest**had < GENTLE)

    def _blamed(self, bodies: Integers) -> int:
        """Return a body of the fastest approach, for the error."""
        return int(bodies[(self._parting + self._allowed).argmin()].max())

    def _rest(self) -> Array:
        """Stop all remaining approaches without a bounce; return the impulses: (k,) [N s]."""
        rest = pushes(self._delassus, self._parting)
        self._impulse += rest
        self.impact_groups.append(np.flatnonzero(rest))
        return self._impulse

    def _wedged(self) -> bool:
        """Return whether some contacts approach for all repulsive impulses, beyond rounding."""
        push = pushes(self._delassus, self._parting)
        left = self._parting + self._delassus @ push
        rounding = LOST * np.finfo(float).eps * (np.abs(self._delassus) @ push)
        return bool((left + rounding).min() < PRESSED * self._parting.min())

    def _bounce(self) -> tuple[int, float]:
        """Reverse the fastest approach, and equally fast ones with the same e.

        Return their number, 0 if nothing approaches, and their e.
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
            self.impact_groups.append(np.flatnonzero(equal))
            return 1, e
        group = self._with_partners(np.flatnonzero(equal & (self._restitution == e)))
        delassus = self._delassus[group]
        sizes = _at_once(delassus[:, group], (1 + e) * self._parting[group])
        self._impulse[group] += sizes
        self._parting += sizes @ delassus
        self.impact_groups.append(group)
        return len(group), e

    def _with_partners(self, group: Integers) -> Integers:
        """Add the other contact points of the same sides, if they approach."""
        beside = self._partner[group]
        beside = beside[beside >= 0]
        beside = beside[self._parting[beside] < -self._allowed[beside]]
        return np.union1d(group, beside) if len(beside) else group


def _work(count: int) -> int:
    """Return the cost of simultaneous impacts, in single impacts."""
    return SEVERAL + count**3 // 1000


def _at_once(delassus: Array, parting: Array) -> Array:
    """Return repulsive impulses after which no contact approaches: (k,) [N s].

    Contacts do not separate either, unless that would need attractive impulses.
    """
    if np.count_nonzero(delassus) == len(parting):  # they are independent
        return np.asarray(-parting / delassus.diagonal())
    if np.isfinite(delassus).all() and np.isfinite(parting).all():
        sizes: Array = np.asarray(np.linalg.lstsq(delassus, -parting, rcond=None)[0], np.float64)
        left = np.abs(parting + delassus @ sizes).max()
        if sizes.min() >= 0 and left <= ROUNDING * np.abs(parting).max():
            return sizes
    return pushes(delassus, parting)


def pushes(delassus: Array, parting: Array) -> Array:
    """Return the smallest impulses after which no contact approaches, all at once: (k,) [N s].

    They are NaN if the matrix or the rates are not finite.

    Of all repulsive impulses they leave the least kinetic energy: they minimise impulse · (parting
    + delassus · impulse / 2). An active-set method for non-negative least squares: C. L. Lawson,
    R. J. Hanson: Solving Least Squares Problems, chapter 23.
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
            wanted = _smallest(delassus[np.ix_(now, now)], -parting[now])
            if wanted.min() > 0:
                impulse[now] = wanted
                break
            pulls = np.flatnonzero(~(wanted > 0))
            left = impulse[now][pulls]
            share = left / np.maximum(left - wanted[pulls], TINY)
            first = int(share.argmin())
            released = share == share[first]
            released[first] = True  # even if NaN: one less each time, to terminate
            impulse[now] += share[first] * (wanted - impulse[now])
            active[now[pulls[released]]] = False
            impulse[~active] = 0.0
            if not active.any():
                break
    return impulse


def _smallest(delassus: Array, rates: Array) -> Array:
    """Return the impulses that give some rates, the smallest if there are many: (k,) [N s]."""
    if len(rates) > LARGE:
        from scipy.linalg.lapack import dpotrf, dpotrs  # a tenth of a second, for those who need it

        factor, wrong = dpotrf(delassus, lower=True)
        size = factor.diagonal()
        if not wrong and size.min() > INDEPENDENT * size.max():
            return np.asarray(dpotrs(factor, rates, lower=True)[0])
    return np.asarray(np.linalg.lstsq(delassus, rates, rcond=None)[0])
