"""Pendulums and oscillators: the chapter, sections 5, 8 and 9."""

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array
from validation.formulas.runge_kutta import solution


def agm(a: float, b: float) -> float:
    """Return the arithmetic-geometric mean."""
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, float(np.sqrt(a * b))
    return a


def pendulum_period(length: float, g: float, amplitude: float) -> float:
    """Return the period of a simple pendulum of any amplitude below π [s].

    4 √(L/g) K(sin(θ/2)), with K(k) = π / (2 agm(1, √(1 − k²))): the complete elliptic integral that
    the Lagrange equation of the chapter's section 9, θ'' = −(g/L) sin θ, leads to.
    """
    return float(2 * np.pi * np.sqrt(length / g) / agm(1.0, float(np.cos(amplitude / 2))))


def physical_pendulum_period(length: float, g: float, amplitude: float) -> float:
    """Return the period of a thin stick on a pin at its end [s].

    I = m L² / 3 about the pin: a simple pendulum of the length I / (m L / 2) = 2 L / 3.
    """
    return pendulum_period(2 * length / 3, g, amplitude)


def pendulum_energy(mass: float, g: float, *heights: float) -> float:
    """Return the energy of equal masses at rest at some heights [J]: Σ m g h."""
    return mass * g * sum(heights)


def cart_pendulum(
    t: ArrayLike, cart: float, bob: float, length: float, g: float, angle: float
) -> tuple[Array, Array]:
    """Return the distance that a cart has rolled [m] and its pendulum's angle [rad], from rest.

    L = (M + m) x'² / 2 + m l x' θ' cos θ + m l² θ'² / 2 + m g l cos θ (the chapter, section 9). By
    the first Lagrange equation (M + m) x' + m l θ' cos θ stays 0; the second is then
    (M + m sin² θ) l θ'' = −(M + m) g sin θ − m l θ'² sin θ cos θ. Solved by Runge and Kutta.
    """

    def slope(y: Array) -> Array:
        theta, omega = y
        s, c = np.sin(theta), np.cos(theta)
        force = -(cart + bob) * g * s - bob * length * omega**2 * s * c
        return np.array([omega, force / ((cart + bob * s**2) * length)])

    theta = solution(slope, np.array([angle, 0.0]), t)[0]
    return bob * length / (cart + bob) * (np.sin(angle) - np.sin(theta)), theta


def double_pendulum(
    t: ArrayLike,
    masses: tuple[float, float],
    lengths: tuple[float, float],
    g: float,
    angles: tuple[float, float],
) -> Array:
    """Return the angles of two rods from straight down, released at rest [rad]: (2, ...).

    L = (m + M) l² θ'² / 2 + M h² φ'² / 2 + M l h θ' φ' cos(θ − φ) + (m + M) g l cos θ
    + M g h cos φ, with M and h the lower mass and rod. Lagrange's two equations are linear in the
    accelerations: A (θ'', φ'') = b. Solved by Runge and Kutta.
    """
    (upper, lower), (first, second) = masses, lengths
    both = upper + lower

    def slope(y: Array) -> Array:
        theta, phi, omega, spin = y
        cross = lower * first * second
        s, c = np.sin(theta - phi), np.cos(theta - phi)
        matrix = np.array([[both * first**2, cross * c], [cross * c, lower * second**2]])
        pulls = np.array(
            [
                -cross * s * spin**2 - both * g * first * np.sin(theta),
                cross * s * omega**2 - lower * g * second * np.sin(phi),
            ]
        )
        return np.concatenate(([omega, spin], np.linalg.solve(matrix, pulls)))

    return solution(slope, np.array([*angles, 0.0, 0.0]), t)[:2]


def spring_pendulum(
    t: ArrayLike, mass: float, stiffness: float, slack: float, g: float, angle: float
) -> Array:
    """Return length [m] and angle [rad] of a swinging spring, from rest and slack: (2, ...).

    L = m (r'² + r² θ'²) / 2 − k (r − l)² / 2 + m g r cos θ. Solved by Runge and Kutta.
    """

    def slope(y: Array) -> Array:
        r, theta, speed, omega = y
        out = r * omega**2 + g * np.cos(theta) - stiffness / mass * (r - slack)
        return np.array([speed, omega, out, -(g * np.sin(theta) + 2 * speed * omega) / r])

    return solution(slope, np.array([slack, angle, 0.0, 0.0]), t)[:2]


def cart_pendulum_frequency(cart: float, bob: float, length: float, g: float) -> float:
    """Return the angular frequency of a pendulum on a free cart, for small swings [rad/s].

    The equation above, linearized: ω² = g (M + m) / (M l).
    """
    return float(np.sqrt(g * (cart + bob) / (cart * length)))


