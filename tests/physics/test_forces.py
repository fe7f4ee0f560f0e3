"""Force laws: each is minus the slope of its potential energy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sandbox.physics.forces import Attraction, Force, Gravity
from sandbox.physics.measure import Meter
from sandbox.physics.world import build
from tests.physics.scenes import GRAVITY, disc, fixed, level, orbit

NUMBER = st.floats(-5, 5)
XY = st.tuples(NUMBER, NUMBER)
LAWS = st.one_of(st.builds(Gravity, XY), st.builds(Attraction, mu=st.floats(-10, 10), center=XY))


@given(LAWS, st.lists(XY, min_size=1, max_size=4), st.floats(0.1, 100))
def test_force_is_minus_the_slope_of_the_potential(
    law: Force, places: list[tuple[float, float]], mass: float
) -> None:
    """Central differences at h = 1e-4: h² U''' / 6 of truncation, eps U / h of rounding."""
    position, masses, h = np.array(places), np.full(len(places), mass), 1e-4
    if isinstance(law, Attraction):
        distance = np.hypot(*(position - np.array(law.center)).T)
        position = position[distance > 0.5]
        masses = masses[distance > 0.5]
    force = law.force(position, masses)

    for axis in (0, 1):
        step = h * np.eye(2)[axis]
        ahead, behind = (law.potential_energy(position + s, masses) for s in (step, -step))
        slope = (ahead - behind) / (2 * h)
        assert force[:, axis] == pytest.approx(-slope, abs=1e-5 * mass)


@given(LAWS, st.integers(1, 4), st.integers(1, 4))
def test_a_law_is_the_same_for_one_step_and_for_a_run(law: Force, steps: int, count: int) -> None:
    position = 7 + np.arange(steps * count * 2, dtype=float).reshape(steps, count, 2)
    mass = 1 + np.arange(count, dtype=float)
    together = law.force(position, mass), law.potential_energy(position, mass)

    assert together[0].shape == (steps, count, 2)
    for i in range(steps):
        assert np.array_equal(together[0][i], law.force(position[i], mass))
        assert np.array_equal(together[1][i], law.potential_energy(position[i], mass))


def test_centres_add_up_and_gravity_comes_on_top() -> None:
    centres = [{"mu": 8, "center": [2, 0]}, {"mu": -1, "center": [0, -1]}]
    world = build(level({"probe": disc()}, {**GRAVITY, "attraction": centres}))

    assert world.snapshot.acceleration[0] == pytest.approx([8 / 4, 1 - 9.81], rel=1e-12)


def test_a_sun_at_the_centre_of_attraction_neither_moves_nor_counts() -> None:
    """What nothing moves has no mass here, and no energy; 0/0 would be neither."""
    bodies = {
        "sun": fixed({"type": "disc", "radius": 0.1}),
        "planet": disc((1, 0), velocity=[0, 1]),
    }
    world = build(level(bodies, {"attraction": [{"mu": 1}]}))
    meter = Meter(world, ["system.energy", "sun.energy", "planet.energy"])
    energies = meter(world.advance(60))

    assert energies["sun.energy"] == 0
    assert energies["system.energy"] == energies["planet.energy"] == pytest.approx(-0.5, abs=1e-4)
    assert world.snapshot.position[0].tolist() == [0, 0]


def test_a_negative_parameter_repels() -> None:
    assert build(orbit(speed=0, mu=-1)).snapshot.acceleration[0] == pytest.approx([1, 0])
