"""Which rate a scene needs, from limits that are known without trying: those of its present state.

Leapfrog is stable up to ω dt = 2, for springs and for what swings between taut strings alike; what
moves further than its own width in a step may pass through what it should hit.
"""

from collections.abc import Container, Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from sandbox.physics.anchor import length
from sandbox.physics.build import Scene
from sandbox.physics.laws.spring import SpringForce
from sandbox.physics.outline import width
from sandbox.physics.snapshot import Snapshot
from sandbox.physics.stiffness import limit


class Need(NamedTuple):
    """A lower bound on the rate.

    Attributes
    ----------
    rate
        Which is just stable, or at which nothing is missed [Hz].
    subject
        The body or joint that asks for it.
    reason
        Why, in a few words.
    """

    rate: float
    subject: str
    reason: str


def needs(scene: Scene, now: Snapshot, located: Container[str] = ()) -> list[Need]:
    """Return what a scene asks of the rate in a state, the highest first.

    A taut string is as stiff across as its tension over its length, so a chain whose links are
    light asks for √(T / (m l)), about. Forces that are neither springs nor tensions are not looked
    at. Tensions and speeds change: ask again, or leave room.

    Parameters
    ----------
    scene, now
        What moves, and how.
    located
        The bodies whose impacts are located in time, so that they may be fast.
    """
    fast = _fast(scene, now, located)
    return sorted((*_springs(scene, now), *_taut(scene, now), *fast), reverse=True)


def _springs(scene: Scene, now: Snapshot) -> Iterator[Need]:
    rate, name = limit(scene.joints.springs, scene.agility, now.angle)
    if rate:
        yield Need(rate, name, "its stiffness")


def _taut(scene: Scene, now: Snapshot) -> Iterator[Need]:
    """Take taut joints for springs of the stiffness that they have across."""
    joints = scene.joints
    taut: dict[str, SpringForce] = {}
    for name, pulls in zip(joints.paths, now.tension.tolist(), strict=True):
        if name in joints.wires or name in joints.springs or not pulls > 0:
            continue
        for index, ends in enumerate(pairwise(joints.paths[name])):
            far = float(length(ends, now))
            if far > 0:
                taut[f"{index} {name}"] = SpringForce(ends, pulls / far, far, 0.0)
    rate, name = limit(taut, scene.agility, now.angle)
    if rate:
        yield Need(rate, name.partition(" ")[2], "its tension")


def _fast(scene: Scene, now: Snapshot, located: Container[str]) -> Iterator[Need]:
    """Ask that bodies go no further than they are wide, unless their impacts are located."""
    speeds = np.hypot(*now.velocity.T).tolist()
    for (name, body), speed, moves in zip(
        scene.bodies.items(), speeds, (scene.mass > 0).tolist(), strict=True
    ):
        wide = min(map(width, body.shapes), default=0.0)
        if moves and wide > 0 and speed > 0 and name not in located:
            yield Need(speed / wide, name, "its speed")
