"""Forces and their effects: the chapter, section 4."""

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array


def incline_acceleration(angle: float, g: float, mu: float = 0.0) -> float:
    """Return the acceleration down an incline [m/s²]: g (sin θ − μ cos θ), 0 if friction holds.

    The chapter, section 4, block on an incline, with Coulomb friction −μ m g cos θ added while the
    block slides down; the coefficients of static and kinetic friction are equal.
    """
    return max(g * float(np.sin(angle) - mu * np.cos(angle)), 0.0)


def incline_normal_force(mass: float, angle: float, g: float) -> float:
    """Return the force of an incline on a block [N]: m g cos θ.

    The chapter, section 4.
    """
    return mass * g * float(np.cos(angle))


def incline_friction(mass: float, angle: float, g: float, mu: float) -> float:
    """Return the friction on a block on an incline [N]: as much as needed, at most μ N.

    Coulomb's law: m g sin θ while it holds, μ m g cos θ while it slides.
    """
    return min(mass * g * float(np.sin(angle)), mu * incline_normal_force(mass, angle, g))


def incline_point(along: ArrayLike, above: float, angle: float) -> Array:
    """Return x of a point at a distance along an incline from its foot, and above its face [m].

    A rotation of (along, above) by the angle: s cos θ − h sin θ.
    """
    return np.asarray(along, dtype=float) * np.cos(angle) - above * np.sin(angle)


def stopping_time(speed: float, mu: float, g: float) -> float:
    """Return the time in which friction stops a body that slides on flat ground [s]: v / (μ g).

    Coulomb friction μ m g is the net force, so by the chapter's section 4 the acceleration is
    −μ g; mu, g > 0.
    """
    return speed / (mu * g)


def stopping_distance(speed: float, mu: float, g: float) -> float:
    """Return the distance in which friction stops a body on flat ground [m]: v² / (2 μ g).

    The mean speed v / 2 over the stopping time; mu, g > 0.
    """
    return speed / 2 * stopping_time(speed, mu, g)


def sliding_way(speed: float, mu: float, g: float, t: ArrayLike) -> Array:
    """Return the distance that a body has slid on flat ground, also after it has stopped [m].

    v t − μ g t² / 2, and the stopping distance after the stopping time; mu, g > 0.
    """
    slides = np.minimum(np.asarray(t, dtype=float), stopping_time(speed, mu, g))
    return slides * (speed - 0.5 * mu * g * slides)


def incline_height(along: ArrayLike, above: float, angle: float) -> Array:
    """Return y of a point at a distance along an incline from its foot, and above its face [m].

    A rotation of (along, above) by the angle: s sin θ + h cos θ.
    """
    return np.asarray(along, dtype=float) * np.sin(angle) + above * np.cos(angle)


def acceleration(force: float, mass: float) -> float:
    """Return the acceleration of a body under a force [m/s²]: F / m.

    The chapter, section 4, the second law with constant mass.
    """
    return force / mass


def resultant(*forces: tuple[float, float]) -> tuple[float, float]:
    """Return the sum of forces [N]."""
    return sum(x for x, _ in forces), sum(y for _, y in forces)


def terminal_velocity(mass: float, drag: float, g: float) -> float:
    """Return the speed at which quadratic drag balances the weight [m/s]: √(m g / c)."""
    return float(np.sqrt(mass * g / drag))


def fall_velocity(t: ArrayLike, mass: float, drag: float, g: float) -> Array:
    """Return the velocity of a fall from rest with quadratic drag [m/s]; downwards negative.

    dv/dt = −g + (c/m) v² gives −vt tanh(g t / vt).
    """
    end = terminal_velocity(mass, drag, g)
    return np.asarray(-end * np.tanh(g * np.asarray(t, dtype=float) / end))


def throw_with_drag(
    t: ArrayLike, velocity: float, mass: float, drag: float, g: float = 0.0
) -> Array:
    """Return the distance of a throw with linear drag along one axis [m].

    dv/dt = −g − v/τ with τ = m/c gives (v0 + g τ) τ (1 − e^(−t/τ)) − g τ t.
    """
    t, tau = np.asarray(t, dtype=float), mass / drag
    return np.asarray((velocity + g * tau) * tau * -np.expm1(-t / tau) - g * tau * t)


def break_loose_time(limit: float, growth: float) -> float:
    """Return when a pull that grows from zero, F = k t, overcomes static friction [s]: μs N / k.

    Coulomb's law with a static coefficient; `limit` is μs N [N], `growth` is k [N/s].
    """
    return limit / growth


def pulled_loose(
    static: float, kinetic: float, mass: float, growth: float, t: ArrayLike
) -> tuple[Array, Array]:
    """Return the distance and velocity of a block that such a pull moves [m, m/s].

    With the time τ since it broke loose, m dv/dt = μs N + k τ − μk N; both are 0 before. The limits
    μs N and μk N are in N.
    """
    tau = np.maximum(np.asarray(t, dtype=float) - break_loose_time(static, growth), 0.0)
    jerk, jump = growth / mass, (static - kinetic) / mass
    return jump * tau**2 / 2 + jerk * tau**3 / 6, jump * tau + jerk * tau**2 / 2


def sticking_acceleration(angle: float, g: float, static: float, kinetic: float) -> float:
    """Return the acceleration down an incline from rest [m/s²].

    0 up to tan θ = μs, g (sin θ − μk cos θ) beyond it.
    """
    return 0.0 if np.tan(angle) <= static else incline_acceleration(angle, g, kinetic)


