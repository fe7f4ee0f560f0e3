"""Momentum, impulse and collisions: the chapter, section 7."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array


def collision_velocities(
    m1: float, m2: float, v1: float, v2: float, restitution: float = 1.0
) -> tuple[float, float]:
    """Return both velocities after a collision on a line [m/s].

    The velocity of the centre of mass is unchanged, the relative velocity is reversed and scaled by
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

    The angle is between the first disc's velocity and the line from its centre to that of the
    second, which is at rest. Along that line equal masses swap velocities (the chapter, section 7);
    perpendicular to it nothing changes. 0 ≤ angle < π/2.
    """
    c, s = float(np.cos(angle)), float(np.sin(angle))
    along = speed * c
    second = (along * c, along * s)
    return (speed - second[0], -second[1]), second


def center_of_mass(bodies: Iterable[tuple[float, float, float]], t: ArrayLike) -> Array:
    """Return the position of the centre of mass of bodies on a line [m].

    Each body has a mass [kg], an initial position and velocity [m, m/s]. The chapter, section 7:
    without an external force Σ m v is conserved, whatever the interactions, so the centre Σ m x / Σ
    m moves at Σ m v / Σ m.
    """
    table = np.array(list(bodies), dtype=float)
    shares = table[:, 0] / table[:, 0].sum()
    return shares @ table[:, 1] + (shares @ table[:, 2]) * np.asarray(t, dtype=float)


def velocity_between_walls(speed: float, e: float, hits: int) -> float:
    """Return the velocity of a puck between two walls after a number of hits [m/s]: v (−e)ⁿ.

    Each wall's impulse reverses the momentum (the chapter, section 7), scaled by the restitution;
    0 ≤ e ≤ 1.
    """
    return speed * (-e) ** hits


def rebound_height(height: float, e: float) -> float:
    """Return the height of a ball's rebound after falling from a height [m]: e² h.

    Falling and rising keep v² / 2 + g h (the chapter, section 5), the bounce scales v by e;
    0 ≤ e ≤ 1.
    """
    return e**2 * height


def rebound_speed(height: float, e: float, g: float) -> float:
    """Return the speed at which a ball leaves the ground after falling from a height [m/s]."""
    return e * float(np.sqrt(2 * g * height))


def fall_time(height: float, g: float) -> float:
    """Return the time of a fall [s]; g > 0."""
    return float(np.sqrt(2 * height / g))


def rebound_time(height: float, e: float, g: float) -> float:
    """Return when the ball is at the apex of its rebound [s].

    √(2 h / g) for the fall, and the rebound speed over g for the rise; g > 0.
    """
    return float(np.sqrt(2 * height / g)) + rebound_speed(height, e, g) / g


def half_sine_momentum(t: ArrayLike, force: float, lasts: float) -> Array:
    """Return the momentum from a force F sin(π t / T) [kg m/s]: its integral, up to T."""
    phase = np.pi * np.minimum(np.asarray(t, dtype=float), lasts) / lasts
    return np.asarray(force * lasts / np.pi * (1 - np.cos(phase)))


def swelling_push_momentum(force: float, lasts: float) -> float:
    """Return the momentum from a whole pulse of force F sin² (π t / T) [kg m/s]: F T / 2.

    The chapter, section 7, the impulse ∫ F dt: the mean of sin² over the pulse is 1/2.
    """
    return force * lasts / 2


def cradle_velocities(come: int, count: int, speed: float) -> Array:
    """Return the velocities in a row of equal elastic balls after a number came in [m/s].

    Each collision of two equal masses swaps their velocities (the chapter, section 7); one after
    the other, they pass each incoming velocity to the far end. 0 ≤ come ≤ count.
    """
    return np.where(np.arange(count) >= count - come, speed, 0.0)


def bumper_peak_force(mass: float, speed: float, stiffness: float) -> float:
    """Return the greatest force of a spring that stops a body [N].

    All of m v² / 2 becomes k x² / 2 at the turning point, and the force is k x: v √(k m).
    """
    return speed * float(np.sqrt(stiffness * mass))


def bumper_time(mass: float, stiffness: float) -> float:
    """Return the contact time with a spring that only pushes [s]: half a period, π √(m / k)."""
    return float(np.pi * np.sqrt(mass / stiffness))


def recoil_velocities(m1: float, m2: float, energy: float) -> tuple[float, float]:
    """Return the velocities of two bodies, initially at rest, after an energy release [m/s].

    Both get the same momentum p (the chapter, section 7), and p² / 2 m1 + p² / 2 m2 is the energy.
    """
    p = float(np.sqrt(2 * energy * m1 * m2 / (m1 + m2)))
    return -p / m1, p / m2


def common_velocity(m1: float, m2: float, v1: float, v2: float = 0.0) -> float:
    """Return the velocity of two bodies that stick together [m/s]: (m1 v1 + m2 v2) / (m1 + m2).

    The chapter, section 7, the perfectly inelastic collision.
    """
    return (m1 * v1 + m2 * v2) / (m1 + m2)


def stuck_spin(m1: float, m2: float, speed: float, off: float, radius: float) -> float:
    """Return the clockwise spin of two equal discs that meet off centre and stick [rad/s].

    The angular momentum μ v b about their centre of mass is conserved, with μ = m1 m2 / (m1 + m2)
    (the chapter, section 8); each disc has a moment of m r² / 2, and at a distance of 2 r they add
    μ (2 r)².
    """
    reduced = m1 * m2 / (m1 + m2)
    moment = (m1 + m2) * radius**2 / 2 + reduced * (2 * radius) ** 2
    return -reduced * speed * off / moment


def stuck_energy(m1: float, m2: float, speed: float, off: float, radius: float) -> float:
    """Return the kinetic energy of two equal discs that meet off centre and stick [J].

    The energy of the centre of mass, and L²/2I of the rotation, L = μ v b.
    """
    spin = stuck_spin(m1, m2, speed, off, radius)
    turning = m1 * m2 / (m1 + m2) * speed * off * abs(spin) / 2
    return (m1 + m2) * common_velocity(m1, m2, speed) ** 2 / 2 + turning


def ballistic_height(clay: float, block: float, speed: float, g: float) -> float:
    """Return the height that a ballistic pendulum reaches [m]: v'² / 2 g.

    The speed v' by momentum (the chapter, section 7), the height by energy (section 5); it must be
    below the hook.
    """
    return common_velocity(clay, block, speed) ** 2 / (2 * g)


def ballistic_tension(clay: float, block: float, speed: float, length: float, g: float) -> float:
    """Return the tension of a ballistic pendulum's rod just after the impact [N].

    It carries the weight and curves the path at the common velocity v': (m + M) (g + v'² / l).
    """
    return (clay + block) * (g + common_velocity(clay, block, speed) ** 2 / length)


def ballistic_velocity(
    clay: float, block: float, speed: float, length: float, g: float, t: float
) -> float:
    """Return the horizontal velocity of a ballistic pendulum shortly after the impact [m/s].

    At the angle φ = v' t / L it is v cos φ, with v² = v'² − 2 g L (1 − cos φ): to second order
    v' (1 − (g / L + v'² / L²) t² / 2).
    """
    v = common_velocity(clay, block, speed)
    return v * (1 - (g / length + v**2 / length**2) * t**2 / 2)


def platform_landing(u: float, g: float) -> tuple[float, float]:
    """Return the time and speed of landing on the highest platform below the apex [s, m/s].

    The throw starts upwards from 0; the platforms are a metre apart. The apex is at u²/2g, from
    which the body falls to the whole metre below.
    """
    drop = u**2 / (2 * g) % 1.0
    return u / g + float(np.sqrt(2 * drop / g)), float(np.sqrt(2 * g * drop))
