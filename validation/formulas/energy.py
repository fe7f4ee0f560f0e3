"""Work, energy and potential wells: the chapter, section 5."""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array
from validation.formulas.runge_kutta import solution

Curve = Callable[[Array], Array]
"""A coordinate of a curve, of its parameter [m]."""


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
    """Return the sum of kinetic and potential energy of a circular orbit [J]: −μ m / (2 r)."""
    return kinetic_energy((mass, circular_orbit_speed(mu, r))) - mu * mass / r


def work_distance(mass: float, speed: float, force: float) -> float:
    """Return the distance in which a constant force stops a body [m]: m v² / (2 F).

    The chapter, section 5, the work-energy theorem: −F s is the change of kinetic energy; F > 0.
    """
    return kinetic_energy((mass, speed)) / force


def ramp_time(height: float, angle: float, g: float) -> float:
    """Return the time for a body to slide from rest down a straight smooth ramp [s].

    The length h / sin θ at the mean of the speeds 0 and √(2 g h), which the chapter's section 5
    gives; 0 < θ ≤ π/2, g, h > 0.
    """
    return 2 * height / float(np.sin(angle)) / landing_speed(0.0, g, height)


def kepler_period(a: float, mu: float) -> float:
    """Return the period of an orbit with the semi-major axis a [s]: 2 π √(a³ / μ).

    Kepler's third law in the well of the chapter's section 5: the areal velocity is half the
    angular momentum, √(μ a (1 − e²)) / 2, and the area π a² √(1 − e²); a, mu > 0.
    """
    return 2 * float(np.pi * np.sqrt(a**3 / mu))


def kepler_energy(a: float, mu: float) -> float:
    """Return the energy per kilogram of an orbit with the semi-major axis a [J]: −μ / (2 a).

    v² / 2 − μ / r at perihelion, with the speed that `apsis_speed` gives there.
    """
    return -mu / (2 * a)


def apsis_speed(near: float, far: float, mu: float) -> float:
    """Return the speed at the near end of an orbit, or at the far end if both are swapped [m/s].

    Energy v² / 2 − μ / r and angular momentum r v are the same at both ends (the chapter, sections
    5 and 8): v² = 2 μ far / (near (near + far)); all > 0.
    """
    return float(np.sqrt(2 * mu * far / (near * (near + far))))


def kepler_place(near: float, e: float, mu: float, t: ArrayLike) -> tuple[Array, Array]:
    """Return x and y on an ellipse about the origin, starting at the perihelion (near, 0) [m].

    Kepler's equation M = E − e sin E, with the mean anomaly M, solved by Newton's method;
    x = a (cos E − e), y = a √(1 − e²) sin E. 0 ≤ e < 0.9, counter-clockwise.
    """
    a = near / (1 - e)
    mean = 2 * np.pi * np.asarray(t, dtype=float) / kepler_period(a, mu)
    anomaly = mean + e * np.sin(mean)
    for _ in range(20):
        anomaly = anomaly - (anomaly - e * np.sin(anomaly) - mean) / (1 - e * np.cos(anomaly))
    return a * (np.cos(anomaly) - e), a * np.sqrt(1 - e * e) * np.sin(anomaly)


def escape_speed(mu: float, r: ArrayLike) -> Array:
    """Return the least speed at a distance with which a body never returns [m/s]: √(2 μ / r).

    v² / 2 − μ / r = 0, the chapter's section 5; mu, r > 0.
    """
    return np.sqrt(2 * mu / np.asarray(r, dtype=float))


def escape_distance(r: float, mu: float, t: ArrayLike) -> Array:
    """Return the distance of a body that left a distance r radially at escape speed [m].

    dr / dt = √(2 μ / r) separates: r^(3/2) grows at the rate (3/2) √(2 μ); mu, r > 0.
    """
    t = np.asarray(t, dtype=float)
    return np.cbrt((r * np.sqrt(r) + 1.5 * np.sqrt(2 * mu) * t) ** 2)


def turning_distance(r: float, share: float) -> float:
    """Return the greatest distance of a body that leaves radially with a share of escape speed [m].

    −(1 − f²) μ / r = −μ / R, the chapter's section 5: R = r / (1 − f²); 0 ≤ f < 1.
    """
    return r / (1 - share**2)


def turning_time(r: float, share: float, mu: float) -> float:
    """Return the time until then [s].

    A straight orbit is an ellipse of eccentricity 1 with a = R / 2: Kepler's equation from
    r = a (1 − cos E) to E = π; 0 ≤ f < 1.
    """
    a = turning_distance(r, share) / 2
    start = float(np.arccos(1 - r / a))
    return kepler_period(a, mu) / (2 * np.pi) * (np.pi - start + np.sin(start))


def two_body_period(m1: float, m2: float, constant: float, distance: float) -> float:
    """Return the period of two bodies in circular orbits [s]: 2 π √(d³ / (G (m1 + m2))).

    Their separation obeys r'' = −G (m1 + m2) r / |r|³, as for a planet about a sun of both masses.
    """
    return kepler_period(distance, constant * (m1 + m2))


def revolving_place(
    near: float, e: float, mu: float, extra: float, t: ArrayLike
) -> tuple[Array, Array]:
    """Return distance [m] and angle [rad] under μ / r² + ε / r³, from a perihelion at angle 0.

    Newton's theorem of revolving orbits (Principia, book 1, section 9): the extra force reduces the
    square of the angular momentum h by ε, so r(t) is that of a Kepler ellipse with κ h,
    κ² = 1 − ε / h², and the angle is 1/κ times that ellipse's. Here h² = μ near (1 + e) + ε.
    """
    inner = mu * near * (1 + e)  # (κ h)²
    x, y = kepler_place(near, e, mu, t)
    angle = np.unwrap(np.arctan2(y, x))
    return np.hypot(x, y), angle * np.sqrt((inner + extra) / inner)


