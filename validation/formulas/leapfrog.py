"""The error of leapfrog where it is not exact, derived so that bounds need no measuring.

Leapfrog keeps not H but, up to dt⁴, H + dt² (v·V″·v / 12 − |∇V|² / 24) for a unit mass
(E. Hairer, C. Lubich, G. Wanner: Geometric Numerical Integration, IX.3), and about a centre it
keeps the angular momentum. From the two follows where an orbit turns.
"""


def far_end_error(near: float, e: float, mu: float, dt: float) -> float:
    """Return by how much the far end of an orbit from its near end is too far, of its distance.

    At both ends v is at a right angle to r, so v·V″·v = v² μ / r³, and r v is the same. With
    v² = μ (1 ± e) / r the energy at the far end is too great by
    dt² μ² ((1 + 2e) / near⁴ − (1 − 2e) / far⁴) / 24, and there dE / dr = μ e / far². For a circle
    the limit is (ω dt)² / 2; 0 ≤ e < 1.
    """
    if e < 1e-6:
        return mu / near**3 * dt**2 / 2
    far = near * (1 + e) / (1 - e)
    gain = dt**2 * mu**2 * ((1 + 2 * e) / near**4 - (1 - 2 * e) / far**4) / 24
    return gain * far / (mu * e)


def escape_energy_error(r: float, share: float, mu: float, dt: float) -> float:
    """Return how much energy, of each kilogram, a body loses on its way straight out [J].

    At the start, with the share f of escape speed, v·V″·v = −2 μ v² / r³ and v² = 2 μ f² / r, where
    it turns, at R = r / (1 − f²), v = 0: dt² μ² ((8 f² + 1) / r⁴ − 1 / R⁴) / 24. 0 ≤ f ≤ 1.
    """
    return dt**2 * mu**2 / (24 * r**4) * (8 * share**2 + 1 - (1 - share**2) ** 4)


def turning_error(r: float, share: float, mu: float, dt: float) -> float:
    """Return by how much a body that goes straight out turns too early, of its distance.

    It turns at −μ / E: the loss of energy over |E| = (1 − f²) μ / r; 0 ≤ f < 1.
    """
    return escape_energy_error(r, share, mu, dt) / ((1 - share**2) * mu / r)
