"""The rate that a scene needs in its present state, from known limits.

The search for an accuracy begins with the rate that the start needs. The watchdog asks which limit
a failed run had exceeded.

Leapfrog is stable up to ω dt = 2, for springs and for transverse oscillations of taut strings
alike. A body that moves further than its own width in a step may pass through others.
"""

from collections.abc import Container, Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.shapes.pymunk_shapes import DIRECT_SKIN
from sandbox.physics.forces.law import Law
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.geometry.outline_distance import width, without_feelers
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.scene.stability_limits import PROBE, just_stable, stability_limit
from sandbox.physics.state.joint_anchors import path_length
from sandbox.physics.state.motion import Instant, Motion
from sandbox.physics.state.snapshot import Snapshot

NUDGE = 1e-3
"""The relative change of a velocity for the numerical derivative of a force."""

SPEEDS = np.geomspace(1e-9, 1e9, 361)
"""m/s, 12 % apart: the speeds at which a law is compared with the forces that drive a body."""


THIN = 4 * DIRECT_SKIN
"""m, the largest width of a line, which has the skin on both sides."""


class RateBound(NamedTuple):
    """A lower bound on the rate."""

    rate: float
    """The rate that is just stable, or at which no impact is missed [Hz]."""
    subject: Message
    """What needs it, in words: a joint, a body or an effect."""


def rate_bounds(scene: Scene, now: Snapshot, located: Container[str] = ()) -> list[RateBound]:
    """Return the lower bounds on the rate of a scene in a state, the highest first.

    The transverse stiffness of a taut string is its tension over its length, so a chain of light
    links needs about √(T / (m l)). Forces other than springs and tensions are not considered.
    Tensions and speeds change: ask again, or leave a margin. The bodies whose impacts are `located`
    in time may be fast.
    """
    by_speed = speed_bounds(scene, np.hypot(*now.velocity.T), widths(scene), located)
    return sorted(
        (*_spring_bound(scene, now), *_transverse_bound(scene, now), *by_speed), reverse=True
    )


def required_rate(scene: Scene, now: Snapshot, located: Container[str] = ()) -> float:
    """Return the highest of `rate_bounds`, 0 if there are none [Hz]."""
    return max((bound.rate for bound in rate_bounds(scene, now, located)), default=0.0)


def _spring_bound(scene: Scene, now: Snapshot) -> Iterator[RateBound]:
    rate, name = stability_limit(scene.joints.springs, scene.inverse_mass, now.angle)
    if rate:
        yield RateBound(rate, Message("the spring '{name}'", name=name))


def _transverse_bound(scene: Scene, now: Snapshot) -> Iterator[RateBound]:
    """Treat taut joints as springs of their transverse stiffness."""
    joints = scene.joints
    taut: dict[str, SpringForce] = {}
    tension = dict(zip(joints.paths, now.tension.tolist(), strict=True))
    for name in joints.lines:
        pull = tension[name]
        for index, ends in enumerate(pairwise(joints.paths[name])):
            distance = float(path_length(ends, now))
            if distance > 0 and pull > 0:
                taut[f"{index} {name}"] = SpringForce(ends, pull / distance, distance, 0.0)
    rate, name = stability_limit(taut, scene.inverse_mass, now.angle)
    if rate:
        yield RateBound(rate, Message("the joint '{name}'", name=name.partition(" ")[2]))


def widths(scene: Scene) -> Array:
    """Return the smallest width of each body's shapes, (n,) [m].

    That of lines is infinite: they are as wide as the skin, and no practical rate is enough.
    """
    shapes = (map(width, without_feelers(body.shapes)) for body in scene.bodies.values())
    least = np.array([min(each, default=0.0) for each in shapes])
    return np.where(least > THIN, least, np.inf)


def speed_bounds(
    scene: Scene, speeds: Array, width: Array, located: Container[str] = ()
) -> Iterator[RateBound]:
    """Yield the rates at which bodies move by their width in a step.

    `speeds`, (n,), are those of the bodies [m/s], and `width`, (n,), their `widths` [m]. Bodies
    whose impacts are `located` need no rate.
    """
    rates = np.where(scene.mass > 0, speeds / width, 0.0)
    for name, rate in zip(scene.bodies, rates.tolist(), strict=True):
        if rate > 0 and name not in located:
            yield RateBound(rate, Message("the body '{name}'", name=name))


def stiffness_bounds(scene: Scene, row: int, motion: Motion, nudge: float) -> Iterator[RateBound]:
    """Yield the rates that laws need because they change with the position of a body, by its row.

    `motion` is the motion of the scene; `nudge` is the displacement for the numerical derivative of
    the forces on the body [m].
    """
    for law in scene.laws:
        slope = _slope(scene, law, row, motion, "position", nudge)
        yield RateBound(just_stable(slope, 0.0), law_in_words(scene, law))


def damping_bounds(scene: Scene, row: int, present: Motion) -> Iterator[RateBound]:
    """Yield the rates that laws need because they change with the velocity of a body.

    The speed is that of the body, or the terminal speed, at which the law balances the other
    forces, if that is higher.
    """
    for law in scene.laws:
        if law.effect.depends_on_velocity:
            motion = _with_terminal_speed(scene, law, row, Instant.of(present))
            nudge = NUDGE * max(float(np.hypot(*motion.velocity[row])), PROBE)
            slope = _slope(scene, law, row, motion, "velocity", nudge)
            yield RateBound(just_stable(0.0, slope), law_in_words(scene, law))


def _with_terminal_speed(scene: Scene, law: Law, row: int, motion: Instant) -> Instant:
    """Return a motion with at least the speed at which a law balances the other forces."""
    speeds = np.zeros_like(motion.velocity)
    at_rest = _force(law, row, motion._replace(velocity=speeds))
    force = sum((_force(other, row, motion) for other in scene.laws if other is not law), at_rest)
    if scene.gravity:
        force = force + scene.mass[row] * np.array(scene.gravity.acceleration)
    for speed in SPEEDS[np.hypot(*motion.velocity[row]) < SPEEDS]:
        speeds[row, 0] = speed
        driven = motion._replace(velocity=speeds)
        if np.hypot(*(_force(law, row, driven) - at_rest)) >= np.hypot(*force):
            return driven
    return motion


def _slope(scene: Scene, law: Law, row: int, then: Motion, attribute: str, nudge: float) -> float:
    """Return the largest derivative of a body's acceleration by its position or velocity.

    It is 0 if it is not finite [1/s², 1/s].
    """
    slope = np.empty((2, 2))
    motion = Instant.of(then)
    for axis in (0, 1):
        forces = []
        for sign in (-1, 1):
            moved = getattr(motion, attribute).copy()
            moved[row, axis] += sign * nudge
            forces.append(_force(law, row, motion._replace(**{attribute: moved})))
        slope[axis] = (forces[1] - forces[0]) / (2 * nudge)
    if not np.isfinite(slope).all():
        return 0.0
    return float(np.linalg.norm(slope, 2) * scene.inverse_mass[row, 0])


def _force(law: Law, row: int, motion: Instant) -> Array:
    """Return the force of a law on a body [N]: (2,)."""
    wrench = np.zeros((len(motion.position), 3))
    with np.errstate(all="ignore"):
        law.add(motion, wrench)
    return wrench[row, :2]


def law_in_words(scene: Scene, law: Law) -> Message:
    """Return the spring or effect that declares a law, in words."""
    for name, spring in scene.joints.springs.items():
        if spring is law:
            return Message("the spring '{name}'", name=name)
    return Message("the effect '{name}'", name=law.effect.name)