def oscillator_period(mass: float, stiffness: float) -> float:
    """Return the period of a spring [s], whatever its amplitude: 2 π √(m / k)."""
    return float(2 * np.pi * np.sqrt(mass / stiffness))


def oscillator_amplitude(mass: float, stiffness: float, speed: float) -> float:
    """Return the amplitude of a spring whose body passes the middle at a given speed [m].

    m v² / 2 = k A² / 2, the chapter's section 5.
    """
    return float(speed * np.sqrt(mass / stiffness))


def hardening_period(mass: float, stiffness: float, cubic: float, amplitude: float) -> float:
    """Return the period of m x'' + k x + b x³ = 0 [s], Duffing's oscillator: 4 K(κ) / Ω.

    Ω² = (k + b A²) / m, κ² = b A² / (2 (k + b A²)) (A. H. Nayfeh, D. T. Mook, Nonlinear
    Oscillations, 2.1), and K(κ) = π / (2 agm(1, √(1 − κ²))); k, b >= 0.
    """
    steep = stiffness + cubic * amplitude**2
    modulus = cubic * amplitude**2 / (2 * steep)
    return float(2 * np.pi / agm(1.0, np.sqrt(1 - modulus)) * np.sqrt(mass / steep))


def damped_oscillation(
    t: ArrayLike, mass: float, stiffness: float, damping: float, amplitude: float
) -> Array:
    """Return the displacement of a damped spring, released at rest at its amplitude [m].

    m x'' + c x' + k x = 0; the exponents are the roots of m s² + c s + k, real or complex.
    """
    t = np.asarray(t, dtype=float)
    root = np.sqrt(complex(damping**2 - 4 * mass * stiffness))
    s, z = (-damping + root) / (2 * mass), (-damping - root) / (2 * mass)
    if abs(s - z) < 1e-9 * abs(s):
        return np.asarray((amplitude * (1 - s * t) * np.exp(s * t)).real)
    return np.asarray((amplitude * (s * np.exp(z * t) - z * np.exp(s * t)) / (s - z)).real)


def mode_frequencies(mass: float, stiffness: float, coupling: float) -> tuple[float, float]:
    """Return the frequencies of two coupled masses, in phase and in opposition [rad/s].

    In phase the spring between them, c, has no effect; in opposition its middle is at rest, and
    each half of it is twice as stiff: √(k / m), √((k + 2 c) / m).
    """
    together, against = stiffness / mass, (stiffness + 2 * coupling) / mass
    return float(np.sqrt(together)), float(np.sqrt(against))


def coupled_oscillations(
    t: ArrayLike,
    mass: float,
    stiffness: float,
    start: tuple[float, float],
    coupling: float | None = None,
) -> Array:
    """Return the displacements of two masses in a row of three springs [m]: (2, ...).

    m x'' = −K x with K = [[k + c, −c], [−c, k + c]], c = k if left out; by the eigenvectors of K.
    """
    c = stiffness if coupling is None else coupling
    matrix = np.array([[stiffness + c, -c], [-c, stiffness + c]]) / mass
    squares, modes = np.linalg.eigh(matrix)
    swings = np.cos(np.sqrt(squares)[:, None] * np.asarray(t, dtype=float))
    return np.asarray(modes @ ((modes.T @ np.array(start))[:, None] * swings))


def skater_speed(t: ArrayLike, speed: float, draw: float) -> Array:
    """Return the speed of a hand, initially 1 m from the axis, drawn in at a constant rate u [m/s].

    The angular momentum, and so v r of the tangential speed, is conserved: √((v/r)² + u²) with
    r = 1 − u t.
    """
    r = 1 - draw * np.asarray(t, dtype=float)
    return np.asarray(np.sqrt((speed / r) ** 2 + draw**2))


def response(mass: float, stiffness: float, damping: float, drive: float) -> complex:
    """Return the complex response of a driven spring, displacement per force [m/N].

    m x'' + c x' + k x = e^(i w t), where w is the angular frequency of the drive, has the steady
    solution x = X e^(i w t) with X = 1 / (k − m w² + i c w): its absolute value is the amplitude,
    its argument the phase.
    """
    return 1 / (stiffness - mass * drive**2 + 1j * damping * drive)


def driven_oscillation(
    t: ArrayLike, mass: float, stiffness: float, damping: float, force: float, drive: float
) -> Array:
    """Return the steady-state displacement of a spring driven by F cos w t [m]."""
    t = np.asarray(t, dtype=float)
    swing = force * response(mass, stiffness, damping, drive) * np.exp(1j * drive * t)
    return np.asarray(swing.real)


