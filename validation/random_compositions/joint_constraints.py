"""The constraints of joints, derived independently from the level's file, and their violation.

The functions accept complex coordinates: a step of 1e-30 i along one of them gives the derivative
to full precision. So the Jacobian that judges the forces is the derivative of the same lengths that
judge the joints, and neither is the engine's.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sandbox.model.level import Level
from validation.random_compositions.body_distances import body_of
from validation.stability.scene_parts import Document

Numbers = NDArray[Any]
"""Real numbers, or complex ones for a derivative."""

STEP = 1e-30
"""The imaginary step of a derivative, whose square vanishes beside 1."""


class Places(NamedTuple):
    """The positions of a level's bodies, in its order, (T, n) each, and the times, (T,)."""

    x: Numbers
    y: Numbers
    angle: Numbers
    t: Numbers


@dataclass(frozen=True, slots=True)
class JointConstraint:
    """A constraint of a joint."""

    joint: str
    violation: Numbers
    """(T,), its violation [m; rad for an angle]."""
    pulls_only: bool = False
    """Whether the violation may be negative, as for a rope."""

    @property
    def error(self) -> Numbers:
        """The absolute violation of the constraint: (T,)."""
        off = self.violation.real
        return np.asarray(np.maximum(off, 0.0) if self.pulls_only else np.abs(off))