def figure_eight(mass: float, constant: float, size: float, t: ArrayLike) -> Array:
    """Return the positions of three equal bodies on a figure eight [m]: (6, ...), x, y of each.

    The choreography of C. Moore (1993) and of A. Chenciner and R. Montgomery (Annals of Mathematics
    152, 2000), from C. Simó's initial conditions; Newton's equations solved by Runge and Kutta.
    """
    x, y, u, v = 0.97000435669734, -0.24308753153583, -0.93240737144104, -0.86473146092102
    places = np.array([x, y, -x, -y, 0, 0])
    moves = np.array([-u / 2, -v / 2, -u / 2, -v / 2, u, v])

    def slope(state: Array) -> Array:
        r = state[:6].reshape(3, 2)
        pulls = np.zeros((3, 2))
        for i, j in ((0, 1), (1, 2), (2, 0)):
            pull = (r[j] - r[i]) / np.hypot(*(r[j] - r[i])) ** 3
            pulls[i] += pull
            pulls[j] -= pull
        return np.concatenate((state[6:], pulls.ravel()))

    seconds = np.sqrt(size**3 / (constant * mass))
    start = np.concatenate((places, moves))
    return size * solution(slope, start, np.asarray(t, dtype=float) / seconds)[:6]


def work(force: complex, way: complex) -> float:
    """Return the work of a constant force along a straight path [J], both as x + iy [N, m].

    The chapter, section 5: the dot product F · d = |F| |d| cos φ.
    """
    return (force.conjugate() * way).real


def closest_approach(r: float, speed: float, k: float) -> float:
    """Return the closest approach of a body that moves radially against a repulsion k / r² [m].

    The chapter, section 5: v² / 2 + k / r is constant, and all of it is potential at the turning
    point; k, r > 0.
    """
    return k / (speed**2 / 2 + k / r)


def repelled_time(r: float, speed: float, k: float) -> float:
    """Return the time until the closest approach [s].

    A straight orbit is a hyperbola of eccentricity 1 about the far focus: with a = k / 2E it is
    r = a (1 + cosh u), t = √(a³ / k) (u + sinh u) from the turning point.
    """
    a = closest_approach(r, speed, k) / 2
    u = float(np.arccosh(r / a - 1))
    return float(np.sqrt(a**3 / k)) * (u + float(np.sinh(u)))


def trough_force(mass: float, drop: float, radius: float, g: float) -> float:
    """Return the force of a wire at its lowest point on a bead that came from a height [N].

    It carries the weight and curves the path, with v² = 2 g h: m g (1 + 2 h / r); `radius` is the
    wire's radius of curvature there [m].
    """
    return mass * (g + landing_speed(0.0, g, drop) ** 2 / radius)


def loop_speed(speed: float, radius: float, g: float) -> float:
    """Return the speed at the top of a loop, entered at the bottom at a given speed [m/s].

    v² = v0² − 4 g r, as long as the body stays on the track: v0² ≥ 5 g r; `radius` is that of the
    path of its centre [m].
    """
    return float(np.sqrt(speed**2 - 4 * g * radius))


def loop_force(mass: float, speed: float, radius: float, g: float) -> float:
    """Return the force of the track at the top of a loop [N]: m v² / r − m g, see `loop_speed`."""
    return mass * (loop_speed(speed, radius, g) ** 2 / radius - g)


def time_of_descent(x: Curve, y: Curve, g: float) -> float:
    """Return the time from rest at p = 0 down a smooth curve to p = 1 [s].

    T = ∫ ds / √(2 g (y(0) − y)), by Gauss-Legendre quadrature over q with p = q²: the integrand is
    smooth, since the position starts like q. Derivatives are central differences.
    """
    q, weight = _gauss(400)
    p, h = q**2, 1e-6
    slope = np.hypot(x(p + h) - x(p - h), y(p + h) - y(p - h)) / (2 * h)
    drop = y(np.zeros(1)) - y(p)
    return float(np.sum(weight * slope * 2 * q / np.sqrt(2 * g * drop)))


@cache
def _gauss(count: int) -> tuple[Array, Array]:
    """Return the Gauss-Legendre points between 0 and 1, and their weights."""
    node, weight = np.polynomial.legendre.leggauss(count)
    return (node + 1) / 2, weight / 2


def morse_rate(mass: float, depth: float, steepness: float, share: float) -> float:
    """Return the angular frequency in Morse's potential D (1 − e^(−a x))² [rad/s].

    a √(2 D (1 − E/D) / m), with the energy E < D as a share of D (L. D. Landau, E. M. Lifshitz,
    Mechanics, 12, problem 2).
    """
    return steepness * float(np.sqrt(2 * depth * (1 - share) / mass))


def morse_place(steepness: float, share: float, turned: ArrayLike) -> Array:
    """Return the position of a body in Morse's potential [m], at a phase from its innermost point.

    From e^(a x) = (1 − √(E/D) cos φ) / (1 − E/D); φ [rad] grows at the rate of `morse_rate`.
    """
    cosine = np.cos(np.asarray(turned, dtype=float))
    return np.asarray(np.log((1 - np.sqrt(share) * cosine) / (1 - share)) / steepness)
