"""Momentum, impulse and collisions: the chapter, section 7."""

import numpy as np


def collision_velocities(
    m1: float, m2: float, v1: float, v2: float, restitution: float = 1.0
) -> tuple[float, float]:
    """Return both velocities after a collision on a line [m/s].

    The velocity of the centre of mass stays, the relative velocity is turned round and scaled by
    the restitution. The chapter, section 7, has the cases of 1 (elastic) and 0 (perfectly
    inelastic); v1 > v2.
    """
    center = (m1 * v1 + m2 * v2) / (m1 + m2)
    parting = restitution * (v1 - v2) / (m1 + m2)
    return center - m2 * parting, center + m1 * parting


def glancing_velocities(
    speed: float, angle: float
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the velocities of two equal smooth discs after an elastic glancing collision [m/s].

    The line from the first disc's centre to that of the second, at rest, makes the angle with the
    first one's velocity. Along that line equal masses swap velocities (the chapter, section 7);
    across it nothing changes. 0 ≤ angle < π/2.
    """
    c, s = float(np.cos(angle)), float(np.sin(angle))
    along = speed * c
    second = (along * c, along * s)
    return (speed - second[0], -second[1]), second