def sticking_friction(mass: float, angle: float, g: float, static: float, kinetic: float) -> float:
    """Return the friction on a block on an incline that was at rest [N].

    m g sin θ up to tan θ = μs, and μk m g cos θ beyond it.
    """
    if np.tan(angle) <= static:
        return mass * g * float(np.sin(angle))
    return kinetic * incline_normal_force(mass, angle, g)


def rocket_velocity(exhaust: float, mass: ArrayLike, start: float) -> Array:
    """Return the velocity that a rocket has gained since its mass was `start` [m/s]: u ln(m0/m).

    Tsiolkovsky's equation, from m dv = −u dm; `exhaust` is u [m/s], the masses are in kg.
    """
    return exhaust * np.log(start / np.asarray(mass, dtype=float))


def rocket_way(exhaust: float, rate: float, start: float, t: ArrayLike) -> Array:
    """Return the distance of a rocket that started at rest with mass `start` [m].

    The integral of Tsiolkovsky's equation: u t − (u/μ) (m0 − μ t) ln(m0 / (m0 − μ t)), while it
    burns at μ, `rate` [kg/s].
    """
    t = np.asarray(t, dtype=float)
    mass = start - rate * t
    return exhaust * t - exhaust / rate * mass * np.log(start / mass)


def lift_off(exhaust: float, rate: float, start: float, g: float) -> float:
    """Return when the weight of a rocket that burns on its pad equals its thrust [s].

    μ u = (m0 − μ t) g; 0 if it is lower from the start.
    """
    return max(start / rate - exhaust / g, 0.0)


def pad_force(exhaust: float, rate: float, start: float, g: float) -> float:
    """Return the force of a rocket's pad at ignition [N]: m0 g − μ u, or 0."""
    return max(start * g - rate * exhaust, 0.0)


def launch_velocity(exhaust: float, rate: float, start: float, g: float, t: ArrayLike) -> Array:
    """Return the velocity of a rocket that stands on its pad until it lifts off [m/s]."""
    away = lift_off(exhaust, rate, start, g)
    later = np.maximum(np.asarray(t, dtype=float), away)
    gained = rocket_velocity(exhaust, start - rate * later, start - rate * away)
    return gained - g * (later - away)


def filling_cart(
    force: float, rate: float, start: float, speed: float, t: ArrayLike
) -> tuple[Array, Array]:
    """Return the mass and velocity of a cart that matter falls into from above [kg, m/s].

    By momentum, p = m0 v0 + F t, since the matter has none along the rail; `rate` is dm/dt [kg/s].
    """
    t = np.asarray(t, dtype=float)
    mass = start + rate * t
    return mass, (start * speed + force * t) / mass


def carried_way(speed: float, mu: float, g: float, t: ArrayLike) -> Array:
    """Return the distance that a belt has carried a block put on it at rest [m].

    Friction accelerates it by μ g until it has the belt's speed v, after the time v/μg; from then
    on it is v²/2μg behind the belt.
    """
    t = np.asarray(t, dtype=float)
    driven = np.minimum(t, speed / (mu * g))
    return mu * g * driven**2 / 2 + speed * (t - driven)


def belt_momentum(speed: float, rate: float, t: float) -> float:
    """Return the momentum that a belt has given to matter that falls on it at a rate [kg m/s].

    F t = v (dm/dt) t: the chapter, section 4, when mass isn't constant; `rate` is dm/dt [kg/s].
    """
    return speed * rate * t


def gyration_rate(mass: float, charge: float, field: float) -> float:
    """Return the rate at which a magnetic field rotates a velocity [rad/s]: −q B / m.

    F = q v × B with B [T] out of the plane (J. D. Jackson, Classical Electrodynamics, 12.2), for
    speeds far below that of light.
    """
    return -charge * field / mass


def gyration_radius(mass: float, charge: float, field: float, speed: float) -> float:
    """Return the radius of the circle of a charge in a magnetic field [m]: m v / |q B|.

    From m v² / r = |q| v B; Jackson, 12.2.
    """
    return speed / abs(gyration_rate(mass, charge, field))


def gyration_period(mass: float, charge: float, field: float) -> float:
    """Return the period of a charge in a magnetic field [s]: 2 π m / |q B|.

    Circumference over speed, whatever the speed.
    """
    return 2 * np.pi / abs(gyration_rate(mass, charge, field))


def gravity_drift(mass: float, charge: float, field: float, g: float, t: ArrayLike) -> Array:
    """Return x, y of a charge released at rest in a magnetic field and gravity [m]: (2, ...).

    It drifts with F × B / (q B²) (Jackson, 12.3), −m g / (q B) for B out of the plane, and in the
    drifting frame it circles at that speed: the cycloid of a point on a rolling rim.
    """
    turned = gyration_rate(mass, charge, field) * np.asarray(t, dtype=float)
    rolling = g / gyration_rate(mass, charge, field) ** 2
    return np.array([rolling * (turned - np.sin(turned)), -rolling * (1 - np.cos(turned))])


def blown_way(mass: float, drag: float, wind: float, t: ArrayLike) -> Array:
    """Return the distance that a wind has carried a body from rest, with a drag c (w − v) [m].

    m dv/dt = c (w − v): w t − w τ (1 − e^(−t/τ)) with τ = m / c; c > 0.
    """
    time, settling = np.asarray(t, dtype=float), mass / drag
    return np.asarray(wind * (time + settling * np.expm1(-time / settling)))


def bobbing_rate(mass: float, density: float, width: float, g: float) -> float:
    """Return the angular frequency of a box that bobs upright in a liquid [rad/s]: √(ρ g w / m).

    Archimedes: for each metre deeper it displaces w more of a liquid of density ρ [kg/m²].
    """
    return float(np.sqrt(density * g * width / mass))
