"""Impacts located in time: those of fast bodies, and those whose time matters.

pymunk looks for contacts once a step. A bullet is then already behind the wall, and a ball bounces
up to a step late. Here the drift of a step is cut at every impact of the bodies that a level names:
between two kicks leapfrog stands for a motion with the acceleration of the last kick, so bodies
move along parabolas until two outlines touch, an impulse along the normal turns their approach into
e times as fast a parting (Newton's law of restitution; friction takes what Coulomb's law allows),
and they go on along new parabolas for the rest of the step. pymunk is handed what comes of it: the
places at the end of the drift, and the velocities half a kick before.

Bounces that would be over within half a step are none: the bodies rest on each other, and are
pymunk's from the next kick on.
"""

from cmath import rect
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.joints import bodies_of
from sandbox.model.level import Level
from sandbox.physics.batch import NO_CONTACTS, Booleans, Contacts
from sandbox.physics.build import Scene, pair_coefficients
from sandbox.physics.errors import EndlessImpacts
from sandbox.physics.impacts import impacts
from sandbox.physics.outline import Outline, outlines
from sandbox.physics.sequence import answers
from sandbox.physics.sweep import Hit, Path, meet

SWEEPS = 200
"""How often the impulses at the points of an impact are gone through."""

STILL = 1e-15
"""The share of the impulses by which they may still change."""

MOST = 10_000
"""How many impacts a step may have."""


class Impact(NamedTuple):
    """One impact of two bodies.

    Attributes
    ----------
    bodies
        Their indices.
    time
        Since the step before [s].
    normal
        The unit vector from the first to the second.
    points
        Where they touched [m].
    impulse
        What the second got; the first got the opposite [N s].
    told
        The work of a body that nothing moves, but that moves as told [J].
    rubbed
        The work of friction [J].
    given
        The momentum, and the angular momentum, that bodies which nothing moves have given
        [kg m/s, kg m²/s].
    """

    bodies: tuple[int, int]
    time: float
    normal: complex
    points: tuple[complex, ...]
    impulse: complex
    told: float
    rubbed: float
    given: Array


class Coefficients(NamedTuple):
    """Of the pairs of n bodies: (n, n) each."""

    restitution: Array
    friction: Array


