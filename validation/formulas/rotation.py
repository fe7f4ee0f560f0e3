"""Rotation, and rolling: the chapter, section 8.

The shape of a round body enters as I / (m r²), the "factor": 1 for a hoop, 1/2 for a disc, 2/5 for
a sphere, 2/3 for a hollow sphere, and 0 for a body that slides without friction.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.formulas import Array, oscillators
from validation.formulas.oscillators import pendulum_period

HOOP = 1.0
DISC = 1 / 2
SPHERE = 2 / 5
HOLLOW_SPHERE = 2 / 3
SLIDING = 0.0


def box_moment(mass: float, width: float, height: float) -> float:
    """Return the moment of inertia of a box about its centre [kg m²]: m (w² + h²) / 12.

    ∫ (x² + y²) dm: the chapter's thin rod, section 8, once along each side.
    """
    return mass * width**2 / 12 + mass * height**2 / 12


def rotational_energy(moment: float, angular_velocity: float) -> float:
    """Return the energy of rotation [J]: I ω² / 2.

    The chapter, section 8.
    """
    return moment * angular_velocity**2 / 2


def rolls(factor: float, angle: float, mu: float) -> bool:
    """Return whether a round body that starts from rest rolls down an incline without slipping.

    The friction that rolling needs, m g sin θ k / (1 + k), must not exceed μ m g cos θ.
    """
    return bool(np.tan(angle) * factor / (1 + factor) <= mu)


def rolling_acceleration(factor: float, angle: float, g: float, mu: float) -> float:
    """Return the acceleration of a round body down an incline, from rest [m/s²].

    Rolling: m g h = m v² (1 + k) / 2 with v² = 2 a h / sin θ (the chapter, sections 5 and 8), so
    a = g sin θ / (1 + k). Slipping: as for a block. 0 ≤ θ < π/2.
    """
    if rolls(factor, angle, mu):
        return g * float(np.sin(angle)) / (1 + factor)
    return g * float(np.sin(angle) - mu * np.cos(angle))


def rolling_friction(factor: float, mass: float, angle: float, g: float, mu: float) -> float:
    """Return the friction on a round body on an incline [N].

    m g sin θ − m a: Newton's second law along the incline.
    """
    return mass * (g * float(np.sin(angle)) - rolling_acceleration(factor, angle, g, mu))


def rolling_spin(factor: float, r: float, angle: float, g: float, mu: float) -> float:
    """Return the angular acceleration of a round body down an incline [rad/s²].

    The chapter, section 8: torque r f over the moment k m r²; a / r where it rolls; factor, r > 0.
    """
    return rolling_friction(factor, 1.0, angle, g, mu) / (factor * r)


def race_time(factor: float, way: float, angle: float, g: float) -> float:
    """Return the time for a body to roll a distance down an incline from rest [s].

    √(2 s / a) with the acceleration of rolling; 0 < θ < π/2, g, s > 0.
    """
    return float(np.sqrt(2 * way * (1 + factor) / (g * np.sin(angle))))


def rolling_period(factor: float, length: float, g: float, amplitude: float) -> float:
    """Return the period of a round body that rolls to and fro in a hollow [s].

    Its centre swings at the distance l from the hollow's centre, and its rotation adds k to the
    inertia: it moves as a pendulum of the length (1 + k) l; 0 < amplitude < π, g > 0.
    """
    return pendulum_period((1 + factor) * length, g, amplitude)


def cycloid_height(factor: float, radius: float, g: float, start: float, t: ArrayLike) -> Array:
    """Return the height above its lowest point of a body whose centre rolls on a cycloid [m].

    With the arc length s of the centre, m (1 + k) s'² / 2 + m g s² / (8 R) is conserved: Huygens'
    bead under the gravity g / (1 + k). So s = 4 R sin(θ/2) cos(ωt), ω² = g / (4 (1 + k) R), for any
    start θ [rad] in x = R (θ + sin θ), y = R (1 − cos θ). k = 0 is sliding; R, g > 0, |θ| < π.
    """
    return oscillators.cycloid_height(t, radius, g / (1 + factor), start)


def cycloid_quarter(factor: float, radius: float, g: float) -> float:
    """Return the time until the lowest point [s]: π √((1 + k) R / g), from any start."""
    return oscillators.cycloid_time(radius, g / (1 + factor))


def trough_speed(factor: float, length: float, g: float, amplitude: float) -> float:
    """Return the speed at the hollow's lowest point [m/s]: m g l (1 − cos θ) = (1 + k) m v² / 2."""
    return float(np.sqrt(2 * g * length * (1 - np.cos(amplitude)) / (1 + factor)))


