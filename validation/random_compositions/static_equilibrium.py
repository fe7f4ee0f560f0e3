"""Whether forces can hold a scene at rest, and whether the measured forces do.

At rest the forces on each body sum to zero. Normal forces are n >= 0, friction obeys Coulomb's law,
|f| <= mu n, and ropes only pull; rods, pins, rails and welds give any force. If there are more
unknowns than equations, the forces are not unique. Then a linear programme finds how far the
measured ones are from any that are possible.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy.optimize import linprog

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers
from validation.random_compositions.body_distances import body_of, gap, placed, solids
from validation.random_compositions.independent_shape_properties import extent, is_dynamic, outline
from validation.random_compositions.joint_constraints import JointConstraints, Places
from validation.stability.scene_parts import Document

TOUCHING = 2e-6
"""The distance below which bodies touch [m]: twice the overlap that the engine tolerates."""

UNIQUE = 1e-9
"""A force counts as unique if less than this share of it is undetermined: that is rounding."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact point. A positive normal force acts along `normal` on the second body."""

    bodies: tuple[int, int]
    """The indices of the two bodies."""
    position: Array
    """(2,), its position [m]."""
    normal: Array
    """(2,), from the first body to the second."""
    coefficient: float
    """The coefficient of static friction."""


@dataclass(frozen=True, slots=True)
class Measured:
    """The measured forces: (n,) the sum of normal forces on each body, (j,) those of joints [N]."""

    normal: Array
    tension: Array