class Located:
    """Cuts the drift of a step at the impacts of named bodies; n bodies.

    Parameters
    ----------
    outlines
        The shapes of all bodies.
    swept
        (n,), which bodies' impacts are located.
    coefficients
        Of the pairs.
    scene
        Their masses, and the joints that hold together what collides; see `Sequence`.
    held
        (n,), which bodies hang on joints of any kind.
    dt
        The time step [s].

    Attributes
    ----------
    impacts
        Those of the last drift.
    begun
        (n, 3), the velocities that the last kick began with [m/s, rad/s].
    """

    def __init__(
        self,
        outlines: Sequence[Outline],
        swept: Booleans,
        coefficients: Coefficients,
        scene: Scene,
        held: Booleans,
        dt: float,
    ) -> None:
        self._batch, self._outlines, self._dt = scene.batch, outlines, dt
        self._coefficients, self._held = coefficients, held
        self._mass, self._agility = scene.mass, scene.agility
        self._joints, self._solids = scene.joints.together, scene.joints.solids
        self._row = np.array([o.body for o in outlines])
        a, b = np.triu_indices(len(outlines), 1)
        i, j = self._row[a], self._row[b]
        group = np.array([o.group for o in outlines])
        wanted = (swept[i] | swept[j]) & (i != j) & ((group[a] != group[b]) | (group[a] == 0))
        self._pairs = np.stack((a[wanted], b[wanted]), axis=1)
        state = self._batch.state()
        self._low, self._high = self._boxes(state)
        self._first: Array | None = None
        self.begun = state[:, 3:]
        self.impacts: list[Impact] = []

    def begin(self, acceleration: Array) -> None:
        """Take up a motion whose first kick had these accelerations: (n, 3)."""
        self._first, self.impacts = acceleration, []

    def cut(self, smooth: Array, struck: Array | float) -> Array | None:
        """Let what would touch in the coming drift collide; return how stored velocities jump.

        Parameters
        ----------
        smooth
            (n, 3), the accelerations by gravity and force laws in the last kick.
        struck
            (n, 3), how velocities jumped in the last kick by impacts in sequence.

        Raises
        ------
        EndlessImpacts
            If bodies collide more often than can be followed.
        """
        state = self._batch.state()
        place, drifts = state[:, :3], state[:, 3:].copy()
        total = (drifts - self.begun - struck) / self._dt if self._first is None else self._first
        self._first, self.impacts = None, []
        bend = np.maximum(np.abs(smooth), np.abs(total))
        near = self._near(place, place + drifts * self._dt, bend * self._dt**2)
        begun, self.begun = self.begun, drifts
        if not len(near):
            return None
        pull = self._pull(smooth, total, begun, drifts)
        path = Path(place, drifts - pull * (self._dt / 2), pull)
        self._follow(path, near, smooth * self._dt)
        if not self.impacts:
            return None
        place, velocity = path.at(self._dt)
        hit = path.struck
        self.begun = np.where(hit[:, None], velocity - path.pull * (self._dt / 2), drifts)
        state[hit, :3] = (place - self.begun * self._dt)[hit]
        state[:, 3:] = self.begun
        self._batch.set_state(state)
        return self.begun - drifts

    def contacts(self) -> Contacts:
        """Return the impacts of the last drift as contacts."""
        if not self.impacts:
            return NO_CONTACTS
        two = [(i.points[0], i.points[-1]) for i in self.impacts]
        across = [i.impulse / i.normal for i in self.impacts]
        return Contacts(
            np.array([i.bodies for i in self.impacts], dtype=np.intp),
            np.ones(len(two), dtype=bool),
            np.array([(i.normal.real, i.normal.imag) for i in self.impacts]),
            np.array([a.real for a in across]),
            np.array([abs(a.imag) for a in across]),
            np.array([len(i.points) for i in self.impacts], dtype=np.intp),
            np.array([[(p.real, p.imag) for p in points] for points in two]),
            np.array([(i.impulse.real, i.impulse.imag) for i in self.impacts]),
            np.zeros(len(two)),
        )

    def _boxes(self, state: Array) -> tuple[Array, Array]:
        """Return the corners of boxes around the shapes, from their bodies' places: (s, 2) each."""
        turns = (self._agility[:, 2] > 0) | (state[:, 5] != 0)
        low, high = np.empty((len(self._outlines), 2)), np.empty((len(self._outlines), 2))
        for index, outline in enumerate(self._outlines):
            corners = [rect(1, state[outline.body, 2]) * corner for corner in outline.corners]
            if turns[outline.body]:
                corners = [complex(sign, sign) * outline.reach for sign in (-1, 1)]
            x, y = [c.real for c in corners], [c.imag for c in corners]
            low[index], high[index] = (min(x), min(y)), (max(x), max(y))
            low[index] -= outline.radius
            high[index] += outline.radius
        return low, high

    def _near(self, start: Array, end: Array, bend: Array) -> list[tuple[int, int]]:
        """Return the pairs of shapes whose boxes meet on the way; paths bend by bend / 8."""
        low = np.minimum(start, end)[:, :2] - bend[:, :2] / 8
        high = np.maximum(start, end)[:, :2] + bend[:, :2] / 8
        low, high = low[self._row] + self._low, high[self._row] + self._high
        a, b = self._pairs.T
        meet = ((low[a] <= high[b]) & (low[b] <= high[a])).all(axis=1)
        return [(int(i), int(j)) for i, j in self._pairs[meet]]

    def _pull(self, smooth: Array, total: Array, before: Array, after: Array) -> Array:
        """Return the accelerations of the last kick, without what an impact in it did."""
        contacts = self._batch.contacts()
        tied = self._held.copy()
        tied[contacts.bodies] = True
        pull = np.where(tied[:, None], total, smooth)
        hit, onwards = impacts(
            contacts, self._solids.pairs, before, after, smooth, self._mass, self._dt
        )
        pull[hit] = onwards
        return pull

    def _follow(self, path: Path, near: list[tuple[int, int]], adds: Array) -> None:
        """Let one impact come after the other until the drift is over."""
        hits = self._hits(path, near, 0.0, adds)
        while hits:
            if len(self.impacts) == MOST:
                raise EndlessImpacts(max(hits[0].bodies))
            hit = min(hits, key=lambda h: h.time)
            struck = self._collide(path, hit)
            place, _ = path.at(hit.time)
            end, _ = path.at(self._dt)
            bend = np.abs(path.pull) * (self._dt - hit.time) ** 2
            again = [p for p in self._near(place, end, bend) if struck[self._row[[*p]]].any()]
            hits = [h for h in hits if not struck[[*h.bodies]].any()]
            hits += self._hits(path, again, hit.time, adds)

    def _hits(
        self, path: Path, near: list[tuple[int, int]], since: float, adds: Array
    ) -> list[Hit]:
        shapes = self._outlines
        found = (meet(path, shapes[a], shapes[b], since, self._dt, adds) for a, b in near)
        return [hit for hit in found if hit]

    def _collide(self, path: Path, hit: Hit) -> Booleans:
        """Let two bodies bounce off each other, and return which bodies an impulse reached: (n,).

        What would part for less than half a step does not part: it rests from there on.
        """
        place, velocity = path.at(hit.time)
        e, mu = (float(table[hit.bodies]) for table in self._coefficients)
        gradient = _gradient(hit, place, rubs=mu > 0)
        count, left = len(hit.points), self._dt - hit.time
        answer = answers(gradient, self._agility, self._joints)
        matrix = np.einsum("knc,lnc->kl", answer, gradient)
        rates = np.einsum("knc,nc->k", gradient, velocity)
        pulls = np.einsum("knc,nc->k", gradient[:count], path.pull)
        leaves = -e * np.minimum(rates[:count], 0.0)
        rests = bool((leaves <= np.maximum(-pulls, 0.0) * (self._dt / 2)).all())
        if rests:
            leaves[:] = 0.0
        impulse = _impulses(matrix, rates, leaves, mu)
        struck = np.asarray(answer.any(axis=(0, 2)))
        path.turn(hit.time, np.tensordot(impulse, answer, 1), struck)
        given = np.tensordot(impulse, gradient, 1)
        told = -float(np.sum((given * velocity)[self._mass == 0]))
        rubbed = float(impulse[count:] @ (rates + matrix @ impulse / 2)[count:])
        if rests:
            holds = _impulses(matrix[:count, :count], pulls, np.zeros(count), 0.0)
            path.pull += np.tensordot(holds, answer[:count], 1)
            given += np.tensordot(holds, gradient[:count], 1) * (left - self._dt / 2)
        given[self._mass == 0] = 0.0
        x, y = place[:, :2].T
        turning = x * given[:, 1] - y * given[:, 0] + given[:, 2]
        self.impacts.append(
            Impact(
                hit.bodies,
                hit.time,
                hit.normal,
                hit.points,
                hit.normal * complex(impulse[:count].sum(), impulse[count:].sum()),
                told,
                rubbed,
                np.array([*given[:, :2].sum(axis=0), turning.sum()]),
            )
        )
        return struck


