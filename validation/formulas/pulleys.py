"""Weights on strings over pulleys: the chapter, sections 4 and 8."""

import numpy as np


def atwood_acceleration(m1: float, m2: float, g: float) -> float:
    """Return the upward acceleration of the first mass [m/s²]: (m2 − m1) g / (m1 + m2).

    The chapter, section 4, the Atwood machine; light string, light and frictionless pulley.
    """
    return (m2 - m1) / (m1 + m2) * g


def atwood_tension(m1: float, m2: float, g: float) -> float:
    """Return the tension of an Atwood machine's string [N]: 2 m1 m2 g / (m1 + m2).

    From T − m1 g = m1 a, with the chapter's a.
    """
    return m1 * (g + atwood_acceleration(m1, m2, g))


def table_pulley_acceleration(m1: float, m2: float, g: float, mu: float = 0.0) -> float:
    """Return the acceleration of a block drawn over a table by a weight [m/s²].

    m2 g − T = m2 a and T − μ m1 g = m1 a give (m2 − μ m1) g / (m1 + m2); 0 where friction holds.
    """
    return max((m2 - mu * m1) / (m1 + m2) * g, 0.0)


def table_pulley_tension(m1: float, m2: float, g: float, mu: float = 0.0) -> float:
    """Return the tension between a block on a table and its weight [N]: m2 (g − a)."""
    return m2 * (g - table_pulley_acceleration(m1, m2, g, mu))


def movable_pulley_acceleration(weight: float, wheel: float, g: float) -> float:
    """Return the upward acceleration of a movable pulley [m/s²].

    2 T − M g = M a and T − m g = −2 m a: (2 m − M) g / (4 m + M).
    """
    return (2 * weight - wheel) * g / (4 * weight + wheel)


def movable_pulley_tension(weight: float, wheel: float, g: float) -> float:
    """Return the tension of a movable pulley's string [N].

    The weight goes down twice as fast as the wheel goes up: m (g − 2 a).
    """
    return weight * (g - 2 * movable_pulley_acceleration(weight, wheel, g))


def double_atwood_accelerations(
    m1: float, wheel: float, m2: float, m3: float, g: float
) -> tuple[float, float, float]:
    """Return the upward accelerations of m1, and of m2 and m3 over the wheel [m/s²].

    Lagrange's equations (the chapter, section 9) for the rise x of the wheel and the rise y of m2
    relative to it, T = m1 ẋ²/2 + M ẋ²/2 + m2 (ẋ + ẏ)²/2 + m3 (ẋ − ẏ)²/2:

        (m1 + M + m2 + m3) ẍ + (m2 − m3) ÿ = (m1 − M − m2 − m3) g
        (m2 − m3) ẍ + (m2 + m3) ÿ = (m3 − m2) g
    """
    inertia = [[m1 + wheel + m2 + m3, m2 - m3], [m2 - m3, m2 + m3]]
    weight = [(m1 - wheel - m2 - m3) * g, (m3 - m2) * g]
    x, y = np.linalg.solve(inertia, weight)
    return -float(x), float(x + y), float(x - y)


def massive_pulley_acceleration(m1: float, m2: float, wheel: float, g: float) -> float:
    """Return the upward acceleration of the first mass of an Atwood machine with a wheel [m/s²].

    The chapter, section 8: the wheel, I = M R² / 2, takes the torque (T2 − T1) R = I a / R, so that
    T1 − m1 g = m1 a and m2 g − T2 = m2 a add up to (m2 − m1) g = (m1 + m2 + M / 2) a.
    """
    return (m2 - m1) * g / (m1 + m2 + wheel / 2)


def massive_pulley_tensions(m1: float, m2: float, wheel: float, g: float) -> tuple[float, float]:
    """Return the tensions of the string on the two sides of its wheel [N].

    m1 (g + a) and m2 (g − a).
    """
    a = massive_pulley_acceleration(m1, m2, wheel, g)
    return m1 * (g + a), m2 * (g - a)
