"""Measures of a run: each is a number that physics bounds."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.joints import End, Held, points
from sandbox.model.level import Level, Stepping
from sandbox.model.shapes import evaluate
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World


class Run(NamedTuple):
    """The samples of a run; T instants, the first at the start."""

    level: Level
    """the level with its joints; for stock pymunk they are pymunk's own"""
    world: World
    states: Snapshot
    seconds: float
    """the processor time per second of the scene [s]"""


def measured(run: Run, quantity: str) -> Array:
    """Return a quantity at every instant: (T,)."""
    return Meter(run.world, [quantity])(run.states)[quantity]


def dynamic(run: Run) -> Array:
    """Return which bodies are dynamic: (n,)."""
    return np.array([body.type == "dynamic" for body in run.level.bodies.values()])


def drift(run: Run) -> float:
    """Return the largest distance of any body from its start [m]."""
    gone = run.states.position - run.states.position[0]
    return float(np.hypot(gone[..., 0], gone[..., 1])[:, dynamic(run)].max())


def energy(run: Run) -> float:
    """Return the largest deviation of the energy, relative to the largest kinetic energy."""
    total = measured(run, "system.energy")
    scale = np.abs(measured(run, "system.kinetic_energy")).max()
    return float(np.abs(total - total[0]).max() / scale)


def separation(run: Run) -> float:
    """Return the largest error of a rod's length, or gap of a pivot [m]."""
    worst = 0.0
    for joint in run.level.joints.values():
        path = points(joint)
        first, second = _way(path[0], run), _way(path[-1], run)
        apart = np.abs(second - first)
        worst = max(worst, float(np.abs(apart - apart[0]).max()))
    return worst


def _way(end: End, run: Run) -> Array:
    """Return the positions of a joint's end at all instants, as x + iy: (T,)."""
    values = run.level.defaults
    if not isinstance(end, str | Held):
        return np.full(run.states.t.shape, complex(*evaluate(end, values)))
    row = list(run.level.bodies).index(end.body if isinstance(end, Held) else end)
    x, y = run.states.position[:, row].T
    if not isinstance(end, Held):
        return np.asarray(x + 1j * y)
    turned = complex(*evaluate(end.at, values)) * np.exp(1j * run.states.angle[:, row])
    return np.asarray(x + 1j * y + turned)


def mass(run: Run, name: str) -> float:
    """Return the mass of a body [kg]."""
    return float(run.world.scene.bodies[name].mass)


def rows(run: Run, *names: str) -> list[int]:
    """Return the indices of bodies."""
    known = list(run.level.bodies)
    return [known.index(name) for name in names]


def naive_of(level: Level) -> World:
    """Return the world of a level in stock pymunk, at the level's rate."""
    return build(level, stepping=Stepping(rate=level.stepping.rate, scheme="symplectic-euler"))