class JointConstraints:
    """The constraints of a level's exact joints, relative to the start."""

    def __init__(self, document: Document, level: Level) -> None:
        self._rows = {name: i for i, name in enumerate(document["bodies"])}
        self._joints: Mapping[str, Document] = document.get("joints", {})
        self._level = level
        bodies = document["bodies"].values()
        position = np.array([body.get("position", (0, 0)) for body in bodies], dtype=float)
        angle = np.array([body.get("angle", 0.0) for body in bodies], dtype=float)
        start = Places(position[None, :, 0], position[None, :, 1], angle[None], np.zeros(1))
        self._zero = {
            name: [row[0] for row in self._measure(name, joint, start)]
            for name, joint in self._joints.items()
        }

    def __call__(self, poses: Places) -> list[JointConstraint]:
        """Return the constraints of all joints."""
        return [kept for name in self._joints for kept in self.of(name, poses)]

    def of(self, name: str, poses: Places) -> list[JointConstraint]:
        """Return the constraints of a joint, one for each equation; none for a spring."""
        joint = self._joints[name]
        measured = self._measure(name, joint, poses)
        pulls = joint["type"] in ("rope", "pulley", "winding")
        return [
            JointConstraint(name, row - self._aim(joint, index, zero, poses.t), pulls)
            for index, (row, zero) in enumerate(zip(measured, self._zero[name], strict=True))
        ]

    def _aim(self, joint: Document, index: int, start: Numbers, t: Numbers) -> Numbers:
        """Return the required values of a measure at given times: by default, that of the start."""
        if joint["type"] in ("pivot", "motor", "rail") and index < 2:
            return np.zeros_like(t)
        if joint["type"] == "motor":
            return np.asarray(start + float(joint["rate"]) * t)
        length = joint.get("length")
        if isinstance(length, str):
            name = next(n for n, j in self._joints.items() if j is joint)
            return np.asarray(self._level.joints[name].length.over({}, t))  # type: ignore[union-attr]
        return np.asarray(start if length is None else float(length))

    def _measure(self, name: str, joint: Document, poses: Places) -> list[Numbers]:
        match joint["type"]:
            case "rod" | "rope" | "pulley":
                path = [joint["ends"][0], *joint.get("over", ()), joint["ends"][1]]
                points = [self.point(end, poses) for end in path]
                lengths = (length(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points))
                return [sum(lengths, np.zeros_like(poses.t))]
            case "pivot" | "motor" | "weld":
                return self._pinned(joint, poses)
            case "rail":
                (ax, ay), (bx, by) = (self.point(end, poses) for end in joint["ends"])
                dx, dy = np.array(joint["direction"]) / np.hypot(*joint["direction"])
                return [dx * (ay - by) - dy * (ax - bx)]
            case "winding":
                return [self._wound(joint, poses)]
            case "wire":
                return [self._astray(name, joint, poses)]
        return []

    def _pinned(self, joint: Document, poses: Places) -> list[Numbers]:
        """Return the offset of two points, in the frame of the first body if it is welded."""
        (ax, ay), (bx, by) = (self.point(end, poses) for end in joint["ends"])
        dx, dy = bx - ax, by - ay
        if joint["type"] == "pivot":
            return [dx, dy]
        first, second = (self._angle(end, poses) for end in joint["ends"])
        if joint["type"] == "weld":
            c, s = np.cos(first), np.sin(first)
            dx, dy = c * dx + s * dy, c * dy - s * dx
        turns = [second - first] if self._level.effects.rotation else []
        return [dx, dy, *turns]

    def _wound(self, joint: Document, poses: Places) -> Numbers:
        """Return the length of a string, both free and wound on its wheel [m]."""
        (ax, ay), (bx, by) = (self.point(end, poses) for end in joint["ends"])
        radius = float(joint["radius"])
        sense = 1.0 if joint["unwinds"] == "counterclockwise" else -1.0
        dx, dy = ax - bx, ay - by
        free = np.sqrt(dx * dx + dy * dy - radius**2)
        leaves = direction(dx, dy) - sense * np.arctan(free / radius)
        around = np.unwrap(leaves.real) + 1j * leaves.imag
        if not np.iscomplexobj(leaves):
            around = around.real
        return np.asarray(free + sense * radius * (around - self._angle(joint["ends"][1], poses)))

    def _astray(self, name: str, joint: Document, poses: Places) -> Numbers:
        """Return the distance of a bead from its wire, by Newton's method [m]."""
        wire: Any = self._level.joints[name]
        first, last = (float(end) for end in joint["s"])
        along = np.linspace(first, last, 4001)
        curve = [axis.over({}, along) for axis in wire.curve]
        x, y = self.point(joint["bead"], poses)
        apart = np.hypot(x.real[:, None] - curve[0], y.real[:, None] - curve[1])
        s, step = along[apart.argmin(axis=1)], 1e-6 * (last - first)
        for _ in range(6):
            px, py = (axis.over({}, s) for axis in wire.curve)
            tx, ty = (
                (axis.over({}, s + step) - axis.over({}, s - step)) / (2 * step)
                for axis in wire.curve
            )
            s = s + ((x.real - px) * tx + (y.real - py) * ty) / (tx * tx + ty * ty)
        speed = np.hypot(tx, ty)
        return np.asarray((tx * (y - py) - ty * (x - px)) / speed)

    def point(self, end: object, poses: Places) -> tuple[Numbers, Numbers]:
        """Return the position of a joint's end: (T,) each [m]."""
        if isinstance(end, Sequence) and not isinstance(end, str):
            still = np.ones_like(poses.t)
            return end[0] * still, end[1] * still
        row = self._rows[str(body_of(end))]
        x, y, angle = poses.x[:, row], poses.y[:, row], poses.angle[:, row]
        if isinstance(end, str):
            return x, y
        assert isinstance(end, dict)
        (px, py), c, s = end["at"], np.cos(angle), np.sin(angle)
        return x + c * px - s * py, y + s * px + c * py

    def _angle(self, end: object, poses: Places) -> Numbers:
        name = body_of(end)
        return np.zeros_like(poses.t) if name is None else poses.angle[:, self._rows[name]]

    def slopes(self, poses: Places) -> tuple[list[str], NDArray[np.float64]]:
        """Return the joint of each equation, (m,), and its Jacobian, (T, m, n, 3), at T instants.

        The Jacobian is that with respect to positions and angles.
        """
        times, count = poses.x.shape
        names = [kept.joint for kept in self(poses)]
        slopes = np.zeros((times, len(names), count, 3))
        for axis in range(3):
            for row in range(count):
                moved = [np.array(part, dtype=complex) for part in poses[:3]]
                moved[axis][:, row] += 1j * STEP
                kept = self(Places(moved[0], moved[1], moved[2], poses.t))
                for equation, of in enumerate(kept):
                    slopes[:, equation, row, axis] = of.violation.imag / STEP
        return names, slopes


def length(dx: Numbers, dy: Numbers) -> Numbers:
    """Return √(dx² + dy²), for complex numbers as well."""
    return np.asarray(np.sqrt(dx * dx + dy * dy))


def direction(dx: Numbers, dy: Numbers) -> Numbers:
    """Return atan2(dy, dx), also for numbers with a tiny imaginary part [rad]."""
    angle = np.arctan2(dy.real, dx.real)
    if not (np.iscomplexobj(dx) or np.iscomplexobj(dy)):
        return np.asarray(angle)
    square = dx.real**2 + dy.real**2
    return np.asarray(angle + 1j * (dx.real * dy.imag - dy.real * dx.imag) / square)
