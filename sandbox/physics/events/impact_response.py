"""The response to one impact of two bodies, or to several at once, at any time.

Normal impulses at the contact points reverse the approach velocity, scaled by e (Newton's law of
restitution); friction is limited by Coulomb's law. Bodies that would separate for less than half a
step rest on each other from there on.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.time_of_impact import Hit, Path
from sandbox.physics.contacts.impacts.contact_kinematics import over_bodies, pair_jacobian
from sandbox.physics.contacts.impacts.pile_impacts import pushes
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers
from sandbox.physics.forces.law import Law
from sandbox.physics.geometry.outline_distance import surfaces
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.motion import momentum

ITERATIONS = 200
"""The most iterations over the impulses of an impact."""

STILL = 1e-15
"""The relative change of the impulses at which the iteration has converged."""


class Impact(NamedTuple):
    """One impact of two bodies."""

    bodies: tuple[int, int]
    """Their indices."""
    time: float
    """The time since the previous step [s]."""
    normal: complex
    """The unit vector from the first to the second."""
    points: tuple[complex, ...]
    """Their contact points [m]."""
    impulse: complex
    """The impulse on the second body; the first gets the opposite [N s]."""
    kinematic_work: float
    """The work of kinematic bodies [J]."""
    belt_work: float
    """The work of belts [J]."""
    friction_work: float
    """The work of friction [J]."""
    normal_work: float
    """The work of the normal impulses [J]."""
    momentum: Array
    """(3,), the momentum, and the angular momentum about the origin, that it added [kg m/s, kg
    m²/s]."""


class DriftImpacts(NamedTuple):
    """The outcome of the impacts within a drift, for books kept at its middle; n bodies."""

    impacts: Sequence[Impact]
    """The impacts, in order."""
    pre_kick_velocity: Array
    """(n, 3), the velocities at the beginning of the kick after the drift [m/s, rad/s]."""
    reading_shift: float
    """By how much the energy read in the middle of the drift increases only because accelerations
    are smaller than before the impacts [J]: on a parabola the energy is higher by m a² dt²/8 than
    in the middle of the chord."""
    extra_momentum: Array
    """(3,), the momentum and angular momentum from the forces along the path, beyond those from the
    kicks before and after [kg m/s, kg m²/s]."""
    law_works: tuple[tuple[Law, float], ...] = ()
    """The works of forces that depend on velocities, beyond those in the halves of the kicks before
    and after [J]."""


def as_contacts(impacts: Sequence[Impact]) -> Contacts:
    """Return impacts as contacts."""
    two = [(i.points[0], i.points[-1]) for i in impacts]
    across = [i.impulse / i.normal for i in impacts]
    return Contacts(
        np.array([i.bodies for i in impacts], dtype=np.intp),
        np.ones(len(two), dtype=bool),
        np.array([(i.normal.real, i.normal.imag) for i in impacts]),
        np.array([a.real for a in across]),
        np.array([abs(a.imag) for a in across]),
        np.array([len(i.points) for i in impacts], dtype=np.intp),
        np.array([[(p.real, p.imag) for p in points] for points in two]),
        np.array([(i.impulse.real, i.impulse.imag) for i in impacts]),
        np.zeros((len(two), 2)),
    )


class Bounce(NamedTuple):
    """The effect of one impact, or of simultaneous ones, on n bodies."""

    struck: Booleans
    """(n,), the bodies that impulses reached."""
    jump: Array
    """(n, 3), the jumps of their velocities [m/s, rad/s]."""
    acceleration_change: Array
    """(n, 3), the change of the accelerations of bodies that rest on each other from there on
    [m/s², rad/s²]."""
    impacts: tuple[Impact, ...]
    """The impacts, for reports and books."""


class Coefficients(NamedTuple):
    """The coefficients of each pair of n bodies: (n, n) each."""

    restitution: Array
    friction: Array


class _Points(NamedTuple):
    """The k rows of hits of n bodies: normals of all points, then, with friction, their slips."""

    jacobian: Array
    """(k, n, 3), maps velocities to the rates of separation and slip."""
    response: Array
    """(k, n, 3), the jump of the velocities by a unit impulse on each row."""
    delassus: Array
    """(k, k), the rate of each row by a unit impulse on each."""
    belt_slip: Array
    """(k,), the slip due to running belts [m/s]."""

    def of_rows(self, rows: Integers) -> "_Points":
        """Return some of the rows, with the Delassus matrix of all."""
        return self._replace(
            jacobian=self.jacobian[rows],
            response=self.response[rows],
            belt_slip=self.belt_slip[rows],
        )


class ImpactResponse:
    """Computes how the n bodies of a scene bounce off each other, in steps of dt [s]."""

    def __init__(self, coefficients: Coefficients, scene: Scene, dt: float) -> None:
        self._coefficients, self._dt = coefficients, dt
        self._surface_velocity = surfaces(scene.bodies.values())
        self._is_kinematic = scene.mass == 0
        self._inertia, self._inverse_mass = scene.inertia, scene.inverse_mass

    def restitution(self, hit: Hit) -> float:
        """Return the coefficient of restitution of a hit's pair."""
        return float(self._coefficients.restitution[hit.bodies])

    def respond(self, path: Path, hits: Sequence[Hit], *, dead: bool = False) -> Bounce:
        """Return the outcome of simultaneous hits along a path.

        Bodies that would separate for less than half a step rest on each other from there on.
        Points that already separate are left out if holding them would add energy: if they are
        driven together, that is the next impact. If the hits are `dead`, nothing bounces, whatever
        its coefficient.
        """
        hit_of_point = np.repeat(range(len(hits)), [len(hit.points) for hit in hits])
        time, (pose, velocity) = hits[0].time, path.at(hits[0].time)
        tables = (np.array([table[hit.bodies] for hit in hits]) for table in self._coefficients)
        restitution, mu = (table[hit_of_point] for table in tables)
        points = self._points(hits, pose, has_friction=bool(mu.any()))
        jacobian, response, delassus, belt_slip = points
        count = len(hit_of_point)
        rates = np.einsum("knc,nc->k", jacobian, velocity) + belt_slip
        normal_acceleration = np.einsum("knc,nc->k", jacobian[:count], path.acceleration)
        separation_rate = -(0.0 if dead else restitution) * np.minimum(rates[:count], 0.0)
        leaves = separation_rate > np.maximum(-normal_acceleration, 0.0) * (self._dt / 2)
        rests = (np.bincount(hit_of_point, leaves) == 0)[hit_of_point]
        separation_rate[rests] = 0.0
        impulse = _impulses(delassus, rates, separation_rate, mu)
        work = impulse * (rates + delassus @ impulse / 2)
        approaching = rates[:count] < 0
        if not approaching.all() and work[:count].sum() > 0:
            return self.respond(path, _only(hits, approaching), dead=dead)
        resting_forces = np.zeros_like(rates)
        rests &= (np.bincount(hit_of_point, impulse[:count]) > 0)[hit_of_point]
        if rests.any():
            block = delassus[:count, :count][np.ix_(rests, rests)]
            resting_forces[:count][rests] = _impulses(
                block, normal_acceleration[rests], np.zeros(len(block)), mu[rests]
            )
        resting_impulse = resting_forces * ((self._dt - time) - self._dt / 2)
        hit_of_row = np.append(hit_of_point, hit_of_point[: len(rates) - count])
        impacts = []
        for index, hit in enumerate(hits):
            rows = np.flatnonzero(hit_of_row == index)
            values = (impulse[rows], resting_impulse[rows], work[rows])
            impacts.append(self._impact(hit, points.of_rows(rows), values, (pose, velocity)))
        jump, change = (np.tensordot(sizes, response, 1) for sizes in (impulse, resting_forces))
        struck: Booleans = np.asarray(response.any(axis=(0, 2)))
        return Bounce(struck, jump, change, tuple(impacts))

    def _impact(
        self,
        hit: Hit,
        points: _Points,
        values: tuple[Array, Array, Array],
        motion: tuple[Array, Array],
    ) -> Impact:
        """Return the impact of a hit with k rows, given the poses and velocities before it.

        `values` are the impulses of the impact, those of resting until the next kick [N s], and the
        works of the former [J]: (k,) each, normal before friction.
        """
        (impulse, resting_impulse, work), (pose, velocity) = values, motion
        count, jacobian = len(hit.points), points.jacobian
        total_impulse = np.einsum("k,knc->nc", impulse + resting_impulse, jacobian)
        jump = np.einsum("k,knc->nc", impulse, points.response)
        return Impact(
            *(hit.bodies, hit.time, hit.normal, hit.points),
            impulse=hit.normal * complex(impulse[:count].sum(), impulse[count:].sum()),
            kinematic_work=-float(np.sum((total_impulse * velocity)[self._is_kinematic])),
            belt_work=-float(impulse @ points.belt_slip),
            friction_work=float(work[count:].sum()),
            normal_work=float(work[:count].sum()),
            momentum=momentum(self._inertia * jump, pose),
        )

    def _points(self, hits: Sequence[Hit], pose: Array, *, has_friction: bool) -> _Points:
        jacobian = _jacobian(hits, pose, has_friction=has_friction)
        response = jacobian * self._inverse_mass
        delassus = np.einsum("knc,lnc->kl", response, jacobian)
        belt_slip = np.einsum("knc,nc->k", jacobian[..., :2], self._surface_velocity)
        belt_slip[: sum(len(hit.points) for hit in hits)] = 0.0  # belts run along the surface only
        return _Points(jacobian, response, delassus, belt_slip)


