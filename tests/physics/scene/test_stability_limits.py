"""Springs and drag that a step is too long for are refused before they explode."""

import tracemalloc
from math import cos, pi, sqrt
from pathlib import Path

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.model.loading import load
from sandbox.physics.run import build
from sandbox.physics.scene.stability_limits import MARGIN
from sandbox.physics.state.simulation_errors import SimulationError
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


@pytest.mark.sweep
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


def test_a_refused_spring_is_told_with_its_place_in_the_file(tmp_path: Path) -> None:
    file = tmp_path / "stiff.json"
    file.write_text(pulled(1e6).model_dump_json(indent=2, by_alias=True))
    line = file.read_text().splitlines().index('    "arm": {') + 1

    with pytest.raises(SimulationError) as told:
        build(load(file))

    said = f"{file}:{line}:5: joints.arm: the spring 'arm' needs a 'rate' of at least 500, not 60"
    assert str(told.value) == said


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


@pytest.mark.usefixtures("boundless")
def test_a_spring_that_no_rate_can_hold_is_refused() -> None:
    """ω² = 1e600 /s² is more than a number holds."""
    hard = spring([1, 0], "ball", stiffness=1e300)

    with pytest.raises(SimulationError, match=r"'hard' is infinitely stiff .* no 'rate' is enough"):
        build(level({"ball": disc(mass=1e-300)}, {}, joints={"hard": hard}))


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


def slowed(mass: float = 1, speed: float = 1, **drag: float) -> Level:
    """A ball that is slowed down, at 240 Hz."""
    ball = disc(mass=mass, velocity=[speed, 0])
    return level({"ball": ball}, {"drag": drag}, stepping={"rate": 240})


def test_a_drag_just_below_the_limit_dies_away() -> None:
    """c h / m = 0.99: what is left of the velocity changes sign each step, and shrinks."""
    speed = measured(build(slowed(linear=0.99 * 240)), 900, "ball.velocity.x")["ball.velocity.x"]

    assert np.abs(speed[-10:]).max() < 1e-3


@pytest.mark.parametrize(
    ("scene", "needed"),
    [
        (slowed(linear=1.01 * 240), "243"),
        (slowed(linear=1e6), "1,000,000"),
        (slowed(linear=2.5, mass=0.01), "250"),
        (slowed(quadratic=2, speed=150), "300"),
        (slowed(linear=100, quadratic=2, speed=100), "300"),
    ],
)
def test_a_drag_that_takes_more_than_all_in_a_step_is_refused(scene: Level, needed: str) -> None:
    says = (
        rf"effects.drag: the effect 'drag' on 'ball' needs a 'rate' of at least {needed}, not 240"
    )
    with pytest.raises(SimulationError, match=says):
        build(scene)


def test_gathered_matter_slows_down_as_drag_does() -> None:
    gathers = {"accretion": [{"body": "ball", "rate": 3}]}
    with pytest.raises(
        SimulationError, match="'accretion' on 'ball' needs a 'rate' of at least 300"
    ):
        build(level({"ball": disc(mass=0.01, velocity=[1, 0])}, gathers))


@pytest.mark.parametrize(("joint", "holds"), [("weld", True), ("rod", False)])
def test_what_is_welded_to_something_heavy_is_slowed_down_with_it(
    joint: str, *, holds: bool
) -> None:
    """1 g with a drag of 1 kg/s, which alone asks for 1000 Hz; on a rod it can go round."""
    scene = level(
        {"light": disc(mass=1e-3, velocity=[1, 0]), "heavy": disc((2, 0), velocity=[1, 0])},
        {"drag": {"linear": 1, "bodies": ["light"]}},
        joints={"tie": {"type": joint, "ends": ["light", "heavy"]}},
    )
    if holds:
        speed = measured(build(scene), 60, "light.velocity.x")["light.velocity.x"]
        assert speed[-1] == pytest.approx(np.exp(-1 / 1.001), rel=2e-4)  # 1.2e-4
    else:
        with pytest.raises(
            SimulationError, match="'drag' on 'light' needs a 'rate' of at least 1,000"
        ):
            build(scene)


@pytest.mark.parametrize("count", [100, 600])
def test_a_chain_of_any_length_needs_the_rate_of_its_stiffest_mode(count: int) -> None:
    """Of many springs only that mode is sought: all of them would take seconds and gigabytes."""
    with pytest.raises(SimulationError) as refused:
        build(chain(count, stiffness=8e8))

    stiffest = sqrt(8e8 / 2) * cos(pi / (2 * count + 2))  # half of 2 √(k/m) sin(...)
    assert refused.value.rate == pytest.approx(MARGIN * stiffest, rel=2e-5)


def test_a_drag_takes_no_more_room_than_the_joints_need() -> None:
    """1,500 balls, two of them on a rod: all their directions would fill 160 MB, and then twice."""
    bodies = {f"b{i}": disc((i, 0)) for i in range(1500)}
    joints: dict[str, Spec] = {"rod": {"type": "rod", "ends": ["b0", "b1"]}}
    scene = level(bodies, {"drag": {"linear": 1e4}}, joints=joints)
    tracemalloc.start()
    try:
        with pytest.raises(SimulationError):
            build(scene)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()

    assert most < 30e6


def test_torques_on_two_of_many_bodies_are_tried_on_these_alone() -> None:
    """A brake between two bodies; each body tried took as long as all of them together."""
    bodies = {f"b{i}": disc((i, 0)) for i in range(40)}
    brake = {"body": "b7", "against": "b9", "torque": "-1e4*omega"}
    scene = level(bodies, {"rotation": {}, "torque": [brake]})

    with pytest.raises(SimulationError) as refused:
        build(scene)

    alike = {"b7": bodies["b7"], "b9": bodies["b9"]}
    with pytest.raises(SimulationError) as pair:
        build(level(alike, {"rotation": {}, "torque": [brake]}))
    assert (refused.value.rate, refused.value.reason) == (pair.value.rate, pair.value.reason)


def test_a_slack_rope_leaves_the_limit_of_drag_as_it_is() -> None:
    """It holds nothing, so there was no equation to divide by."""
    rope = {"type": "rope", "ends": [[0, 0], "ball"], "length": 2}
    scene = level({"ball": disc((1, 0), mass=1)}, {"drag": {"linear": 500}}, joints={"rope": rope})

    with pytest.raises(SimulationError, match="needs a 'rate' of at least 501"):
        build(scene)
