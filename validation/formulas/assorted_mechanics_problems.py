"""Machines: statics, impacts, and equations of motion of a few parts.

They combine the chapter's laws of sections 4, 5, 7 and 8; each function names its own.
"""

from collections.abc import Callable

import numpy as np

from validation.formulas import Array
from validation.formulas.runge_kutta import solution

SPAN = 2.0
"""The time for which motions are integrated [s]."""

LOOKS = 2001
"""The number of samples; the angular velocity is interpolated between them."""


def axle_loads(
    weights: list[tuple[float, float]], axles: tuple[float, float]
) -> tuple[float, float]:
    """Return the loads on two axles [N]: forces and torques sum to zero.

    Each weight [N] comes with its position, and each axle has a position, too [m].
    """
    whole = sum(weight for weight, _ in weights)
    torque = sum(weight * (place - axles[0]) for weight, place in weights)
    second = torque / (axles[1] - axles[0])
    return whole - second, second


def ladder_spin(start: float, angle: float, length: float, g: float) -> float:
    """Return the angular velocity of a ladder that slides down a smooth wall [rad/s].

    With its foot on a smooth floor its centre moves on a circle of L/2 about the corner:
    m L² ω² / 6 is the loss of m g L sin θ / 2. Angles are from the floor;
    0 < angle <= start < π/2.
    """
    return float(np.sqrt(3 * g / length * (np.sin(start) - np.sin(angle))))


def ladder_push(start: float, angle: float, mass: float, length: float, g: float) -> float:
    """Return the force of a smooth wall on a sliding ladder [N]; negative if it has left.

    m x'' with x = L/2 cos θ, where θ'² is from `ladder_spin`, and θ'' half its derivative by θ.
    """
    spin = ladder_spin(start, angle, length, g)
    slowing = -3 * g / (2 * length) * np.cos(angle)
    return float(-mass * length / 2 * (slowing * np.sin(angle) + spin**2 * np.cos(angle)))


def ladder_drift(start: float, length: float, g: float) -> float:
    """Return the horizontal speed of a ladder after it has left its wall [m/s]: −x' there."""
    leaves = float(np.arcsin(2 / 3 * np.sin(start)))
    return length / 2 * ladder_spin(start, leaves, length, g) * float(np.sin(leaves))


def fallen_ladder_spin(start: float, angle: float, length: float, g: float) -> float:
    """Return the angular velocity of a ladder that has left its wall [rad/s], by energy.

    Its centre moves horizontally at a constant speed, and downwards at L/2 ω cos θ.
    """
    drop = length / 2 * (np.sin(start) - np.sin(angle))
    left = 2 * g * drop - ladder_drift(start, length, g) ** 2
    return float(np.sqrt(left / ((length / 2 * np.cos(angle)) ** 2 + length**2 / 12)))


def capstan_acceleration(ratio: float, mu: float, knots: int, mass: float, g: float) -> float:
    """Return the acceleration of a weight of `ratio` kg that draws one of 1 kg over a drum [m/s²].

    The rope is a chain of knots, which slip on half of the drum's circumference; it bends by the
    same angle at each, and by half of it at the last. The tension changes at each knot by friction,
    weight and inertia: Newton's second law, knot by knot. With many light knots the ratio of the
    tensions on the two sides is e^(μ φ) (Euler 1769, Eytelwein 1808).
    """

    def lacks(acceleration: float) -> float:
        pull = g + acceleration
        bend = np.pi / (knots - 1) / 2
        for knot in range(knots):
            angle = np.pi * (1 - knot / (knots - 1))
            before, after = (0.0 if end else bend for end in (knot == 0, knot == knots - 1))
            weight = mass * g * (mu * np.sin(angle) - np.cos(angle))
            drawn = pull * (np.cos(before) + mu * np.sin(before)) + weight + mass * acceleration
            pull = drawn / (np.cos(after) - mu * np.sin(after))
        return float(ratio * (g - acceleration) - pull)

    at_rest = lacks(0.0)
    return at_rest / (at_rest - lacks(1.0))


def struck_spin(momentum: float, arm: float, moments: float) -> float:
    """Return the angular velocity of a plank on a pin after an impact [rad/s].

    The angular momentum about the pin is conserved (the chapter, section 8); the pin has no arm.
    """
    return momentum * arm / moments


def dumbbell_bounce(
    masses: tuple[float, float], angle: float, speed: float, e: float, length: float = 1.0
) -> tuple[float, float]:
    """Return the motion of a dumbbell after hitting a smooth floor: spin [rad/s], velocity [m/s].

    It falls without spin. Its first end hits the floor; the second is at `angle` above the
    horizontal. The floor's impulse J is vertical, so the first end leaves with
    J (1/M + x²/I) - v = e v (Newton's law of restitution), where x is its lever arm about the
    centre (the chapter, sections 7 and 8).
    """
    whole = sum(masses)
    moment = masses[0] * masses[1] / whole * length**2
    lever = -masses[1] / whole * length * np.cos(angle)
    push = (1 + e) * speed / (1 / whole + lever**2 / moment)
    return float(lever * push / moment), float(push / whole - speed)


Slope = Callable[[Array], Array]


