"""Motion without its causes: the chapter, sections 3 and 6."""

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas.arrays import Array


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
