"""Work, energy and potential wells: the chapter, section 5."""

import numpy as np


def landing_speed(speed: float, g: float, height: float) -> float:
    """Return the speed after falling a height, whatever the direction of the throw [m/s].

    The chapter, section 5, conservation of energy: v² + 2 g h.
    """
    return float(np.sqrt(speed**2 + 2 * g * height))


def kinetic_energy(*bodies: tuple[float, float]) -> float:
    """Return the kinetic energy of bodies, each a mass [kg] and a speed [m/s], in joules.

    The chapter, section 5: Σ m v² / 2.
    """
    return sum(0.5 * mass * speed**2 for mass, speed in bodies)


def circular_orbit_speed(mu: float, r: float) -> float:
    """Return the speed of a circular orbit [m/s]: √(μ / r).

    From v² / r = μ / r², the well of the chapter's section 5; mu, r > 0.
    """
    return float(np.sqrt(mu / r))


def circular_orbit_energy(mu: float, r: float, mass: float = 1.0) -> float:
    """Return kinetic and potential energy of a circular orbit together [J]: −μ m / (2 r)."""
    return kinetic_energy((mass, circular_orbit_speed(mu, r))) - mu * mass / r
