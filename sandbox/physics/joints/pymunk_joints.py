"""pymunk's own joints: springs, and joints that levels declare as not exact.

pymunk's solver iterates over its constraints one by one. The accuracy of velocities depends on the
number of iterations; errors of positions are corrected by a fraction in each later step.

A spring without a damper is not solved as a constraint. It pulls once a step, between drift and
kick, by its extension there: this is leapfrog to the last digit, at a hundredth of the cost of a
force law.
"""

from collections.abc import Iterable, Sequence
from math import fsum

import pymunk

from sandbox.model.expressions import Values
from sandbox.model.joints import Motor, Own, Pivot, Rod, Rope, Weld
from sandbox.physics.forces.spring import SpringForce

End = tuple[pymunk.Body, tuple[float, float]]
"""A body, and its anchor point in its own axes [m]."""


class OwnJoint:
    """A joint that pymunk solves; `length` is that of a rod or rope [m].

    `turns` tells whether any of the bodies can turn.
    """

    def __init__(
        self, spec: Own, values: Values, ends: tuple[End, End], length: float, *, turns: bool
    ) -> None:
        (a, at), (b, on) = ends
        self._angular: tuple[pymunk.Constraint, ...] = ()
        match spec:
            case Rod():
                self._linear: pymunk.Constraint = pymunk.PinJoint(a, b, at, on)
                self._linear.distance = length
            case Rope():
                self._linear = pymunk.SlideJoint(a, b, at, on, 0, length)
            case Pivot():
                self._linear = pymunk.PivotJoint(a, b, at, on)
            case Weld():
                point = b.local_to_world(on)
                self._linear = pymunk.PivotJoint(a, b, a.world_to_local(point), on)
                self._angular = (pymunk.GearJoint(a, b, b.angle - a.angle, 1),)
            case Motor(rate=rate):
                self._linear = pymunk.PivotJoint(a, b, at, on)
                # pymunk's rate is that of the first body relative to the second
                self._angular = (pymunk.SimpleMotor(a, b, -rate(values)),)
        self._angular = self._angular if turns else ()
        self._kick = 1.0

    @property
    def constraints(self) -> Iterable[pymunk.Constraint]:
        """Its constraints, to be added to the space."""
        return self._linear, *self._angular

    def time(self, kick: float, _drift: float) -> None:
        """Set the duration of the next kicks [s]."""
        self._kick = kick

    def leave(self) -> None:
        """Remove the constraints from the space."""
        space = self._linear.a.space or self._linear.b.space
        assert space
        space.remove(*self.constraints)

    def refit(self) -> None:
        """Keep the present length of a rod or rope, as after a body was moved."""
        joint = self._linear
        if isinstance(joint, pymunk.PinJoint | pymunk.SlideJoint):
            here, there = (
                joint.a.local_to_world(joint.anchor_a),
                joint.b.local_to_world(joint.anchor_b),
            )
            if isinstance(joint, pymunk.PinJoint):
                joint.distance = here.get_distance(there)
            else:
                joint.max = here.get_distance(there)

    @property
    def tension(self) -> float:
        """The size of the force in the last kick [N]."""
        return self._linear.impulse / self._kick

    @property
    def torque(self) -> float:
        """The size of the torque in the last kick [N m]."""
        return fsum(joint.impulse for joint in self._angular) / self._kick


def pull_by_pymunk(spring: SpringForce, bodies: Sequence[pymunk.Body], space: pymunk.Space) -> None:
    """Let pymunk exert the force of a spring that neither damps nor is ever slack."""
    a, b = (space.static_body if e.body is None else bodies[e.body] for e in spring.ends)
    at, on = ((end.point.real, end.point.imag) for end in spring.ends)
    space.add(pymunk.DampedSpring(a, b, at, on, spring.length, spring.stiffness, 0.0))
