"""Every conservative level keeps its energy, over ten times as long as it lasts.

Leapfrog's energy is not constant: it swings with the square of the step. It must not drift.
"""

import numpy as np
import pytest

from sandbox.model import catalog
from sandbox.model.joints import Pivot, Pulley, Rail, Rod, Spring
from sandbox.model.level import Level
from sandbox.model.loading import load
from sandbox.physics.errors import SimulationError
from sandbox.physics.trace import Recorder, Trace, count_steps
from sandbox.physics.world import build

STRIDE = 5
"""Steps from one look to the next; no motion is so quick that its extremes fall between."""

CONSERVATIVE = {
    "gravity",
    "contact",
    "restitution",
    "rotation",
    "attraction",
    "gravitation",
    "force",
}

ENDS = {
    "newton/compound-pulley": "the wheel is drawn up to the peg",
    "energy/escape-velocity": "the slow one falls back into the centre, where 1/r has no end",
    "energy/well-one-over-r": "the probe falls back into the centre",
}
"""Levels whose scene is over when their time is."""

BOUNDS = {"lagrange/leapfrog-pendulum": 5e-5, "momentum/cradle": 1e-4}
"""Of the scale of a scene; 1e-5 where nothing else is said. The first takes the chapter's step, of
the other see `WANDERS`."""

WANDERS = {"momentum/cradle": "an impact within a step is met to second order, and they add up"}
"""Levels whose error may grow within their bound: 1.4e-5 at first, 8.0e-5 after ten durations."""

NOTHING = 1e-9
"""J, the scale of a scene in which nothing moves."""

ENERGIES = ("system.energy", "system.kinetic_energy", "system.potential_energy")


def conservative(level: Level) -> bool:
    """Whether nothing in a level takes or gives energy, whatever happens."""
    effects, values = level.effects, level.defaults
    bouncing = (
        effects.restitution is not None
        and not effects.restitution.pairs
        and all(b.restitution and b.restitution(values) == 1 for b in level.bodies.values())
    )
    return (
        level.stepping.scheme == "leapfrog"
        and set(effects.declared) <= CONSERVATIVE
        and (effects.contact is None or bouncing)
        and not any(force.frame == "body" for force in effects.force or ())
        and not any("t" in f.names for force in effects.force or () for f in force.force)
        and all(_lossless(joint, level) for joint in level.joints.values())
    )


def _lossless(joint: object, level: Level) -> bool:
    match joint:
        case Rod(length=length):
            return length is None or "t" not in length.names
        case Spring(damping=damping):
            return damping(level.defaults) == 0
    return isinstance(joint, Pivot | Pulley | Rail)


NAMES = [name for name in catalog.textbook() if conservative(load(catalog.find(name)))]


def watched(name: str) -> Trace:
    """Run a level for ten times its duration, or until its bodies run into something."""
    world = build(load(catalog.find(name)))
    recorder = Recorder(world, ENERGIES)
    times = 1 if name in ENDS else 10
    try:
        for _ in range(times * count_steps(world) // STRIDE):
            world.advance(STRIDE)
            recorder.note()
    except SimulationError:
        assert world.t > world.level.duration(world.values), "it must last as long as it says"
    return recorder.trace


def test_there_are_conservative_levels() -> None:
    assert len(NAMES) >= 20


@pytest.mark.parametrize("name", NAMES)
def test_energy_stays_within_its_bound_and_does_not_grow(name: str) -> None:
    total, kinetic, potential = (watched(name).columns[energy] for energy in ENERGIES)
    scale = max(np.abs(kinetic).max(), np.abs(potential).max(), NOTHING)
    error = np.abs(total - total[0]) / scale
    tenth = len(error) // 10 + 1

    assert error.max() <= BOUNDS.get(name, 1e-5)
    assert name in WANDERS or error[-tenth:].max() <= max(1.5 * error[:tenth].max(), 1e-12)
