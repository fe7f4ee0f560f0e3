"""Springs that a step is too long for are refused before they explode."""

from math import sqrt

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.errors import SimulationError
from sandbox.physics.world import build
from tests.physics.scenes import Spec, disc, level, measured

H = 1 / 60


def spring(*ends: object, stiffness: float, **rest: object) -> Spec:
    return {"type": "spring", "ends": list(ends), "stiffness": stiffness, **rest}


def pulled(stiffness: float, damping: float = 0, mass: float = 1) -> Level:
    """A ball drawn out by 0.1 m on a spring of a metre."""
    arm = spring([0, 0], "ball", stiffness=stiffness, damping=damping, length=1)
    return level({"ball": disc((1.1, 0), mass=mass)}, {}, joints={"arm": arm})


def chain(count: int, stiffness: float) -> Level:
    bodies = {f"b{i}": disc((i, 0), mass=2) for i in range(1, count + 1)}
    ends = [[0, 0], *bodies, [count + 1, 0]]
    joints = {f"k{i}": spring(*ends[i : i + 2], stiffness=stiffness) for i in range(count + 1)}
    bodies["b1"]["position"] = [1.01, 0]
    return level(bodies, {}, joints=joints)


@pytest.mark.parametrize("damping", [0.0, 0.1, 1.0])
def test_a_spring_just_below_the_limit_is_bounded(damping: float) -> None:
    """k h²/4 + c h = 0.99, of a kilogram: 1.99 = ω h without damping."""
    root = 2 * (sqrt(damping**2 + 0.99) - damping) / H
    found = measured(build(pulled(root**2, damping * root)), 3000, "ball.position.x")

    assert np.abs(found["ball.position.x"] - 1).max() <= 1.0


@pytest.mark.parametrize("damping", [0.0, 0.1, 1.0])
def test_a_spring_just_above_the_limit_is_refused(damping: float) -> None:
    root = 2 * (sqrt(damping**2 + 1.01) - damping) / H
    with pytest.raises(
        SimulationError, match=r"spring 'arm' needs a 'rate' of at least 61, not 60"
    ):
        build(pulled(root**2, damping * root))


def test_what_would_explode_says_how_high_a_rate_it_needs() -> None:
    """√(k/m) / 2: 500 Hz for 1e6 N/m at a kilogram."""
    with pytest.raises(SimulationError, match=r"needs a 'rate' of at least 500, not 60") as told:
        build(pulled(1e6))
    assert told.value.subject == "arm"


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_the_limit_of_a_chain_is_that_of_its_highest_mode(share: float) -> None:
    """ω² = 4 (k/m) sin²(n π / (2 (n + 1))), of n equal masses between n + 1 springs."""
    highest = 2 * np.sin(5 * np.pi / 12)
    scene = chain(5, 2 * (share * 2 / H / highest) ** 2)
    if share > 1:
        with pytest.raises(SimulationError, match="needs a 'rate' of at least 61"):
            build(scene)
    else:
        found = measured(build(scene), 2000, "b3.position.x")
        assert np.abs(found["b3.position.x"] - 3).max() < 0.2


def test_a_spring_at_the_rim_asks_for_more_than_one_at_the_centre() -> None:
    """1/m + r²/I = 3/m for the rim of a disc: √3 times the rate."""

    def scene(stiffness: float) -> Level:
        rim = {"body": "ball", "at": [0.5, 0]}
        arm = spring([1, 0], rim, stiffness=stiffness)
        return level({"ball": disc()}, {"rotation": {}}, joints={"arm": arm})

    build(scene(0.99 * 4 / H**2 / 3))
    with pytest.raises(SimulationError, match="at least 61"):
        build(scene(1.01 * 4 / H**2 / 3))


def test_the_spring_that_asks_for_most_is_named() -> None:
    scene = level(
        {"a": disc(), "b": disc((2, 0))},
        {},
        joints={
            "soft": spring([1, 1], "a", stiffness=10),
            "hard": spring("a", "b", stiffness=1e5),
        },
    )
    with pytest.raises(SimulationError, match="the spring 'hard' needs"):
        build(scene)
