"""Scenes that should converge: orbits, pendulums, springs, a spinning rod, a block at rest."""

from collections.abc import Iterator
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from validation.formulas.energy import kepler_period, kepler_place
from validation.formulas.oscillators import damped_oscillation, pendulum_period
from validation.formulas.runge_kutta import solution
from validation.stability.hard_case import Frontier, HardCase, make
from validation.stability.run_measures import Run, drift, energy, measured
from validation.stability.scene_parts import GRAVITY, LAGRANGE, Document, G, check, disc, level, rod

SECOND = 1.9
"""The least power of the step with which an error of second order must fall."""

NEAR, ECCENTRICITY, PULL = 1.5, 0.5, 8.0  # m, 1, m³/s²
YEAR = kepler_period(NEAR / (1 - ECCENTRICITY), PULL)  # s

RATE = 960.0  # Hz


def orbit(rate: float = 480) -> Document:
    """Return Kepler's ellipse of e = 0.5."""
    speed = np.sqrt(PULL * (1 + ECCENTRICITY) / NEAR)
    return level(
        "An ellipse, twenty turns",
        "A Kepler ellipse with e = 0.5. Leapfrog must keep its energy, turn after turn.",
        "5. Work and energy: potential energy and conservative forces",
        effects={"attraction": [{"mu": PULL}]},
        bodies={
            "planet": disc((NEAR, 0), 0.15, velocity=[0, float(speed)]),
            "sun": {"type": "static", "shape": {"type": "disc", "radius": 0.4}},
        },
        stepping={"rate": rate},
        duration=round(2 * YEAR, 3),
        checks=[
            check("planet.energy", -PULL * (1 - ECCENTRICITY) / (2 * NEAR), 1e-3, "energy"),
            check("system.angular_momentum", float(NEAR * speed), 1e-9, "angular momentum"),
        ],
        view={"center": [-1.5, 0], "width": 10},
    )


def distance_from_orbit(run: Run) -> float:
    """Return the largest distance of a planet from Kepler's ellipse, relative to its perihelion."""
    expected = np.stack(kepler_place(NEAR, ECCENTRICITY, PULL, run.states.t), axis=1)
    apart = run.states.position[:, 0] - expected
    return float(np.hypot(apart[:, 0], apart[:, 1]).max() / NEAR)


def pendulum(degrees: float, rate: float = RATE, far: float = 0.0) -> Document:
    """Return a pendulum of 1 m that is released at an angle, at some position [m]."""
    angle = np.radians(degrees)
    return level(
        f"A pendulum of {degrees:g}°",
        "A pendulum of large amplitude, compared with its elliptic integral.",
        LAGRANGE,
        effects=GRAVITY,
        bodies={"bob": disc((far + np.sin(angle), -np.cos(angle)), 0.1)},
        joints={"rod": rod([far, 0], "bob")},
        stepping={"rate": rate},
        duration=10,
        checks=[check("rod.length", 1, 1e-12, "length of the rod")],
        view={"center": [far, 0], "width": 5},
    )


def angle_error(run: Run) -> float:
    """Return the error of a pendulum's angle, relative to its amplitude.

    The period is from the complete elliptic integral, the motion within it by Runge and Kutta.
    """
    x, y = run.states.position[:, 0].T
    amplitude = float(np.arctan2(x[0], -y[0]))
    phase = run.states.t % pendulum_period(1.0, G, amplitude)
    order = np.argsort(phase)
    true = np.empty_like(phase)
    true[order] = solution(_falls, np.array([amplitude, 0.0]), phase[order])[0]
    apart = np.angle(np.exp(1j * (np.arctan2(x, -y) - true)))
    return float(np.abs(apart).max() / amplitude)


def _falls(y: Array) -> Array:
    return np.array([y[1], -G * np.sin(y[0])])