class Statics:
    """The equilibrium of a scene with its bodies at the positions of one instant."""

    def __init__(self, document: Document, keeping: JointConstraints, poses: Places) -> None:
        self._document, self._keeping, self._places = document, keeping, poses
        self._bodies = list(document["bodies"].values())
        self._position = np.column_stack((poses.x[0], poses.y[0]))
        effects = document["effects"]
        self._turns = "rotation" in effects
        self._gravity = np.array(effects.get("gravity", {}).get("acceleration", (0, 0)), float)
        self.contacts = list(self._touching()) if "contact" in effects else []
        self._joints = list(self._held())
        given = self._given()
        self.scale = float(np.abs(given[:, :2]).sum()) or 1.0
        self._moves = self._rows()
        self._matrix = self._columns()[self._moves] * self._evened()[:, None]
        self._load = given.ravel()[self._moves] * self._evened() / self.scale

    def _rows(self) -> Integers:
        """Return the indices of the equations that apply, out of 3 n."""
        moves = np.repeat([is_dynamic(body) for body in self._bodies], 3)
        moves[2::3] &= self._turns
        return np.flatnonzero(moves)

    def _evened(self) -> Array:
        """Return factors that turn torques into forces: one over the size of each body [1/m]."""
        even = np.ones((len(self._bodies), 3))
        even[:, 2] = [1 / extent(body) for body in self._bodies]
        return np.asarray(even.ravel()[self._moves])

    def _touching(self) -> Iterator[Contact]:
        names = list(self._document["bodies"])
        solid = solids(self._document)
        for a, b in combinations(range(len(names)), 2):
            if solid[names[a]] == solid[names[b]]:
                continue
            if is_dynamic(self._bodies[a]) or is_dynamic(self._bodies[b]):
                mu = self._coefficient(a, b)
                for place, normal in self._points(a, b):
                    yield Contact((a, b), place, normal, mu)

    def _coefficient(self, a: int, b: int) -> float:
        if "friction" not in self._document["effects"]:
            return 0.0
        one, other = (self._bodies[i] for i in (a, b))
        return float(np.prod([c.get("static_friction", c["friction"]) for c in (one, other)]))

    def _points(self, a: int, b: int) -> Iterator[tuple[Array, Array]]:
        """Yield the contact points of two bodies: the corners of each that lie on the other."""
        angle = self._places.angle[0]
        for first in outline(self._bodies[a]):
            corners = placed(first, self._position[a][None], angle[a : a + 1])
            for second in outline(self._bodies[b]):
                others = placed(second, self._position[b][None], angle[b : b + 1])
                radii = first.radius + second.radius
                whole = gap(corners, others, radii)
                if whole.separation[0] > TOUCHING:
                    continue
                normal = whole.normal[0]
                yield from _on(corners, others, radii, normal, first.radius)
                yield from _on(others, corners, radii, normal, -second.radius)

    def _held(self) -> Iterator[tuple[str, Array, bool]]:
        """Yield each equation of joints that can carry force, with its unit wrenches, (3 n,).

        Those are all but slack ropes.
        """
        names, slopes = self._keeping.slopes(self._places)
        for name, slope, kept in zip(names, slopes[0], self._keeping(self._places), strict=True):
            if not kept.pulls_only or kept.violation[0].real > -TOUCHING:
                yield name, -slope.ravel(), kept.pulls_only

    def _given(self) -> Array:
        """Return the forces of gravity and springs: (n, 3) [N, N m]."""
        force = np.zeros((len(self._bodies), 3))
        for row, body in enumerate(self._bodies):
            if is_dynamic(body):
                force[row, :2] = float(body["mass"]) * self._gravity
        for joint in self._document.get("joints", {}).values():
            if joint["type"] == "spring":
                self._pull(joint, force)
        return force

    def _pull(self, joint: Document, force: Array) -> None:
        ends = [np.array(self._keeping.point(end, self._places))[:, 0] for end in joint["ends"]]
        vector = ends[1] - ends[0]
        far = float(np.hypot(*vector))
        pull = joint["stiffness"] * (far - joint.get("length", far)) * vector / far
        for end, place, sign in zip(joint["ends"], ends, (1, -1), strict=True):
            name = body_of(end)
            if name is not None:
                row = list(self._document["bodies"]).index(name)
                force[row] += self._wrench(row, place, sign * pull)

    def _wrench(self, row: int, position: Array, force: Array) -> Array:
        x, y = position - self._position[row]
        return np.array([*force, x * force[1] - y * force[0]])

    def _columns(self) -> Array:
        """Return the matrix whose columns are the wrenches of unit unknowns: (3 n, unknowns).

        The unknowns are the normal forces, friction, and the forces of joints.
        """
        count = len(self.contacts)
        columns = np.zeros((3 * len(self._bodies), 2 * count + len(self._joints)))
        for index, contact in enumerate(self.contacts):
            x, y = contact.normal
            for row, sign in zip(contact.bodies, (-1, 1), strict=True):
                for column, force in ((index, (x, y)), (count + index, (-y, x))):
                    wrench = self._wrench(row, contact.position, sign * np.array(force))
                    columns[3 * row : 3 * row + 3, column] += wrench
        for index, (_, pull, _) in enumerate(self._joints):
            columns[:, 2 * count + index] = pull
        return columns

    def stands(self, share: float = 1.0) -> bool:
        """Return whether equilibrium is possible with a share of the available friction."""
        count = self._matrix.shape[1]
        found = self._solve(np.zeros((0, count)), np.zeros(0), share)
        return found is not None

    def error(self, measured: Measured) -> float:
        """Return the error of measured forces from equilibrium, relative to the total weight.

        Infinite if no equilibrium is possible.
        """
        rows, values, unique = self._unknowns(measured)
        found = self._solve(rows, values / self.scale)
        if found is None:
            return float("inf")
        return max(found, unique)

    def _solve(self, rows: Array, values: Array, share: float = 1.0) -> float | None:
        """Return the least t with |rows · forces − values| <= t; None if nothing holds it."""
        contacts, unknowns = len(self.contacts), self._matrix.shape[1]
        cone = np.zeros((2 * contacts, unknowns + 1))
        for index, contact in enumerate(self.contacts):
            cone[2 * index : 2 * index + 2, index] = -share * contact.coefficient
            cone[2 * index : 2 * index + 2, contacts + index] = 1, -1
        near = np.block([[rows, -np.ones((len(rows), 1))], [-rows, -np.ones((len(rows), 1))]])
        bounds: list[tuple[float | None, float | None]] = [(0, None)] * contacts
        bounds += [(None, None)] * contacts
        bounds += [(0 if pulls else None, None) for _, _, pulls in self._joints]
        found = linprog(
            np.append(np.zeros(unknowns), 1.0),
            A_ub=np.concatenate((cone, near)),
            b_ub=np.concatenate((np.zeros(2 * contacts), values, -values)),
            A_eq=np.column_stack((self._matrix, np.zeros(len(self._matrix)))),
            b_eq=-self._load,
            bounds=[*bounds, (0, None)],
        )
        return float(found.x[-1]) if found.status == 0 else None

    def _unknowns(self, measured: Measured) -> tuple[Array, Array, float]:
        """Return measured forces as equations for the unknowns, and the unique ones' error."""
        contacts, unknowns = len(self.contacts), self._matrix.shape[1]
        rows, values = [], []
        for row, body in enumerate(self._bodies):
            touched = [i for i, c in enumerate(self.contacts) if row in c.bodies]
            if is_dynamic(body):
                rows.append(np.isin(np.arange(unknowns), touched).astype(float))
                values.append(float(measured.normal[row]))
        unique = 0.0
        known = np.linalg.lstsq(self._matrix, -self._load, rcond=None)[0]
        free = _open(self._matrix)
        for index, (name, joint) in enumerate(self._document.get("joints", {}).items()):
            tension = float(measured.tension[index])
            columns = [2 * contacts + i for i, held in enumerate(self._joints) if held[0] == name]
            if joint["type"] in ("rod", "rope", "pulley", "winding") and columns:
                rows.append(np.eye(unknowns)[columns[0]])
                values.append(tension)
            elif columns and joint["type"] != "spring":
                columns = columns[:2]
                if np.abs(free[columns]).max(initial=0.0) < UNIQUE:
                    force = float(np.hypot.reduce(known[columns]))
                    unique = max(unique, abs(force - abs(tension) / self.scale))
        return np.array(rows).reshape(len(rows), unknowns), np.array(values), unique


def _on(
    corners: Array, others: Array, radii: float, normal: Array, radius: float
) -> Iterator[tuple[Array, Array]]:
    """Yield the corners that touch the other part, with the normal of the contact."""
    for corner in corners[0]:
        here = gap(corner[None, None], others, radii)
        if here.separation[0] <= TOUCHING:
            yield corner + radius * normal, normal


def _open(matrix: Array) -> Array:
    """Return an orthonormal basis of the null space of a matrix: (unknowns, m)."""
    _, sizes, right = np.linalg.svd(matrix)
    rank = int(np.sum(sizes > 1e-10 * sizes.max(initial=0.0)))
    return np.asarray(right[rank:].T)