def started_oscillation(
    t: ArrayLike, mass: float, stiffness: float, damping: float, force: float, drive: float
) -> Array:
    """Return the displacement of a spring driven by F cos w t from rest [m].

    The steady state plus a free oscillation that cancels its initial position and velocity; the
    exponents are the roots s, z of m s² + c s + k, complex or real but not equal.
    """
    t = np.asarray(t, dtype=float)
    steady = force * response(mass, stiffness, damping, drive)
    place, speed = -steady.real, (-1j * drive * steady).real
    root = np.sqrt(complex(damping**2 - 4 * mass * stiffness))
    s, z = (-damping + root) / (2 * mass), (-damping - root) / (2 * mass)
    free = ((speed - z * place) * np.exp(s * t) - (speed - s * place) * np.exp(z * t)) / (s - z)
    return driven_oscillation(t, mass, stiffness, damping, force, drive) + free.real


def tipping_time(moment: float, torque: float) -> float:
    """Return the time for a beam to tip from level until it hangs [s].

    I θ'' = τ cos θ, where τ is the net torque of the weights while it is level: a pendulum that is
    released at a right angle, of the length I / m r where τ = m g r. Both > 0.
    """
    return pendulum_period(moment, torque, np.pi / 2) / 4


def action_of_throw(
    t: ArrayLike, mass: float, speeds: tuple[float, float], g: float, stray: float, waves: int
) -> Array:
    """Return the action from the start along a path that deviates from a throw's [J s].

    ∫ (T − V) dt of the chapter's section 9, along y + η with η = a sin(n π t / t1), where t1 = 2 v
    / g is the time of landing, by Gauss quadrature with 40 points. No force need cause that path.
    """
    (across, up), t = speeds, np.asarray(t, dtype=float)
    k = waves * np.pi * g / (2 * up)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    s = t[..., None] * (nodes + 1) / 2
    rising = up - g * s + stray * k * np.cos(k * s)
    height = up * s - g * s**2 / 2 + stray * np.sin(k * s)
    lagrangian = mass * (across**2 + rising**2) / 2 - mass * g * height
    return np.asarray(lagrangian @ weights * t / 2)


def more_action(mass: float, stray: float, waves: int, duration: float) -> float:
    """Return the excess of the action of such a path [J s]: m a² n² π² / (4 t1).

    The term linear in η vanishes, because the true path obeys Lagrange's equation, and V is linear
    in y, so that only ∫ m η'² / 2 dt remains. It is positive for all a and n.
    """
    return float(mass * (stray * waves * np.pi) ** 2 / (4 * duration))


def cycloid_height(t: ArrayLike, radius: float, g: float, start: float) -> Array:
    """Return the height of a bead on a cycloid above its lowest point [m].

    Huygens, Horologium oscillatorium (1673): on x = R (θ + sin θ), y = R (1 − cos θ) the arc length
    from the lowest point is s = 4 R sin(θ/2), and y = s² / (8 R). So
    L = m s'² / 2 − m g s² / (8 R), as for a spring: s = A cos(ωt), ω² = g / (4 R), for any A.
    """
    length = 4 * radius * np.sin(start / 2) * np.cos(np.sqrt(g / radius) / 2 * np.asarray(t))
    return np.asarray(length**2 / (8 * radius))


def cycloid_time(radius: float, g: float) -> float:
    """Return the time for a bead to slide down a cycloid to its lowest point [s]: π √(R/g).

    A quarter of the period of `cycloid_height`, from any start. From the cusp no wire is quicker:
    Johann Bernoulli, Acta Eruditorum (1697).
    """
    return float(np.pi * np.sqrt(radius / g))


def hoop_frequency(radius: float, rate: float, g: float, amplitude: float) -> float:
    """Return the angular frequency of a bead about its equilibrium on a rotating hoop [rad/s].

    L = m R² (θ'² + ω² sin² θ) / 2 + m g R cos θ: equilibrium where cos θ = g / (ω² R), or at the
    bottom if that is impossible; the frequency of small swings is the root of the potential's
    second derivative there, taken here as a difference over the amplitude.
    """
    rest = np.arccos(min(1.0, g / (rate**2 * radius)))

    def slope(angle: float) -> float:
        return float(np.sin(angle) * (g / radius - rate**2 * np.cos(angle)))

    rises = (slope(rest + amplitude) - slope(rest - amplitude)) / (2 * amplitude)
    return float(np.sqrt(rises))
