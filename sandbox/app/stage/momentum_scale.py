"""The momenta of moving bodies, and their scale for a whole run."""

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from sandbox.app.stage.frame_of_reference import FrameOfReference
from sandbox.app.stage.motion_annotations import PATH_POINTS, ghost_positions
from sandbox.app.words.formatting import rounded_up
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World

JUMP = 3.0
"""A ghost's speed above this multiple of the 95th percentile counts as a jump."""
UNIT = "kg·m/s"

_scales: WeakKeyDictionary[object, "_Kept"] = WeakKeyDictionary()


class _Kept(NamedTuple):
    """The scale of a run, with what identifies the run."""

    level: Level
    values: object
    disturbed: bool
    place: str | None
    scale: float


def bodies_with_momentum(world: World) -> list[tuple[int, str]]:
    """Return the rows and names of the bodies that have a momentum."""
    return [(i, name) for i, name in enumerate(world.scene.bodies) if world.scene.mass[i] > 0]


def momenta(world: World, snapshot: Snapshot, place: str | None = None) -> Array:
    """Return the momenta of bodies, (n, 2) or, for stacked snapshots, (k, n, 2) [kg m/s].

    They are as seen from a place, see `FrameOfReference`.
    """
    scene, velocity = world.scene, FrameOfReference(world, place).relative(snapshot.velocity)
    product: Array = (scene.mass * scene.mass_fraction(snapshot.t))[..., None] * velocity
    return product


def expected_largest(world: World) -> float:
    """Return the largest momentum at the start or of a ghost [kg m/s]."""
    t = np.linspace(0.0, count_steps(world) * world.dt, PATH_POINTS)
    peak, mass = _peak(momenta(world, world.snapshot)), dict(bodies_with_momentum(world))
    together = np.zeros((len(t) - 1, 2))
    count = 0
    for row, name in mass.items():
        formulas = world.level.ghosts.get(name)
        where = ghost_positions(formulas, world.values, t) if formulas else None
        if where is None:
            continue
        velocity = np.diff(where, axis=0) / t[1]
        speed = np.hypot(velocity[:, 0], velocity[:, 1])
        velocity[speed > JUMP * np.percentile(speed, 95)] = 0.0
        momentum = float(world.scene.mass[row]) * velocity
        together, count = together + momentum, count + 1
        peak = max(peak, float(np.hypot(momentum[:, 0], momentum[:, 1]).max()))
    if count == len(mass):
        peak = max(peak, _peak(together[:, None]))
    return peak


def scale(owner: object, world: World, observed: Snapshot, place: str | None = None) -> float:
    """Return the momentum of a full bar, seen from a place [kg m/s]; 0 if nothing has moved yet.

    The scale is a round number that stays the same during a run, also when the run is rewound or
    repeated. It may grow if no ghost gives the largest momentum in advance. It lives as long as its
    owner, such as a session. `observed` are the states so far: one snapshot, or a stack.
    """
    last = _scales.get(owner)
    values, disturbed = dict(world.values), world.disturbed
    if last is None or last[:4] != (world.level, values, disturbed, place):
        estimate = expected_largest(world) if place is None else 0.0
        largest = max(estimate, _peak(momenta(world, observed, place)))
        last = _Kept(world.level, values, disturbed, place, rounded_up(largest))
    peak = _peak(momenta(world, world.snapshot, place))
    if peak > last.scale * (1 + 1e-9):
        last = last._replace(scale=rounded_up(peak))
    _scales[owner] = last
    return last.scale


def _peak(momentum: Array) -> float:
    """Return the largest magnitude of a body's momentum, or of the total momentum [kg m/s]."""
    every = np.concatenate((momentum, momentum.sum(axis=-2, keepdims=True)), axis=-2)
    return float(np.hypot(every[..., 0], every[..., 1]).max(initial=0.0))
