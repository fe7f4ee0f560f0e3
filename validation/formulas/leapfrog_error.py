"""The error of leapfrog, derived, so that bounds need no measurements.

Leapfrog conserves, up to dt⁴, not H but H + dt² (v·V″·v / 12 − |∇V|² / 24) for a unit mass
(E. Hairer, C. Lubich, G. Wanner: Geometric Numerical Integration, IX.3), and the angular momentum
about a centre. These two determine where an orbit turns.
"""


def far_end_error(near: float, e: float, mu: float, dt: float) -> float:
    """Return the relative excess of an orbit's far end over its true distance.

    At both ends v is perpendicular to r, so v·V″·v = v² μ / r³, and r v is the same. With
    v² = μ (1 ± e) / r the energy at the far end is too large by
    dt² μ² ((1 + 2e) / near⁴ − (1 − 2e) / far⁴) / 24, and dE / dr = μ e / far² there. The limit for
    a circle is (ω dt)² / 2; 0 ≤ e < 1.
    """
    if e < 1e-6:
        return mu / near**3 * dt**2 / 2
    far = near * (1 + e) / (1 - e)
    gain = dt**2 * mu**2 * ((1 + 2 * e) / near**4 - (1 - 2 * e) / far**4) / 24
    return gain * far / (mu * e)


def escape_energy_error(r: float, share: float, mu: float, dt: float) -> float:
    """Return the energy per kilogram that a body loses on its radial way out [J].

    At the start, with the share f of escape speed, v·V″·v = −2 μ v² / r³ and v² = 2 μ f² / r; at
    the turning point R = r / (1 − f²), v = 0: dt² μ² ((8 f² + 1) / r⁴ − 1 / R⁴) / 24. 0 ≤ f ≤ 1.
    """
    return dt**2 * mu**2 / (24 * r**4) * (8 * share**2 + 1 - (1 - share**2) ** 4)


def turning_error(r: float, share: float, mu: float, dt: float) -> float:
    """Return the relative shortfall of the turning point of a body that goes radially outwards.

    It turns at −μ / E: the loss of energy over |E| = (1 − f²) μ / r; 0 ≤ f < 1.
    """
    return escape_energy_error(r, share, mu, dt) / ((1 - share**2) * mu / r)