def _gradient(hit: Hit, place: Array, *, rubs: bool) -> Array:
    """Return how fast velocities take the points of an impact apart, and along: (k, n, 3)."""
    directions = [hit.normal] * len(hit.points)
    points = list(hit.points)
    if rubs:
        directions += [1j * d for d in directions]
        points *= 2
    gradient = np.zeros((len(points), *place.shape))
    for row, (point, way) in enumerate(zip(points, directions, strict=True)):
        for body, sign in zip(hit.bodies, (-1, 1), strict=True):
            arm = point - complex(*place[body, :2].tolist())
            turning = arm.real * way.imag - arm.imag * way.real
            gradient[row, body] = sign * way.real, sign * way.imag, sign * turning
    return gradient


def _impulses(matrix: Array, rates: Array, leaves: Array, mu: float) -> Array:
    """Return the impulses at the points of an impact: pushes, and then friction: (k,) [N s].

    Each push makes its point part as told or faster; friction stops it from slipping, as far as mu
    times the push goes. One after the other, until nothing changes (E. Catto: Sequential Impulses,
    GDC 2006).

    Parameters
    ----------
    matrix
        (k, k), how fast each point parts, or slips, by a unit impulse at each.
    rates
        (k,), how fast they do so.
    leaves
        How fast each point shall part.
    mu
        The coefficient of friction.
    """
    impulse, count = np.zeros(len(rates)), len(leaves)
    wanted = np.concatenate((leaves, np.zeros(len(rates) - count)))
    for _ in range(SWEEPS):
        before = impulse.copy()
        for row in range(len(rates)):
            lacks = wanted[row] - rates[row] - matrix[row] @ impulse
            push = impulse[row] + lacks / matrix[row, row]
            most = mu * impulse[row - count] if row >= count else np.inf
            impulse[row] = min(max(push, -most if row >= count else 0.0), most)
        if np.abs(impulse - before).max() <= STILL * np.abs(impulse).max():
            break
    return impulse


def locate(level: Level, values: Values, scene: Scene, dt: float) -> Located | None:
    """Make what locates the impacts of a level's bodies, if it names any."""
    contact, names = level.effects.contact, list(level.bodies)
    if contact is None or contact.located is None:
        return None
    hung = {name for joint in level.joints.values() for name in bodies_of(joint)}
    return Located(
        outlines(list(scene.bodies.values())),
        np.array([name in contact.located for name in names]),
        Coefficients(
            pair_coefficients(level, values, "restitution"),
            pair_coefficients(level, values, "friction"),
        ),
        scene,
        np.array([name in hung for name in names]),
        dt,
    )