def rolling_speed(factor: float, speed: float) -> float:
    """Return the final rolling speed of a body that starts without spin [m/s].

    Friction has no torque about a point of the ground, so m r v + k m r² ω is conserved (the
    chapter, section 8); with v = r ω at the end it is v0 / (1 + k): 2/3 for a disc, 1/2 for a hoop.
    """
    return speed / (1 + factor)


def sliding_time(factor: float, speed: float, mu: float, g: float) -> float:
    """Return when a body that starts without spin begins to roll [s].

    Friction reduces the speed by v0 − v0 / (1 + k) at the rate μ g: v0 k / ((1 + k) μ g), which is
    v0 / (3 μ g) for a disc; mu, g > 0.
    """
    return (speed - rolling_speed(factor, speed)) / (mu * g)


def slide_and_roll_way(factor: float, speed: float, mu: float, g: float, t: ArrayLike) -> Array:
    """Return the distance of a body that starts without spin [m].

    v0 t − μ g t² / 2 until it rolls, then at the rolling speed; mu, g > 0.
    """
    t = np.asarray(t, dtype=float)
    slides = np.minimum(t, sliding_time(factor, speed, mu, g))
    return slides * (speed - mu * g * slides / 2) + (t - slides) * rolling_speed(factor, speed)


def round_moment(factor: float, mass: float, r: float) -> float:
    """Return the moment of inertia of a round body about its centre [kg m²]: k m r².

    The chapter, section 8, its table.
    """
    return factor * mass * r**2


def rod_moment(mass: float, length: float, off: float = 0.0) -> float:
    """Return the moment of inertia of a thin rod about a point of it [kg m²].

    ∫ x² dm from d − L/2 to d + L/2, where d is the distance of the point from the centre;
    m L² / 12 + m d² by the parallel-axis theorem of the chapter's section 8. L > 0.
    """
    return mass * ((off + length / 2) ** 3 - (off - length / 2) ** 3) / (3 * length)


def torque(arm: complex, force: complex) -> float:
    """Return the torque of a force on an arm [N m], both as x + iy [m, N].

    The chapter, section 8: the cross product r × F = |r| |F| sin φ.
    """
    return (arm.conjugate() * force).imag


def rim_acceleration(radius: float, rate: ArrayLike, growth: float) -> NDArray[np.complex128]:
    """Return the acceleration of a point that circles an axis [m/s²], as radial + i tangential.

    −ω² r towards the axis and α r along the path; `growth` is α [rad/s²].
    """
    return np.asarray(radius * (-np.square(rate) + 1j * growth))


def spun_angle(torque: float, moment: float, t: ArrayLike) -> Array:
    """Return the angle that a constant torque turns a body through, from rest [rad]: τ t² / (2 I).

    The chapter, section 8: τ = I α; I > 0.
    """
    return torque / moment * np.asarray(t, dtype=float) ** 2 / 2


def yo_yo_acceleration(axle: float, radius: float, g: float) -> float:
    """Return the downward acceleration of a disc on a string wound on its axle [m/s²].

    m g − T = m a and T r = I a / r with I = m R² / 2 (the chapter, section 8), so that
    a = g / (1 + I / (m r²)).
    """
    return g / (1 + disc_moment(1.0, radius) / axle**2)


def disc_moment(mass: float, radius: float, distance: float = 0.0) -> float:
    """Return the moment of inertia of a disc about an axis at a distance from its centre [kg m²].

    m R² / 2 + m d²: the chapter's table and the parallel-axis theorem, section 8.
    """
    return round_moment(DISC, mass, radius) + mass * distance**2


def driven_by_weight(mass: float, radius: float, moment: float, g: float) -> float:
    """Return the angular acceleration of a drum driven by a weight on a string [rad/s²].

    m g − T = m α r and T r = I α: m g r / (I + m r²).
    """
    return mass * g * radius / (moment + mass * radius**2)


def limited_drive(moment: float, most: float, rate: float, hold: float, t: ArrayLike) -> Array:
    """Return the angular velocity of a flywheel that a motor accelerates from rest [rad/s].

    I dω/dt = min(T, K (Ω − ω)). It is T t / I until Ω − ω has fallen to T / K. From then on Ω − ω
    falls as e^(−K t / I). K > T / Ω.
    """
    time, settling = np.asarray(t, dtype=float), moment / hold
    full = moment * rate / most - settling
    eased = rate - most / hold * np.exp(-np.maximum(time - full, 0.0) / settling)
    return np.where(time < full, most * time / moment, eased)
