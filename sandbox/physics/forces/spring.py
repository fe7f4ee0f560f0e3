"""A spring with a damper, between two points."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeGuard

import numpy as np

from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.joints import ELASTIC
from sandbox.model.number_bounds import SpringLaw
from sandbox.physics.geometry.quadrature import gauss
from sandbox.physics.state.joint_anchors import Anchor, Complexes
from sandbox.physics.state.motion import Motion

if TYPE_CHECKING:
    from sandbox.physics.forces.force_switch import Switch

NODES = 40
"""The number of points at which a force law is evaluated to integrate its potential energy."""

DAMPED = replace(ELASTIC, depends_on=(*ELASTIC.depends_on, "velocity"))
"""The declaration of the force of a spring with a damper."""


@dataclass(frozen=True, slots=True)
class Law:
    """The force f(x) of a spring beside k x, as a function of its stretch x."""

    formula: SpringLaw  # N
    values: Values

    def force(self, x: Array) -> Array:
        """Return f(x) [N]."""
        return self.formula.at(self.values, {"x": x})

    def energy(self, x: Array) -> Array:
        """Return ∫ f dx from 0 to x [J] by Gauss's rule, exact to rounding if f is smooth."""
        nodes, weights = gauss(NODES)
        points = x[..., None] * (nodes + 1) / 2
        forces = np.broadcast_to(self.force(points), points.shape)
        return np.asarray(x / 2 * (forces @ weights))

    def slope(self, x: float) -> float:
        """Return the largest slope of f, in size, from −|x| to |x| [N/m]."""
        stretches = np.linspace(-abs(x), abs(x), 2 * NODES + 1)
        slopes = self.formula.slope("x").at(self.values, {"x": stretches})
        return float(np.max(np.abs(slopes)))


@dataclass(frozen=True, slots=True)
class SpringForce:
    """F = −k x − f(x) − c dx/dt along the line between its ends, U = k x² / 2 + ∫ f dx, x = l − l0.

    A spring that only pushes has no force where it is longer than l0, and never pulls.

    Its energy belongs in equal parts to the bodies at its ends.
    """

    ends: tuple[Anchor, Anchor]
    stiffness: float  # N/m, k
    length: float  # m, l0
    damping: float  # kg/s, c
    pushes_only: bool = False
    law: Law | None = None  # f
    slope: float = 0.0  # N/m, the largest of f within its stretch at the start
    switch: "Switch | None" = None  # off once it is cut

    @property
    def effect(self) -> Effect:
        """Its declaration as a force."""
        return DAMPED if self.damping > 0 else ELASTIC

    @property
    def is_plain(self) -> bool:
        """Whether its energy is only k x² / 2, and it cannot be cut."""
        return self.law is None and self.switch is None

    @property
    def largest_stiffness(self) -> float:
        """The largest derivative of the force by the stretch [N/m]."""
        return self.stiffness + self.slope

    def tension(self, motion: Motion) -> Array:
        """Return the force by which it pulls [N]; negative where it pushes."""
        return self._tension(motion)[0]

    def energy(self, motion: Motion) -> Array:
        """Return k x² / 2 + ∫ f dx [J]."""
        (a, _), (b, _) = (end.position_and_arm(motion) for end in self.ends)
        stretch = self._stretch(np.abs(b - a))
        energy = self.stiffness * stretch**2 / 2
        energy = np.asarray(energy + self.law.energy(stretch) if self.law else energy)
        return energy * self.switch.at(motion.t) if self.switch else energy

    def span(self, motion: Motion) -> tuple[Complexes, Complexes]:
        """Return its two ends [m]; a spring that only pushes is drawn at most l0 long."""
        (a, _), (b, _) = (end.position_and_arm(motion) for end in self.ends)
        longest = self.length if self.pushes_only else np.inf
        length = np.maximum(np.abs(b - a), 1e-300)
        return a, a + (b - a) * np.minimum(1.0, longest / length)

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add the forces on both ends, and their torques."""
        tension, direction, arms = self._tension(motion)
        forces = wrench[..., :2].view(complex)[..., 0]
        for end, arm, force in zip(
            self.ends, arms, (tension * direction, -tension * direction), strict=True
        ):
            if end.body is not None:
                forces[..., end.body] += force
                if end.point:
                    wrench[..., end.body, 2] += (arm.conj() * force).imag

    def potential_energy(self, motion: Motion) -> Array:
        """Return k x² / 2 + ∫ f dx, in equal parts for the bodies at its ends."""
        bodies = [end.body for end in self.ends if end.body is not None]
        total = self.energy(motion)
        energy = np.zeros(motion.position.shape[:-1])
        for body in bodies:
            energy[..., body] += total / len(bodies)
        return energy

    def _tension(self, motion: Motion) -> tuple[Array, Complexes, tuple[Complexes, Complexes]]:
        """Return the tension, the direction from the first end to the second, and the arms."""
        if self.damping:
            (a, velocity_a, arm_a), (b, velocity_b, arm_b) = (
                end.kinematics(motion) for end in self.ends
            )
        else:  # the velocities do not matter
            (a, arm_a), (b, arm_b) = (end.position_and_arm(motion) for end in self.ends)
        span = b - a
        length = np.abs(span)
        direction = span / np.maximum(length, 1e-300)  # 0 where the ends meet
        stretch = self._stretch(length)
        tension = self.stiffness * stretch
        if self.law:
            tension = tension + self.law.force(stretch)
        if self.damping:
            tension = tension + self.damping * ((velocity_b - velocity_a) * direction.conj()).real
        if self.pushes_only:
            tension = np.where(stretch < 0, np.minimum(tension, 0.0), 0.0)
        if self.switch:
            tension = tension * self.switch.at(motion.t)
        return tension, direction, (arm_a, arm_b)

    def _stretch(self, length: Array) -> Array:
        """Return the stretch x = l − l0, at most 0 if it only pushes [m]."""
        stretch = length - self.length
        return np.minimum(stretch, 0.0) if self.pushes_only else stretch


class SpringRows:
    """The energy of many plain springs at one instant, computed together: U = Σ k x² / 2."""

    def __init__(self, springs: Sequence[SpringForce]) -> None:
        ends = [[spring.ends[i] for spring in springs] for i in (0, 1)]
        # the row after those of the bodies is the plane: its origin, which does not rotate
        self._rows = np.array([[-1 if e.body is None else e.body for e in row] for row in ends])
        self._points = np.array([[end.point for end in row] for row in ends])
        self._stiffness, self._length = (
            np.array([getattr(spring, name) for spring in springs])
            for name in ("stiffness", "length")
        )
        self._largest_stretch = np.array(
            [0.0 if spring.pushes_only else np.inf for spring in springs]
        )

    def energy(self, motion: Motion) -> float:
        """Return their total energy [J] in a motion of n bodies without leading axes."""
        position = np.append(motion.position @ (1, 1j), 0)
        rotation = np.append(np.exp(1j * motion.angle), 1)
        first, second = position[self._rows] + self._points * rotation[self._rows]
        stretch = np.minimum(np.abs(second - first) - self._length, self._largest_stretch)
        return float(self._stiffness @ stretch**2) / 2


def damps(law: object) -> TypeGuard[SpringForce]:
    """Return whether a force law is a spring with a damper."""
    return isinstance(law, SpringForce) and law.damping > 0
