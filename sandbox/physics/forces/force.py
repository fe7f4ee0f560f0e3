"""Forces that a level prescribes, constant or over time."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from sandbox.model.effects import force as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.state.motion import Motion


@dataclass(frozen=True, slots=True)
class Steady:
    """All constant forces along the plane's axes, summed for each of k consecutive bodies.

    F on a point p of a body, which turns with it by θ, has the torque and the potential

        τ = (p × F) cos θ − (p · F) sin θ,    U = −F · r − (p · F) cos θ − (p × F) sin θ,

    with r the centre of mass; so the sums of F, p × F and p · F suffice for each body.
    """

    effect: ClassVar[Effect] = declared.Force.effect

    bodies: slice  # from the first body with a force to the last
    force: Array  # (k, 2) N
    cross: Array  # (k,) N m, p × F
    dot: Array  # (k,) N m, p · F
    twists: bool  # whether any acts on a point off the centre of mass

    @classmethod
    def of(cls, pushes: Sequence[tuple[int, XY, XY]]) -> "Steady":
        """Return the sum of forces, each given by its body, point and force [m, N]."""
        first = min(body for body, _, _ in pushes)
        count = max(body for body, _, _ in pushes) - first + 1
        force, cross, dot = np.zeros((count, 2)), np.zeros(count), np.zeros(count)
        for body, (px, py), (x, y) in pushes:
            force[body - first] += x, y
            cross[body - first] += px * y - py * x
            dot[body - first] += px * x + py * y
        twists = any(any(point) for _, point, _ in pushes)
        return cls(slice(first, first + count), force, cross, dot, twists)

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add F, and its torque about the centre of mass."""
        if wrench.ndim == 2 and len(self.cross) == 1:  # a third of the time of arrays of one number
            row, only = self.bodies.start, wrench[self.bodies.start]
            only[:2] += self.force[0]
            if self.twists:
                angle = motion.angle[row]
                only[2] += self.cross[0] * np.cos(angle) - self.dot[0] * np.sin(angle)
            return
        force = wrench[..., self.bodies, :2]
        force += self.force
        if self.twists:
            angle = motion.angle[..., self.bodies]
            torque = self.cross * np.cos(angle) - self.dot * np.sin(angle)
            wrench[..., self.bodies, 2] = wrench[..., self.bodies, 2] + torque

    def potential_energy(self, motion: Motion) -> Array:
        """Return −F · r, with r the points on which the forces act."""
        position, angle = motion.position[..., self.bodies, :], motion.angle[..., self.bodies]
        energy = np.zeros(motion.position.shape[:-1])
        energy[..., self.bodies] = -np.sum(self.force * position, axis=-1)
        energy[..., self.bodies] -= self.dot * np.cos(angle) + self.cross * np.sin(angle)
        return energy


@dataclass(frozen=True, slots=True)
class Push:
    """A force on a point of a body that changes with time, or turns with the body.

    A force that turns with the body does work along closed paths, so it has no potential; nor has
    one that changes with time.
    """

    effect: ClassVar[Effect] = replace(declared.Force.effect, book="work")

    force: tuple[Formula, Formula]  # N
    values: Values
    body: int
    point: XY  # m, from the centre of mass, along the body's axes
    turns: bool = False  # with the body
    _steady: tuple[float, float] | None = field(init=False)  # N, unless it changes with time

    def __post_init__(self) -> None:
        """Store the force if it does not change with time."""
        changes = any("t" in component.names for component in self.force)
        start = np.zeros(())
        x, y = (float(component.over(self.values, start)) for component in self.force)
        object.__setattr__(self, "_steady", None if changes else (x, y))

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add F, and its torque about the centre of mass."""
        x, y = self._steady or (f.over(self.values, motion.t) for f in self.force)
        if self.turns:
            x, y = self._turned(motion, x, y)
        wrench[..., self.body, 0] += x
        wrench[..., self.body, 1] += y
        if any(self.point):
            arm_x, arm_y = self._turned(motion, *self.point)
            wrench[..., self.body, 2] += arm_x * y - arm_y * x

    def potential_energy(self, motion: Motion) -> Array:
        """Return zero."""
        return np.zeros(motion.position.shape[:-1])

    def _turned(self, motion: Motion, x: Array | float, y: Array | float) -> tuple[Array, Array]:
        """Return a vector of the body's axes in the plane's axes."""
        angle = motion.angle[..., self.body]
        c, s = np.cos(angle), np.sin(angle)
        return c * x - s * y, s * x + c * y


def laws(entries: Sequence[declared.Force], inputs: LawInputs) -> Iterator[Law]:
    """Yield each force that changes or turns, and all others together."""
    steady: list[tuple[int, XY, XY]] = []
    for force in entries:
        point, body = evaluate(force.at, inputs.values), inputs.row(force.body)
        if force.has_no_potential:
            yield Push(force.force, inputs.values, body, point, force.frame == "body")
        else:
            x, y = (component(inputs.values) for component in force.force)
            steady.append((body, point, (x, y)))
    if steady:
        yield Steady.of(steady)
