"""What is known of a fall that nobody can foretell."""

import numpy as np

from sandbox.physics.run import simulate
from validation.case import textbook

DEEPEST = 1e-3  # m: what falls is met within its step, and only a part that turns may overlap
WEIGHT = 68 * 9.81  # N


def test_a_ragdoll_gains_no_energy_but_what_lifts_it_out_of_the_stairs() -> None:
    """Measured: 0.11 J of 0.67, while 904 J are lost."""
    level = textbook("machines/ragdoll")

    energy = simulate(level, duration=1.0, record=["system.energy"]).columns["system.energy"]

    above = energy - np.minimum.accumulate(energy)
    assert above.max() <= WEIGHT * DEEPEST
    assert energy[0] - energy[-1] > 500
