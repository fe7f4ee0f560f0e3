"""Runs of tests, with what their books leave unexplained."""

import numpy as np

from sandbox.model.level import Level
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.run import build
from sandbox.physics.state.snapshot import Snapshot


def course(scene: Level, duration: float) -> tuple[Snapshot, float, float]:
    """Return the last state, and the largest unexplained energy and momentum of a run."""
    world = build(scene)
    ledger, energy, momentum = Ledger(world), 0.0, 0.0
    for _ in range(round(duration * world.stepping.rate)):
        world.advance()
        ledger.note()
        energy = max(energy, abs(ledger.balance.unexplained))
        momentum = max(momentum, float(np.abs(ledger.balance.unexplained_impulse).max()))
    return world.snapshot, energy, momentum
