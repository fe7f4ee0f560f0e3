"""A body on a spring that swings aside: there is no closed form, but energy is conserved."""

from collections.abc import Iterator
from math import pi, sqrt

from sandbox.editing.suggested_checks.oscillator import held_by
from sandbox.editing.suggested_checks.recogniser_input import (
    Scene,
    Suggestion,
    check,
    opposite,
    rate_of,
    said,
)
from sandbox.model.joint_ends_at_start import place
from sandbox.model.joints import Spring, body_of

NEAR = 1e-4
"""The tolerance of the energy at the rate below: leapfrog is of second order."""

STEPS = 200
"""The number of steps in an oscillation."""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the energies of single bodies released on an unstretched spring."""
    effects = ("gravity", "contact", "friction", "restitution", "rotation")
    if scene.fall is None or not scene.only(*effects) or len(scene.dynamic) != 1:
        return
    for joint in scene.level.joints.values():
        bob = held_by(scene, joint) if isinstance(joint, Spring) else None
        if bob is None or not isinstance(joint, Spring) or joint.length is not None:
            continue
        if joint.damping.source != 0:
            continue  # damping dissipates energy
        if all(_swings(each, joint, bob) for each in scene.everywhere):
            weight = f"{scene.mass(bob)}*{opposite(scene.fall)}"
            energy = f"{weight}*{said(scene.level.bodies[bob].position[1])}"
            beat = max(_beat(each, joint, bob) for each in scene.everywhere)
            told = check("energy", "system.energy", energy, NEAR, scale=weight)
            yield Suggestion("spring pendulum", (bob,), (told,), rate_of(STEPS * beat))


def _swings(scene: Scene, joint: Spring, bob: str) -> bool:
    """Return whether a bob is released beside its peg, with nothing within its reach.

    At a distance r from the peg, k (r - L)²/2 ≤ m g (r + h), if it starts h above the peg.
    """
    assert scene.fall is not None
    peg = place(joint.ends[1] if body_of(joint.ends[0]) else joint.ends[0], {}, scene.values)
    way = scene.where[bob].center - peg
    if not way.real or not scene.rests(bob):
        return False
    sag = -scene.fall(scene.values) / (2 * pi * _beat(scene, joint, bob)) ** 2
    far = abs(way) + sag + sqrt(sag**2 + 2 * sag * (abs(way) + way.imag))
    contact = scene.level.effects.contact is not None
    others = [name for name in scene.where if name != bob and contact]
    return all(scene.distance(bob, -way, other) > far for other in others)


def _beat(scene: Scene, joint: Spring, bob: str) -> float:
    """Return the frequency of oscillation along the spring [Hz]."""
    mass = scene.level.bodies[bob].mass
    assert mass is not None
    return sqrt(joint.stiffness(scene.values) / mass(scene.values)) / (2 * pi)