def distance_from_reference(run: Run) -> float:
    """Return the distance of a double pendulum's bobs from the Euler-Lagrange solution [m]."""
    start = np.radians(run.level.defaults["angle"])
    a, b = solution(_double, np.array([start, start, 0.0, 0.0]), run.states.t)[:2]
    upper = np.stack((np.sin(a), -np.cos(a)), axis=1)
    lower = upper + 0.8 * np.stack((np.sin(b), -np.cos(b)), axis=1)
    apart = run.states.position - np.stack((upper, lower), axis=1)
    return float(np.hypot(apart[..., 0], apart[..., 1]).max())


def _double(y: Array) -> Array:
    """Equal masses on rods of 1 m and 0.8 m.

    2 a'' + l b'' cos(a - b) = -l b'² sin(a - b) - 2 g sin a;
    l b'' + a'' cos(a - b) = a'² sin(a - b) - g sin b.
    """
    a, b, u, w = y
    c, s, ln = np.cos(a - b), np.sin(a - b), 0.8
    matrix = np.array([[2.0, ln * c], [c, ln]])
    right = np.array([-ln * w * w * s - 2 * G * np.sin(a), u * u * s - G * np.sin(b)])
    return np.concatenate(([u, w], np.linalg.solve(matrix, right)))


def damped_error(run: Run) -> float:
    """Return the error of a damped spring from its closed form, relative to its amplitude."""
    p = run.level.defaults
    true = 1 + damped_oscillation(run.states.t, 2.0, 50.0, p["c"], p["A"])
    return float(np.abs(measured(run, "block.position.x") - true).max() / p["A"])


def stiff(share: float = 1.99, rate: float = RATE) -> Document:
    """Return a spring with a given ω dt."""
    stiffness = (share * rate) ** 2
    return level(
        f"A spring at ω dt = {share:g}",
        "At ω dt = 2 leapfrog becomes unstable. Just below that, it must not.",
        LAGRANGE,
        effects={},
        bodies={"block": disc((1.01, 0), 0.1)},
        joints={
            "spring": {
                "type": "spring",
                "ends": [[0, 0], "block"],
                "stiffness": stiffness,
                "length": 1,
            }
        },
        stepping={"rate": rate},
        duration=2,
        checks=[check("block.position.y", 0, 1e-9, "distance from its line")],
        view={"center": [0.6, 0], "width": 3},
    )


def largest_swing(run: Run) -> float:
    """Return the largest displacement of a spring, relative to its initial amplitude."""
    return float(np.abs(measured(run, "block.position.x") - 1).max() / 0.01)


def is_refused(_scene: Level, duration: float) -> float:
    """Return the same for a spring beyond ω dt = 2, until it is refused."""
    far = 0.0
    try:
        world = build(make(stiff(2.01)))
        for _ in range(round(duration * RATE)):
            far = max(far, abs(float(world.advance().position[0, 0]) - 1) / 0.01)
    except SimulationError:
        return far
    return inf


def loses_spin(run: Run) -> float:
    """Return the relative loss of spin."""
    spin = measured(run, "rod.angular_velocity")
    return float(np.abs(spin[1:] / spin[0] - 1).max())


LEVELS = {
    "orbit-of-20-turns": orbit,
    "pendulum-of-90": lambda: pendulum(90),
    "pendulum-of-170": lambda: pendulum(170),
    "spring-at-its-limit": stiff,
}


def cases() -> Iterator[HardCase]:
    """Yield the cases that should converge."""
    yield from _orbits_and_pendulums()
    yield from _springs()
    yield from _steady()


