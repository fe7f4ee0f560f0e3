"""Momentum, impulse and collisions: the chapter, section 7."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas.arrays import Array


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


def center_of_mass(bodies: Iterable[tuple[float, float, float]], t: ArrayLike) -> Array:
    """Return where the centre of mass of bodies on a line is [m].

    Each body is a mass [kg], a position and a velocity at the start [m, m/s]. The chapter, section
    7: without an external force Σ m v stays, whatever they do to each other, so the centre Σ m x /
    Σ m moves on at Σ m v / Σ m.
    """
    table = np.array(list(bodies), dtype=float)
    shares = table[:, 0] / table[:, 0].sum()
    return shares @ table[:, 1] + (shares @ table[:, 2]) * np.asarray(t, dtype=float)


def velocity_between_walls(speed: float, e: float, hits: int) -> float:
    """Return the velocity of a puck between two walls after so many hits [m/s]: v (−e)ⁿ.

    The wall's impulse turns the momentum round (the chapter, section 7), less what restitution
    leaves out; 0 ≤ e ≤ 1.
    """
    return speed * (-e) ** hits


def rebound_height(height: float, e: float) -> float:
    """Return how high a ball rises after a bounce from a height [m]: e² h.

    Falling and rising keep v² / 2 + g h (the chapter, section 5), the bounce scales v by e;
    0 ≤ e ≤ 1.
    """
    return e**2 * height


def rebound_speed(height: float, e: float, g: float) -> float:
    """Return the speed at which a ball that was let go from a height leaves the ground [m/s]."""
    return e * float(np.sqrt(2 * g * height))


def fall_time(height: float, g: float) -> float:
    """Return how long a ball falls [s]; g > 0."""
    return float(np.sqrt(2 * height / g))


def rebound_time(height: float, e: float, g: float) -> float:
    """Return when it is at the top after the bounce [s].

    √(2 h / g) to fall, and as long as it takes g to stop it to rise; g > 0.
    """
    return float(np.sqrt(2 * height / g)) + rebound_speed(height, e, g) / g


def half_sine_momentum(t: ArrayLike, force: float, lasts: float) -> Array:
    """Return the momentum that F sin(π t / T) has given [kg m/s]: its integral, up to T."""
    phase = np.pi * np.minimum(np.asarray(t, dtype=float), lasts) / lasts
    return np.asarray(force * lasts / np.pi * (1 - np.cos(phase)))


def swelling_push_momentum(force: float, lasts: float) -> float:
    """Return the momentum that a push F sin² (π t / T) has given when it is over [kg m/s]: F T / 2.

    The chapter, section 7, the impulse ∫ F dt: the mean of sin² over a whole swelling is 1/2.
    """
    return force * lasts / 2


def cradle_velocities(come: int, count: int, speed: float) -> Array:
    """Return the velocities of a row of equal elastic balls after so many came in [m/s].

    Each collision of two equal masses swaps their velocities (the chapter, section 7): one after
    the other they carry each incoming velocity to the far end. 0 ≤ come ≤ count.
    """
    return np.where(np.arange(count) >= count - come, speed, 0.0)


def bumper_peak_force(mass: float, speed: float, stiffness: float) -> float:
    """Return the greatest force of a spring that stops a body [N].

    All of m v² / 2 is k x² / 2 where the body stands, and the force is k x: v √(k m).
    """
    return speed * float(np.sqrt(stiffness * mass))


def bumper_time(mass: float, stiffness: float) -> float:
    """Return how long a spring that only pushes touches a body [s]: half a period, π √(m / k)."""
    return float(np.pi * np.sqrt(mass / stiffness))


def recoil_velocities(m1: float, m2: float, energy: float) -> tuple[float, float]:
    """Return the velocities of two bodies at rest that an energy has driven apart [m/s].

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
    """Return how fast two equal discs turn that met off centre and stick [rad/s]; clockwise.

    About their centre of mass the angular momentum μ v b, with μ = m1 m2 / (m1 + m2), stays (the
    chapter, section 8); each has m r² / 2 of its own, and 2 r apart they have μ (2 r)² together.
    """
    reduced = m1 * m2 / (m1 + m2)
    moment = (m1 + m2) * radius**2 / 2 + reduced * (2 * radius) ** 2
    return -reduced * speed * off / moment


def stuck_energy(m1: float, m2: float, speed: float, off: float, radius: float) -> float:
    """Return the kinetic energy of two equal discs that met off centre and stick [J].

    That of the centre of mass, and L²/2I of the turning, L = μ v b.
    """
    spin = stuck_spin(m1, m2, speed, off, radius)
    turning = m1 * m2 / (m1 + m2) * speed * off * abs(spin) / 2
    return (m1 + m2) * common_velocity(m1, m2, speed) ** 2 / 2 + turning


def ballistic_height(clay: float, block: float, speed: float, g: float) -> float:
    """Return how high a ballistic pendulum swings [m]: v'² / 2 g.

    The speed v' by momentum (the chapter, section 7), the height by energy (section 5); as long as
    it is less than that of the hook.
    """
    return common_velocity(clay, block, speed) ** 2 / (2 * g)


def ballistic_tension(clay: float, block: float, speed: float, length: float, g: float) -> float:
    """Return the tension of a ballistic pendulum's rod just after the impact [N].

    It carries the weight and turns the common velocity v' round: (m + M) (g + v'² / l).
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
    """Return when what is thrown up from 0 lands on the highest platform below its apex, how fast.

    The platforms are a metre apart. The apex is at u²/2g, and from there it falls freely to the
    whole metre below [s, m/s].
    """
    drop = u**2 / (2 * g) % 1.0
    return u / g + float(np.sqrt(2 * drop / g)), float(np.sqrt(2 * g * drop))
