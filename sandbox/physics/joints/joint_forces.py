"""The forces of exact joints in a kick, for the energy books."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.joints.pulley import PulleyString
from sandbox.physics.joints.scene_joints import Joints


class JointForces(NamedTuple):
    """The forces of exact joints in a kick; m equations, n bodies."""

    jacobian: Array
    """(m, n, 3), the derivatives of the equations by the bodies' positions and angles."""
    tension: Array
    """(m,), the forces along these rows, positive where they pull [N]."""
    pulls_only: Booleans
    """(m,), whether they can only pull, as ropes."""
    changes: Booleans
    """(m,), whether the prescribed values, such as lengths, change with time."""
    joints: NDArray[np.str_]
    """(m,), the names of their joints."""

    def slack_before(self, last: "JointForces", first: "JointForces") -> Booleans:
        """Return which of these did not pull in one of two earlier kicks: (m,).

        Equations that did not exist then count as not slack.
        """
        if all(np.array_equal(one.joints, self.joints) for one in (last, first)):
            return np.asarray((last.tension <= 0) | (first.tension <= 0))
        return self.among(row for one in (last, first) for row in one.numbered(one.tension <= 0))

    def new(self, last: "JointForces") -> Booleans:
        """Return which of these did not exist in the last kick: (m,)."""
        if np.array_equal(last.joints, self.joints):
            return np.zeros(len(self.joints), dtype=bool)
        return ~self.among(last.numbered())

    def among(self, equations: Iterable[tuple[str, int]]) -> Booleans:
        """Return which of these are among equations that are `numbered`: (m,)."""
        there = set(equations)
        return np.array([row in there for row in self.numbered()], dtype=bool)

    def numbered(self, which: Booleans | None = None) -> list[tuple[str, int]]:
        """Return the joint of each equation, or of some, and its index among that joint's."""
        counts: Counter[str] = Counter()
        found = []
        for name in self.joints.tolist():
            found.append((name, counts[name]))
            counts[name] += 1
        return found if which is None else [found[i] for i in np.flatnonzero(which)]


def pulls_of(joints: Joints, count: int) -> JointForces:
    """Return the forces of the exact joints in the last kick on all `count` bodies."""
    parts = [
        _of_string(name, string, [joints.paths[name][end].body for end in (0, -1)], count)
        for name, string in joints.strings.items()
    ]
    if together := joints.together:
        names = np.array(together.names, dtype=str)
        parts.append(
            JointForces(
                together.jacobian(), together.tension, together.pulls_only, together.changes, names
            )
        )
    if not parts:
        none = np.zeros(0, dtype=bool)
        return JointForces(np.zeros((0, count, 3)), np.zeros(0), none, none, np.zeros(0, dtype=str))
    return JointForces(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _of_string(
    name: str, string: PulleyString, rows: Sequence[int | None], count: int
) -> JointForces:
    jacobian = np.zeros((1, count, 3))
    for row, direction in zip(rows, string.jacobian(), strict=True):
        if row is not None:
            jacobian[0, row, :2] += direction
    named = np.array([name], dtype=str)
    return JointForces(
        jacobian, np.array([string.tension]), np.array([True]), np.array([False]), named
    )


class JointForce(NamedTuple):
    """The force of a joint on one body in the last kick."""

    joint: str
    wrench: tuple[float, float, float]
    """The force, and the torque about the body's centre of mass [N, N m]."""


def pulls_on(joints: Joints, row: int, count: int) -> Iterator[JointForce]:
    """Yield the force of each exact joint on the body `row` of all `count` bodies."""
    for name, string in joints.strings.items():
        one = _of_string(name, string, [joints.paths[name][end].body for end in (0, -1)], count)
        yield _on(name, row, one.jacobian, one.tension)
    if together := joints.together:
        names, jacobians = np.array(together.names), together.jacobian()
        for name in dict.fromkeys(together.names):
            rows = names == name
            yield _on(name, row, jacobians[rows], together.tension[rows])


def _on(joint: str, row: int, jacobian: Array, tension: Array) -> JointForce:
    x, y, torque = (-tension @ jacobian[:, row]).tolist()
    return JointForce(joint, (x, y, torque))