def _only(hits: Sequence[Hit], wanted: Booleans) -> list[Hit]:
    """Return hits reduced to the wanted points."""
    remaining = iter(wanted.tolist())
    kept = [hit._replace(points=tuple(p for p in hit.points if next(remaining))) for hit in hits]
    return [hit for hit in kept if hit.points]


def _jacobian(hits: Sequence[Hit], pose: Array, *, has_friction: bool) -> Array:
    """Return the Jacobian of the separation and, with friction, the slip: (k, n, 3)."""
    bodies = np.array([hit.bodies for hit in hits for _ in hit.points], dtype=np.intp)
    points = np.array([point for hit in hits for point in hit.points], dtype=complex)
    directions = np.array([hit.normal for hit in hits for _ in hit.points], dtype=complex)
    if has_friction:
        bodies, points, directions = (
            np.tile(bodies, (2, 1)),
            np.tile(points, 2),
            np.append(directions, 1j * directions),
        )
    bodies = bodies.reshape(-1, 2)
    arms = _vectors(points)[:, None] - pose[bodies, :2]
    return over_bodies(pair_jacobian(arms, _vectors(directions)), bodies, len(pose))


def _vectors(points: NDArray[np.complexfloating]) -> Array:
    """Return points of the plane as x and y: (k, 2)."""
    return points.view(float).reshape(-1, 2)