def trebuchet_spin(
    start: float,
    angle: float,
    arm: tuple[float, float, float],
    short: float,
    hanging: tuple[float, float],
    stone: tuple[float, complex],
    g: float,
) -> float:
    """Return the angular velocity of a trebuchet's arm at a given angle [rad/s].

    Its weight hangs on a rod and starts straight below its end: a double pendulum, with the stone
    fixed to the arm. Lagrange's equations for the angles a of the arm and χ of the rod, from
    straight down, with q = M d l:

        A a'' − q sin(χ − a) χ'' = q cos(χ − a) χ'² − ∂V/∂a
        M l² χ'' − q sin(χ − a) a'' = −q cos(χ − a) a'² − M g l sin χ

    The start and the angle are those of the long arm. `arm` has its mass [kg], its moment about the
    axle [kg m²], and the distance of its centre [m]; `short` is the distance of the weight's pivot
    from the axle, on the other side [m]; `hanging` has its mass [kg] and the length of its rod [m],
    `stone` its mass [kg] and its position, along the arm and across [m].
    """
    (mass, moment, out), (weight, rod), (shot, held) = arm, hanging, stone
    whole = moment + shot * abs(held) ** 2 + weight * short**2
    q = weight * short * rod

    def slope(state: Array) -> Array:
        a, chi, turns, swings = state
        s, c = np.sin(chi - a), np.cos(chi - a)
        lever = (mass * out - weight * short) * np.cos(a) + shot * (held * np.exp(1j * a)).real
        matrix = np.array([[whole, -q * s], [-q * s, weight * rod**2]])
        pulls = (q * c * swings**2 - g * lever, -q * c * turns**2 - weight * g * rod * np.sin(chi))
        return np.array([turns, swings, *np.linalg.solve(matrix, pulls)])

    return _spin_at(angle, slope, np.array([start, 0.0, 0.0, 0.0]))


def _spin_at(angle: float, slope: Slope, start: Array) -> float:
    """Return the third component of a state at the time when the first reaches a value."""
    times = np.linspace(0, SPAN, LOOKS)
    for count in (LOOKS // 4, LOOKS // 2, LOOKS):
        states = solution(slope, start, times[:count])
        beyond = np.flatnonzero((states[0] - angle) * (start[0] - angle) <= 0)
        if len(beyond):
            last = int(beyond[0])
            share = (angle - states[0, last - 1]) / (states[0, last] - states[0, last - 1])
            return float(states[2, last - 1] + share * (states[2, last] - states[2, last - 1]))
    raise ValueError(f"the arm does not reach {angle:.3g} rad within {SPAN:g} s")


def spiral(radius: float, growth: float, turned: float) -> complex:
    """Return a point of a logarithmic spiral [m], which at 0 is `radius` below its centre."""
    return complex(-1j * radius * np.exp((1j - growth) * turned))


def spiral_force(
    mass: float, radius: float, growth: float, start: float, turned: float, g: float
) -> float:
    """Return the force of a wire on a bead that slides down a spiral from rest [N].

    Its normal acceleration is v² over the radius of curvature, |z| √(1 + k²); the wire provides
    what gravity does not.
    """
    here = spiral(radius, growth, turned)
    square = 2 * g * (spiral(radius, growth, start) - here).imag
    along = (1j - growth) * here
    inwards = 1j * along / abs(along)
    needed = square / (abs(here) * np.hypot(1, growth))
    return float(mass * abs(needed - (inwards.conjugate() * -1j * g).real))


def stick_slip_pull(
    load: float, mass: float, stiffness: float, speed: float, static: float, kinetic: float,
    t: Array,
) -> Array:  # fmt: skip
    """Return the force of a spring on a body that a belt carries away, for one stick and slip [N].

    Newton's second law of section 4, with two coefficients. The force grows by k v until it
    overcomes static friction, μs N. Then it oscillates about the kinetic one, μk N, until the body
    has the belt's velocity again, and grows once more.
    """
    rate, first = np.sqrt(stiffness / mass), static * load / (stiffness * speed)
    above, along = (static - kinetic) * load, speed * np.sqrt(stiffness * mass)
    phase = np.arctan2(along, above)
    lasts = (np.pi + 2 * phase) / rate
    swing = kinetic * load + np.hypot(above, along) * np.cos(rate * (t - first) - phase)
    again = kinetic * load - above + stiffness * speed * (t - first - lasts)
    carried = np.where(t < first, stiffness * speed * t, again)
    return np.asarray(np.where((t < first) | (t > first + lasts), carried, swing))


def tray_and_glass(
    tray: float, glass: float, friction: float, angle: float, g: float
) -> tuple[float, float]:
    """Return the initial horizontal accelerations of a swinging tray and a glass that slips [m/s²].

    The tray hangs on two strings of equal length, so it moves on a circle and does not turn:
    section 4's laws for both, with the tension, the normal force, and the two accelerations as
    unknowns.
    """
    sin, cos = np.sin(angle), np.cos(angle)
    # unknown: the tray's acceleration down its circle, the strings' pull, the normal force
    equations = [
        [-tray * cos, sin, -friction],  # the tray across: -T sin + mu N
        [-tray * sin, -cos, 1.0],  # the tray up: T cos - M g - N
        [glass * sin, 0.0, 1.0],  # the glass up: N - m g, and it goes down with the tray
    ]
    down, _, normal = np.linalg.solve(equations, [0.0, -tray * g, glass * g])
    return float(-down * cos), float(-friction * normal / glass)
