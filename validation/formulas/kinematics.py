"""Closed forms of kinematics, from sections 3, 6 and 11 of the textbook chapter."""

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array


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
    """Return the horizontal distance of a projectile [m]: v cos θ t.

    The chapter, section 3, projectile motion; no air.
    """
    return speed * np.cos(angle) * np.asarray(t, dtype=float)


def projectile_height(speed: float, angle: float, g: float, t: ArrayLike) -> Array:
    """Return the height of a projectile above its start [m]: v sin θ t − g t² / 2.

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
    """Return the range of a projectile over level ground [m]: v² sin 2θ / g.

    The chapter, section 11; 0 ≤ θ ≤ π/2, g > 0.
    """
    return float(speed**2 * np.sin(2 * angle) / g)


def flight_time(speed: float, angle: float, g: float, height: float = 0.0) -> float:
    """Return when a projectile thrown from a height reaches zero height [s].

    The positive root of h + v sin θ t − g t² / 2 = 0; g > 0, h ≥ 0.
    """
    up = speed * np.sin(angle)
    return float((up + np.sqrt(up * up + 2 * g * height)) / g)


def uniform_position(v0: float, a: float, t: ArrayLike) -> Array:
    """Return the distance of a uniformly accelerated body [m]: v0 t + a t² / 2.

    The chapter, section 3, uniformly accelerated motion; v0 [m/s], a [m/s²] along one line.
    """
    t = np.asarray(t, dtype=float)
    return (v0 + 0.5 * a * t) * t


def uniform_velocity(v0: float, a: float, t: ArrayLike) -> Array:
    """Return the velocity of a uniformly accelerated body [m/s]: v0 + a t.

    The chapter, section 3.
    """
    return v0 + a * np.asarray(t, dtype=float)


def speed_after_way(v0: float, a: float, way: float) -> float:
    """Return the speed of a uniformly accelerated body after a distance [m/s]: √(v0² + 2 a s).

    Position and velocity of the chapter's section 3 without the time; v0² + 2 a s ≥ 0.
    """
    return float(np.sqrt(v0**2 + 2 * a * way))


def rise_time(speed: float, g: float) -> float:
    """Return the time for which a body thrown straight up rises [s]: v / g.

    From v − g t = 0, the chapter's section 3; g > 0.
    """
    return speed / g


def projectile_speed(speed: float, angle: float, g: float, t: ArrayLike) -> Array:
    """Return the speed of a projectile [m/s]: √(vx² + vy²).

    The chapter, section 3: Pythagoras over v cos θ and v sin θ − g t, written out,
    v² − 2 v g t sin θ + g² t². No air.
    """
    fall = g * np.asarray(t, dtype=float)
    return np.sqrt(speed**2 - 2 * speed * np.sin(angle) * fall + fall**2)


def centripetal_acceleration(speed: float, r: float) -> float:
    """Return the centripetal acceleration in uniform circular motion [m/s²]: v² / r.

    The chapter, section 3: turning at constant speed still requires acceleration. Differentiate
    r (cos ωt, sin ωt) twice, with ω = v / r; r > 0.
    """
    return speed**2 / r


def circular_period(speed: float, r: float) -> float:
    """Return the period of uniform circular motion [s]: 2 π r / v; r, v > 0."""
    return 2 * float(np.pi) * r / speed


def circular_position(speed: float, r: float, t: ArrayLike) -> tuple[Array, Array]:
    """Return x and y of uniform motion round the origin, counter-clockwise from (r, 0) [m]."""
    turned = np.asarray(t, dtype=float) * speed / r
    return r * np.cos(turned), r * np.sin(turned)
