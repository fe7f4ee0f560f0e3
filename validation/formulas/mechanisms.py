"""Linkages and cranes: geometry, and sections 5 and 8 of the chapter.

The positions of a linkage with one degree of freedom follow from one angle or width; forces then
follow from virtual work, F dw = dV + dT.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array
from validation.formulas.runge_kutta import solution


class Slider(NamedTuple):
    """The position, velocity and acceleration of a piston [m, m/s, m/s²]."""

    position: Array
    speed: Array
    acceleration: Array


def slider(angle: ArrayLike, rate: float, crank: float, rod: float) -> Slider:
    """Return the motion of a piston whose crank turns uniformly; 0 < crank < rod.

    The rod keeps its length: x² − 2 x r cos θ + r² = l², differentiated once and twice.
    """
    c, s = crank * np.cos(angle), crank * np.sin(angle)
    x = c + np.sqrt(rod**2 - s**2)
    v = -x * s * rate / (x - c)
    a = -(v**2 + 2 * v * s * rate + x * c * rate**2) / (x - c)
    return Slider(np.asarray(x), np.asarray(v), np.asarray(a))


def engine_torque(
    angle: ArrayLike, rate: float, crank: float, rod: float, masses: tuple[float, float]
) -> Array:
    """Return the torque that turns a crank uniformly [N m]; masses of the rod and the piston.

    Its power is the rate of change of kinetic energy: τ ω = Σ m v · a + I φ' φ''. The rod's centre
    is half-way between its pins; its tilt has l sin φ = −r sin θ.
    """
    piston = slider(angle, rate, crank, rod)
    pin = crank * np.exp(1j * np.asarray(angle))
    v, a = (1j * rate * pin + piston.speed) / 2, (-(rate**2) * pin + piston.acceleration) / 2
    sine = -pin.imag / rod
    cosine = np.sqrt(1 - sine**2)
    spin = -pin.real * rate / (rod * cosine)
    twist = (pin.imag * rate**2 / rod + sine * spin**2) / cosine
    power = masses[0] * (v.conjugate() * a).real + masses[0] * rod**2 / 12 * spin * twist
    return np.asarray((power + masses[1] * piston.speed * piston.acceleration) / rate)


def coasting_angle(
    t: ArrayLike, rate: float, wheel: float, crank: float, rod: float, masses: tuple[float, float]
) -> Array:
    """Return the angle of a flywheel that coasts with a piston, from outer dead centre [rad].

    T = I(θ) θ'² / 2 is constant, with I(θ) of the wheel, rod and piston from `slider` at one radian
    per second. Solved by Runge and Kutta.
    """

    def moment(angle: Array) -> Array:
        pin = crank * np.exp(1j * angle)
        speed = slider(angle, 1.0, crank, rod).speed
        spin = pin.real / np.sqrt(rod**2 - pin.imag**2)
        own = masses[0] * (abs(1j * pin + speed) ** 2 / 4 + rod**2 / 12 * spin**2)
        return np.asarray(wheel + own + masses[1] * speed**2)

    start = moment(np.zeros(1))
    return solution(lambda y: rate * np.sqrt(start / moment(y)), np.zeros(1), t)[0]


def supports(loads: Iterable[tuple[float, ArrayLike]], left: float, right: float) -> list[Array]:
    """Return the loads on two supports [N], given each load's position [m] and force [N].

    The torques about either support cancel (the chapter, section 8).
    """
    pairs = [(place, np.asarray(load)) for place, load in loads]
    about = ((right, left - right), (left, right - left))
    return [np.sum([f * (x - pin) for x, f in pairs], axis=0) / arm for pin, arm in about]


def stay_tension(torque: ArrayLike, pin: complex, held: complex, peak: complex) -> Array:
    """Return the tension of a stay from a point of a beam to a peak that balances a torque [N].

    The lever arm is the distance of the pin from the stay's line.
    """
    along = (peak - held) / abs(peak - held)
    return np.asarray(torque) / abs(((held - pin).conjugate() * along).imag)


class Scissor(NamedTuple):
    """A scissor lift: pairs of arms, the length and mass of an arm, the mass on top [m, kg]."""

    pairs: int
    length: float
    arm: float
    top: float

    def force(self, width: ArrayLike, speed: ArrayLike, change: ArrayLike, g: float) -> Array:
        """Return the pull between the feet [N]: of their distance w, and its first two derivatives.

        With h = √(L² − w²) arm k is at (w / 2, (k + 1/2) h) and turns with w' / h, the top is at
        n h. T = A(w) w'² / 2 and V(w) = g W h, so F = −V' − A w'' − A' w'² / 2.
        """
        w, v, a = (np.asarray(x, dtype=float) for x in (width, speed, change))
        levels = np.arange(self.pairs) + 0.5
        weight = self.pairs * self.top + 2 * self.arm * levels.sum()
        up = self.pairs**2 * self.top + 2 * self.arm * (levels**2).sum()
        across = self.pairs * self.arm / 2
        turn = 2 * self.pairs * self.arm * self.length**2 / 12
        h2 = self.length**2 - w**2
        inertia = (up * w**2 + turn) / h2 + across
        grows = 2 * w * (up * self.length**2 + turn) / h2**2
        return np.asarray(g * weight * w / np.sqrt(h2) - inertia * a - grows * v**2 / 2)


def eased(share: ArrayLike) -> tuple[Array, Array, Array]:
    """Return a smooth function from 0 to 1, and its first two derivatives.

    The polynomial of seventh degree with three derivatives of zero at both ends.
    """
    s = np.clip(np.asarray(share, dtype=float), 0.0, 1.0)
    way = np.polynomial.Polynomial([0, 0, 0, 0, 35, -84, 70, -20])
    return way(s), way.deriv()(s), way.deriv(2)(s)


def chebyshev_foot(angle: ArrayLike, crank: float) -> Array:
    """Return the end of the long bar of Chebyshev's linkage, as x + iy from the crank's axle [m].

    Crank, ground, rocker and half the long bar are as 1 : 2 : 2.5 : 2.5; the middle of the long bar
    is where the circles about the crank's pin and about the rocker's meet.
    """
    pin = crank * np.exp(1j * np.asarray(angle))
    base = 2 * crank - pin
    middle = (
        pin + base / 2 + 1j * base / abs(base) * np.sqrt((2.5 * crank) ** 2 - abs(base / 2) ** 2)
    )
    return np.asarray(2 * middle - pin)


def bridge_angle(
    t: ArrayLike, length: float, tower: float, bridge: float, weight: float, g: float
) -> Array:
    """Return the angle of a drawbridge that is raised by a counterweight, from level [rad].

    With l(θ) from the tip to the peg above the hinge, l² = L² + H² − 2 L H sin θ, T = (m L² / 3 +
    M l'²) θ'² / 2 and V = m g L sin θ / 2 + M g l. Lagrange's equation, by Runge and Kutta.
    """

    def slope(y: Array) -> Array:
        angle, omega = y
        way = np.sqrt(length**2 + tower**2 - 2 * length * tower * np.sin(angle))
        first = -length * tower * np.cos(angle) / way
        second = (length * tower * np.sin(angle) - first**2) / way
        moment = bridge * length**2 / 3 + weight * first**2
        torque = -bridge * g * length / 2 * np.cos(angle) - weight * g * first
        return np.array([omega, (torque - weight * first * second * omega**2) / moment])

    return solution(slope, np.zeros(2), t)[0]


class Belt(NamedTuple):
    """A belt's tensions on the tight and the slack side [N], and the torque at the driver [N m]."""

    tight: Array
    slack: Array
    torque: Array


def belt(
    load: ArrayLike, pull: float, radii: tuple[float, float], apart: float, at_driver: ArrayLike = 0
) -> Belt:
    """Return the tensions of a massless belt over a driver and a wheel with a load.

    The tensions differ by the torque over the radius, and together they balance the force that
    spreads the axles; the sides are tangent to both wheels, so they are not parallel if the radii
    differ. `load` is the whole torque on the wheel [N m], `at_driver` an additional torque on the
    driver.
    """
    a, b = radii
    both = pull / np.sqrt(1 - ((a - b) / apart) ** 2)
    more = np.asarray(load, dtype=float) / b
    return Belt((both + more) / 2, (both - more) / 2, more * a + np.asarray(at_driver, dtype=float))
