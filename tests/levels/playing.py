"""A level that runs, and the fingerprint of a run."""

from hashlib import sha256
from math import inf
from typing import NamedTuple

from sandbox.model.level import Level
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, needed
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World

LONG = 500
"""Steps after which a run that is not the same in another process has shown it."""


class Played(NamedTuple):
    """A level that ran to its end, its states at every step, and what its checks need of them."""

    world: World
    states: Snapshot
    trace: Trace


def play(level: Level, most: float = inf) -> Played:
    """Run a level to its end, or for a number of steps."""
    world = build(level)
    recorder, states = Recorder(world, needed(level)), [world.snapshot]
    for _ in range(int(min(count_steps(world), most))):
        states.append(world.advance())
        recorder.note()
    return Played(world, Snapshot.stack(states), recorder.trace)


def fingerprint(states: Snapshot) -> str:
    """Return a hash of everything that moved in the first steps of a run."""
    parts = (states.position, states.velocity, states.angle, states.tension)
    return sha256(b"".join(part[: LONG + 1].tobytes() for part in parts)).hexdigest()
