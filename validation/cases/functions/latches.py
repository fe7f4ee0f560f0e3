"""The functions of `latches.toml` under `own`: a train that is coupled, a hammer that rings."""

from math import asin, radians, sqrt

from sandbox.model.expressions import Values

WAGONS = (2.0, 2.0)  # kg, of those that stand
ARM = 0.6 * 1.4**2 / 3 + 0.6 * 0.12**2 / 12  # kg m², of the hammer about its end


def speed(p: Values, standing: int) -> float:
    """Return the speed of the first wagon with a number of others coupled to it [m/s].

    By momentum, m v = (m + Σ m_i) v'.
    """
    return p["m"] * p["v"] / (p["m"] + sum(WAGONS[:standing]))


def lost(p: Values) -> float:
    """Return the energy that both couplings dissipate together [J]: Σ μ u² / 2.

    μ is the reduced mass and u the relative speed of two masses that couple (Koenig's theorem).
    """
    masses = p["m"], p["m"] + WAGONS[0]
    return sum(
        mass * other / (mass + other) * speed(p, i) ** 2 / 2
        for i, (mass, other) in enumerate(zip(masses, WAGONS, strict=True))
    )


def push(p: Values) -> float:
    """Return the force of the spring that stops the train [N]: k x²/2 = M v²/2."""
    return -speed(p, 2) * sqrt(p["k"] * (p["m"] + sum(WAGONS)))


def rings(p: Values, blows: int) -> float:
    """Return when the hammer is upright again after a number of blows [s].

    Between blows it swings with ω = √(k/I); at each stop it keeps e of its speed.
    """
    omega = sqrt(p["k"] / ARM)
    stop = omega * radians(p["gap"])
    spins = [sqrt(stop**2 + _left(p, n) * (p["rate"] ** 2 - stop**2)) for n in range(blows + 1)]
    ways = [asin(stop / spin) / omega for spin in spins]
    return ways[0] + 2 * sum(ways[1:-1]) + ways[-1]


def spin(p: Values, blows: int) -> float:
    """Return the upright hammer's angular velocity after a number of blows [rad/s]."""
    stop = sqrt(p["k"] / ARM) * radians(p["gap"])
    return sqrt(stop**2 + _left(p, blows) * (p["rate"] ** 2 - stop**2))


def _left(p: Values, blows: int) -> float:
    """Return the share of the energy at a stop that is left after a number of blows."""
    return float(p["e"] ** (2 * blows))