def _orbits_and_pendulums() -> Iterator[HardCase]:
    yield HardCase(
        name="Kepler's orbit, e = 0.5, 20 turns: energy", group="B",
        level="hard/orbit-of-20-turns", duration=20 * YEAR, quick=3 * YEAR, every_step=True,
        criterion="leapfrog's energy swings with (ω dt)² and does not drift", figure=energy,
        bound=1e-4, order=SECOND,
    )  # fmt: skip
    for degrees, bound in ((90, 1e-3), (170, 5e-2)):
        yield HardCase(
            name=f"a pendulum of {degrees}° for 60 s", group="B",
            level=f"hard/pendulum-of-{degrees}", duration=60, quick=10,
            criterion="the angle from that of the elliptic integral, of the amplitude; its error "
            "grows with time and with dt²", figure=angle_error, bound=bound, order=SECOND,
        )  # fmt: skip
    yield HardCase(
        name="a double pendulum, 3 s", group="B", level="lagrange/double-pendulum",
        criterion="places [m] from those of the Euler-Lagrange equations, by Runge and Kutta",
        figure=distance_from_reference, bound=1e-2, order=SECOND,
    )  # fmt: skip
    yield HardCase(
        name="a double pendulum, a million steps", group="C",
        level="lagrange/double-pendulum", figure=energy, bound=1e-3, duration=1e6 / 3000,
        quick=10, criterion="chaotic, yet its energy stays, to 1e-3 of the largest kinetic",
    )  # fmt: skip


def _springs() -> Iterator[HardCase]:
    for c, about in ((3.0, "a damped"), (20.0, "a critically damped"), (60.0, "an overdamped")):
        yield HardCase(
            name=f"{about} spring", group="B", level="energy/damped-spring",
            parameters={"c": c}, criterion="the closed form, of the amplitude", figure=damped_error,
            bound=1e-3, order=SECOND,
        )  # fmt: skip
    yield HardCase(
        name="a spring at ω dt = 1.99", group="B", level="hard/spring-at-its-limit",
        criterion="leapfrog's ellipse: at most 1/√(1 - (ω dt/2)²) times the amplitude",
        figure=largest_swing, bound=1.01 / np.sqrt(1 - (1.99 / 2) ** 2), duration=60, quick=10,
        every_step=True,
    )  # fmt: skip
    yield HardCase(
        name="a spring at ω dt = 2.01 is refused", group="B",
        level="hard/spring-at-its-limit",
        criterion="the run must be refused, or stop before the spring swings ten times as far",
        special=is_refused,
        bound=10,
        duration=10,
    )  # fmt: skip


def _steady() -> Iterator[HardCase]:
    yield HardCase(
        name="a spinning rod: loss of spin", group="B", level="hard/spinning-rod",
        criterion="nothing slows it: off by (ω dt)²/8 at the most, the mean of two chords",
        figure=loses_spin, bound=1.01 * 0.01**2 / 8, duration=60, quick=10,
    )  # fmt: skip
    yield HardCase(
        name="a block on 30° at 0.6: creep", group="B", level="hard/no-creep",
        criterion="friction holds it: not a micrometre in 10 s", figure=drift, bound=1e-6,
        duration=10,
    )  # fmt: skip


def frontiers() -> Iterator[Frontier]:
    """Yield the frontiers of a step's length and a spring's stiffness."""
    yield Frontier(
        name="the step of an orbit", axis="step", unit="s",
        scene=lambda dt: orbit(1 / dt), figure=distance_from_orbit, bound=0.01,
        criterion="a hundredth of the perihelion from Kepler's ellipse after two turns",
        start=1e-3, end=0.1, duration=2 * YEAR,
    )  # fmt: skip
    yield Frontier(
        name="the step of a pendulum", axis="step", unit="s",
        scene=lambda dt: pendulum(90, 1 / dt), figure=energy, bound=1e-3,
        criterion="energy to 1e-3 over 10 s", start=1e-3, end=0.2, duration=10,
    )  # fmt: skip
    yield Frontier(
        name="a pendulum far away", axis="distance", unit="m",
        scene=lambda x: pendulum(90, 480, x), figure=energy, bound=1e-3,
        criterion="energy to 1e-3 over 5 s, wherever the origin is", start=1, end=1e15, duration=5,
    )  # fmt: skip
    yield Frontier(
        name="the stiffness of a spring", axis="stiffness", unit="N/m",
        scene=lambda k: stiff(float(np.sqrt(k)) / RATE), figure=largest_swing, bound=2.0,
        criterion="it never swings twice as far as at its start", start=1e3, end=1e12, duration=1,
    )  # fmt: skip