def _impulses(delassus: Array, rates: Array, separation_rate: Array, mu: Array) -> Array:
    """Return the impulses at the points of impacts, normal before friction: (k,) [N s].

    Each normal impulse makes its point separate at the requested rate or faster; friction stops the
    slip, within mu times the normal impulse. Normal and friction impulses alternate until they
    converge (E. Catto: Sequential Impulses, GDC 2006). The normal impulses are solved together: one
    by one, those of neighbouring points would converge slowly.

    `delassus`, (k, k), is the rate of each row by a unit impulse on each; `rates`, (k,), are those
    before the impact, and `separation_rate` the requested separation rate of each point [m/s].
    """
    impulse, count = np.zeros(len(rates)), len(separation_rate)
    for _ in range(ITERATIONS if len(rates) > count else 1):
        before = impulse.copy()
        missing_rate = separation_rate - rates[:count] - delassus[:count, count:] @ impulse[count:]
        impulse[:count] = pushes(delassus[:count, :count], -missing_rate)
        for row in range(count, len(rates)):
            slip = rates[row] + delassus[row] @ impulse
            limit = mu[row - count] * impulse[row - count]
            impulse[row] = min(max(impulse[row] - slip / delassus[row, row], -limit), limit)
        if np.abs(impulse - before).max() <= STILL * np.abs(impulse).max():
            break
    return impulse
