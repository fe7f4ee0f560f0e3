"""A body on a spring: s(t) = s0 cos ωt + v0/ω sin ωt about its equilibrium, ω = √(k/m).

Damped, γ = c/2m: s(t) = e^(−γt) (s0 cos ωt + (v0 + γ s0)/ω sin ωt), ω = √(k/m − γ²). A body
that also swings sideways (a spring pendulum) has no closed form, but energy is conserved.
"""

from collections.abc import Iterator
from math import pi, sqrt

import numpy as np

from sandbox.editing.inserted_value_layout import plain
from sandbox.editing.suggested_checks.recogniser_input import (
    TOUCHING,
    Scene,
    Suggestion,
    as_factor,
    check,
    opposite,
    rate_of,
)
from sandbox.model.expressions import Expression
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import End, Spring, body_of
from sandbox.physics.geometry.outline_distance import dot

NEAR = 1e-4
"""The tolerance of the check; `_rate` chooses the rate for it, as leapfrog is of second order."""

FEW = 40
"""The least number of steps in a period, however short the run."""

STEPS = 200
"""For a spring pendulum, the number of steps in a period of its oscillation along the spring."""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for bodies on springs, and the energies of those that swing aside."""
    if not scene.only("gravity", "contact", "friction", "restitution", "rotation"):
        return
    springs = [joint for joint in scene.level.joints.values() if isinstance(joint, Spring)]
    hung = [(joint, bob) for joint in springs if (bob := _held_by(scene, joint))]
    for joint, bob in hung:
        yield from _along(scene, joint, bob)
    for joint, bob in hung if scene.gravity_y is not None and len(scene.dynamic) == 1 else ():
        yield from _aside(scene, joint, bob)


def _held_by(scene: Scene, joint: Spring) -> str | None:
    """Return the body that a linear spring ties by its centre to the plane, or None."""
    linear = not joint.pushes_only and joint.law is None and joint.stiffness(scene.values) > 0
    return scene.held_by(joint) if linear else None


def _along(scene: Scene, joint: Spring, bob: str) -> Iterator[Suggestion]:
    """Yield the closed form of an oscillation along one of the axes."""
    values, body, fall = scene.values, scene.level.bodies[bob], scene.level.effects.gravity
    first, second = joint.ends
    end = second if body_of(first) else first
    peg = end_position(end, scene.level.bodies, values)
    vector = scene.where[bob].center - peg
    if not vector or (vector.real and vector.imag):
        return
    index = 1 if vector.imag else 0
    pull = complex(*(a(values) for a in fall.acceleration)) if fall else 0j
    k, m = as_factor(joint.stiffness), scene.mass(bob)
    start, speed = as_factor(body.position[index]), as_factor(body.velocity[index])
    slack = start
    if joint.length is not None:
        sign = "+" if vector.real + vector.imag > 0 else "-"
        slack = f"({as_factor(_point(end)[index])} {sign} {as_factor(joint.length)})"
    rest = f"({slack} + {as_factor(fall.acceleration[index])}*{m}/{k})" if fall and pull else slack
    square, form = _motion(k, m, as_factor(joint.damping), rest, start, speed)
    if Expression(square)(scene.known_values) <= 0:
        return  # overdamped or critically damped
    omega, motion = sqrt(Expression(square)(scene.known_values)), Formula(form)
    times = np.linspace(0, min(scene.duration, 2 * pi / omega), 60)
    positions = motion.over(scene.known_values, times)
    swing = positions - (peg.imag if index else peg.real)
    unit = 1j if index else 1 + 0j
    across = dot(pull, unit * 1j) or dot(scene.velocity(bob), unit * 1j)
    if across or np.ptp(swing) < TOUCHING or swing.min() * swing.max() <= 0:
        return
    displacements = [unit * (s - dot(vector, unit)) for s in swing.tolist()]
    others = [name for name in scene.where if name != bob and scene.level.effects.contact]
    if any(scene.distance(bob, by, other) < TOUCHING for by in displacements for other in others):
        return
    axis, most = "xy"[index], plain(float(f"{np.ptp(swing) / 2:.3g}"))
    checks = check("place", f"{bob}.position.{axis}", form, NEAR, scale=most)
    share = max(1.0, float(np.abs(positions).max()) / most)
    yield Suggestion("oscillator", (bob,), (checks,), rate_of(_rate(omega, scene.duration, share)))


def _motion(k: str, m: str, c: str, rest: str, start: str, speed: str) -> tuple[str, str]:
    """Return ω² and s(t) as formulas, given equilibrium, initial position and initial velocity."""
    if c == "0":
        beat = f"sqrt({k}/{m})"
        form = f"{rest} + ({start} - {rest})*cos({beat}*t) + {speed}/{beat}*sin({beat}*t)"
        return f"{k}/{m}", form
    decay = f"{c}/(2*{m})"
    square = f"{k}/{m} - ({decay})**2"
    beat, aside = f"sqrt({square})", f"({start} - {rest})"
    swing = f"{aside}*cos({beat}*t) + ({speed} + {decay}*{aside})/{beat}*sin({beat}*t)"
    return square, f"{rest} + exp(-{decay}*t)*({swing})"


def _point(end: End) -> tuple[Expression, Expression]:
    """Return an end, which is a point of the plane."""
    assert isinstance(end, tuple)
    return end


def _rate(omega: float, lasts: float, share: float) -> float:
    """Return the rate [Hz] at which the final phase error, ω³ dt² t / 24, is half the tolerance.

    The tolerance is relative to the amplitude: NEAR times `share`, which is the largest coordinate
    over the amplitude.
    """
    late = share * NEAR / 2
    return max(sqrt(omega**3 * lasts / 24 / late), omega * FEW / (2 * pi))


def _aside(scene: Scene, joint: Spring, bob: str) -> Iterator[Suggestion]:
    """Yield the energy of a single body released on an unstretched spring without damping."""
    assert scene.gravity_y is not None
    if joint.length is not None or joint.damping.source != 0:
        return
    if all(_swings(each, joint, bob) for each in scene.everywhere):
        weight = f"{scene.mass(bob)}*{opposite(scene.gravity_y)}"
        energy = f"{weight}*{as_factor(scene.level.bodies[bob].position[1])}"
        beat = max(_beat(each, joint, bob) for each in scene.everywhere)
        fields = check("energy", "system.energy", energy, NEAR, scale=weight)
        yield Suggestion("spring pendulum", (bob,), (fields,), rate_of(STEPS * beat))


def _swings(scene: Scene, joint: Spring, bob: str) -> bool:
    """Return whether a bob is released beside its peg, with nothing within its reach.

    At a distance r from the peg, k (r - L)²/2 ≤ m g (r + h), if it starts h above the peg.
    """
    assert scene.gravity_y is not None
    peg = end_position(joint.ends[1] if body_of(joint.ends[0]) else joint.ends[0], {}, scene.values)
    vector = scene.where[bob].center - peg
    if not vector.real or not scene.is_at_rest(bob):
        return False
    sag = -scene.gravity_y(scene.values) / (2 * pi * _beat(scene, joint, bob)) ** 2
    far = abs(vector) + sag + sqrt(sag**2 + 2 * sag * (abs(vector) + vector.imag))
    contact = scene.level.effects.contact is not None
    others = [name for name in scene.where if name != bob and contact]
    return all(scene.distance(bob, -vector, other) > far for other in others)


def _beat(scene: Scene, joint: Spring, bob: str) -> float:
    """Return the frequency of oscillation along the spring [Hz]."""
    mass = scene.level.bodies[bob].mass
    assert mass is not None
    return sqrt(joint.stiffness(scene.values) / mass(scene.values)) / (2 * pi)
