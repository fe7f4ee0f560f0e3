"""More exact joints than a step can solve are refused before their tables are made."""

import pytest

from sandbox.physics.joints.exact import joint_failures
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import GRAVITY, disc, level


def chained(count: int, *, apart: bool = False, free: int = 0) -> None:
    """Build rods that hang on each other, or pairs apart, beside bodies that are free."""
    bodies = {f"d{i}": disc((2 * i, 0)) for i in range(2 * count if apart else count + 1)}
    bodies |= {f"f{i}": disc((2 * i, 9)) for i in range(free)}
    starts = [2 * i if apart else i for i in range(count)]
    rods = {f"r{i}": {"type": "rod", "ends": [f"d{i}", f"d{i + 1}"]} for i in starts}
    build(level(bodies, GRAVITY, joints=rods))


@pytest.mark.sweep
def test_a_chain_longer_than_a_step_can_solve_is_refused_at_its_last_joint() -> None:
    with pytest.raises(SimulationError, match=r"joints\.r1199: the exact joints make 1,200 equat"):
        chained(1200)


def test_rods_apart_from_each_other_may_be_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(joint_failures, "MOST_PRODUCTS", 1000)  # 9² * 11, and no more

    chained(9, apart=True)
    with pytest.raises(SimulationError, match="10 equations among 11 bodies; at most 9 can"):
        chained(10)


def test_bodies_that_no_joint_holds_count_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(joint_failures, "MOST_TERMS", 100)

    chained(4, apart=True, free=10)
    with pytest.raises(SimulationError, match="4 equations among 28 bodies; at most 3 can"):
        chained(4, apart=True, free=20)
