"""The closed forms: pure functions of SI quantities, written from the textbook.

They are independent of the formulas in the levels, so that the two hold each other, and they import
nothing of the sandbox. Angles are in radians. "The chapter" is the document that the project
follows; its section stands with each formula, and a line of derivation where it gives none.
Every formula holds for any finite argument unless it says otherwise.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def free_fall_height(height: float, g: float, t: ArrayLike) -> Array:
    """Return the height of a body let go from rest [m]: h − g t² / 2.

    The chapter, section 3, uniform acceleration in one dimension.
    """
    t = np.asarray(t, dtype=float)
    return height - 0.5 * g * t * t


def free_fall_velocity(g: float, t: ArrayLike) -> Array:
    """Return the upward velocity of a body let go from rest [m/s]: −g t.

    The chapter, section 3.
    """
    return -g * np.asarray(t, dtype=float)


def projectile_distance(speed: float, angle: float, t: ArrayLike) -> Array:
    """Return how far a projectile has come across [m]: v cos θ t.

    The chapter, section 3, projectile motion; no air.
    """
    return speed * np.cos(angle) * np.asarray(t, dtype=float)


def projectile_height(speed: float, angle: float, g: float, t: ArrayLike) -> Array:
    """Return how high a projectile is above where it was thrown [m]: v sin θ t − g t² / 2.

    The chapter, section 3, projectile motion; no air.
    """
    t = np.asarray(t, dtype=float)
    return speed * np.sin(angle) * t - 0.5 * g * t * t


def projectile_apex(speed: float, angle: float, g: float) -> float:
    """Return the greatest height of a projectile [m]: v² sin² θ / (2 g).

    The chapter, section 6; 0 ≤ θ ≤ π/2, g > 0.
    """
    return float((speed * np.sin(angle)) ** 2 / (2 * g))


def projectile_range(speed: float, angle: float, g: float) -> float:
    """Return how far a projectile flies over level ground [m]: v² sin 2θ / g.

    The chapter, section 11; 0 ≤ θ ≤ π/2, g > 0.
    """
    return float(speed**2 * np.sin(2 * angle) / g)


def flight_time(speed: float, angle: float, g: float, height: float = 0.0) -> float:
    """Return when a projectile thrown from a height comes down to zero [s].

    The positive root of h + v sin θ t − g t² / 2 = 0; g > 0, h ≥ 0.
    """
    up = speed * np.sin(angle)
    return float((up + np.sqrt(up * up + 2 * g * height)) / g)


def landing_speed(speed: float, g: float, height: float) -> float:
    """Return the speed after falling a height, whatever the direction of the throw [m/s].

    The chapter, section 5, conservation of energy: v² + 2 g h.
    """
    return float(np.sqrt(speed**2 + 2 * g * height))


def atwood_acceleration(m1: float, m2: float, g: float) -> float:
    """Return the upward acceleration of the first mass [m/s²]: (m2 − m1) g / (m1 + m2).

    The chapter, section 4, the Atwood machine; light string, light and frictionless pulley.
    """
    return (m2 - m1) / (m1 + m2) * g


def atwood_tension(m1: float, m2: float, g: float) -> float:
    """Return the tension of an Atwood machine's string [N]: 2 m1 m2 g / (m1 + m2).

    From T − m1 g = m1 a, with a as the chapter has it.
    """
    return m1 * (g + atwood_acceleration(m1, m2, g))


def incline_acceleration(angle: float, g: float, mu: float = 0.0) -> float:
    """Return the acceleration down an incline [m/s²]: g (sin θ − μ cos θ), 0 where friction holds.

    The chapter, section 4, block on an incline, with Coulomb friction −μ m g cos θ added while the
    block slides down; one coefficient for rest and motion.
    """
    return max(g * float(np.sin(angle) - mu * np.cos(angle)), 0.0)


def incline_normal_force(mass: float, angle: float, g: float) -> float:
    """Return the force of an incline on a block [N]: m g cos θ.

    The chapter, section 4.
    """
    return mass * g * float(np.cos(angle))


def incline_friction(mass: float, angle: float, g: float, mu: float) -> float:
    """Return the friction on a block on an incline [N]: what is needed, at most μ N.

    Coulomb's law: m g sin θ while it holds, μ m g cos θ while it slides.
    """
    return min(mass * g * float(np.sin(angle)), mu * incline_normal_force(mass, angle, g))


def incline_point(along: ArrayLike, above: float, angle: float) -> Array:
    """Return x of a point along an incline from its foot and above its face [m].

    A rotation of (along, above) by the angle: s cos θ − h sin θ.
    """
    return np.asarray(along, dtype=float) * np.cos(angle) - above * np.sin(angle)


def table_pulley_acceleration(m1: float, m2: float, g: float, mu: float = 0.0) -> float:
    """Return the acceleration of a block drawn over a table by a weight [m/s²].

    m2 g − T = m2 a and T − μ m1 g = m1 a give (m2 − μ m1) g / (m1 + m2); 0 where friction holds.
    """
    return max((m2 - mu * m1) / (m1 + m2) * g, 0.0)


def table_pulley_tension(m1: float, m2: float, g: float, mu: float = 0.0) -> float:
    """Return the tension between a block on a table and its weight [N]: m2 (g − a)."""
    return m2 * (g - table_pulley_acceleration(m1, m2, g, mu))


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


def kinetic_energy(*bodies: tuple[float, float]) -> float:
    """Return the kinetic energy of bodies, each a mass [kg] and a speed [m/s], in joules.

    The chapter, section 5: Σ m v² / 2.
    """
    return sum(0.5 * mass * speed**2 for mass, speed in bodies)


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


def circular_orbit_speed(mu: float, r: float) -> float:
    """Return the speed of a circular orbit [m/s]: √(μ / r).

    From v² / r = μ / r², the well of the chapter's section 5; mu, r > 0.
    """
    return float(np.sqrt(mu / r))


def circular_orbit_energy(mu: float, r: float, mass: float = 1.0) -> float:
    """Return kinetic and potential energy of a circular orbit together [J]: −μ m / (2 r)."""
    return kinetic_energy((mass, circular_orbit_speed(mu, r))) - mu * mass / r
