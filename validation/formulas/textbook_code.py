"""The chapter's own code, section 10, line for line: its output, and its pendulum step by step.

`python -m validation.formulas.textbook_code` prints the output of the chapter's two listings.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from validation.formulas import Array

Step = Callable[[float, float, float, float, float], tuple[float, float]]
"""(angle [rad], angular velocity [rad/s], dt [s], L [m], g [m/s²]) -> the next angle and
velocity."""

DT = 0.01  # s
STEPS = 5000
START = 0.5  # rad, from rest


def projectile(
    v0: float, angle_deg: float, g: float = 9.81, dt: float = DT
) -> tuple[Array, Array, Array]:
    """Return t, x and y up to the last sample before y crosses zero again [s, m, m]."""
    th = np.deg2rad(angle_deg)
    vx, vy = v0 * np.cos(th), v0 * np.sin(th)
    tf = 2 * vy / g
    t = np.arange(0, tf, dt)
    x = vx * t
    y = vy * t - 0.5 * g * t**2
    return t, x, y


def projectile_without_numpy(
    v0: float, angle_deg: float, g: float = 9.81, dt: float = DT
) -> tuple[list[float], list[float]]:
    """Return x and y as in the second listing [m]; it adds up dt."""
    th = math.radians(angle_deg)
    vx, vy = v0 * math.cos(th), v0 * math.sin(th)
    tf = 2 * vy / g
    xs, ys = [], []
    t = 0.0
    while t < tf:
        xs.append(vx * t)
        ys.append(vy * t - 0.5 * g * t**2)
        t += dt
    return xs, ys


def step_euler(
    theta: float, omega: float, dt: float, length: float = 1.0, g: float = 9.81
) -> tuple[float, float]:
    """Take one step of plain Euler; position and velocity both use the old values."""
    new_theta = theta + omega * dt
    new_omega = omega - (g / length) * math.sin(theta) * dt
    return new_theta, new_omega


def step_symplectic(
    theta: float, omega: float, dt: float, length: float = 1.0, g: float = 9.81
) -> tuple[float, float]:
    """Take one step of symplectic Euler: velocity first, then position with the new velocity."""
    new_omega = omega - (g / length) * math.sin(theta) * dt
    new_theta = theta + new_omega * dt
    return new_theta, new_omega


def energy(
    theta: float, omega: float, length: float = 1.0, g: float = 9.81, m: float = 1.0
) -> float:
    """Return T + V, with V zero at the bottom [J]."""
    kinetic = 0.5 * m * (length * omega) ** 2
    potential = m * g * length * (1 - math.cos(theta))
    return kinetic + potential


def run(
    step: Step,
    theta: float = START,
    omega: float = 0.0,
    length: float = 1.0,
    g: float = 9.81,
    steps: int = STEPS,
) -> Array:
    """Return angle and angular velocity at every step, including the start: (2, steps + 1)."""
    found = [(theta, omega)]
    for _ in range(steps):
        found.append(step(*found[-1], DT, length, g))
    return np.array(found).T


def swings(step: Step, theta: float, omega: float, length: float, g: float, t: ArrayLike) -> Array:
    """Return the angle at increasing multiples of `DT` [rad]."""
    counts = np.round(np.asarray(t) / DT).astype(int)
    return run(step, theta, omega, length, g, int(counts[-1]))[0][counts]


def figures() -> dict[str, float]:
    """Return every number that the two listings print."""
    _, x, y = projectile(25, 45)
    xs, ys = projectile_without_numpy(25, 45)
    plain, symplectic = run(step_euler)[:, -1], run(step_symplectic)[:, -1]
    start = energy(START, 0.0)
    return {
        "range": float(x[-1]),
        "peak height": float(y.max()),
        "Euler E drift": energy(*plain) - start,
        "Symplectic E drift": energy(*symplectic) - start,
        "range without NumPy": xs[-1],
        "peak without NumPy": max(ys),
        "theta after 50 s": float(symplectic[0]),
        "omega after 50 s": float(symplectic[1]),
    }


if __name__ == "__main__":
    for name, value in figures().items():
        print(f"{name} = {value:.4f}")  # noqa: T201
