"""Many joints solved as a band move as they do when all are solved with all."""

import numpy as np
import pytest

from sandbox.model.level import Level, Stepping
from sandbox.physics.joints.exact import banded_systems, joint_system
from sandbox.physics.stepping.make_world import make_world
from tests.physics.scenes import GRAVITY, Spec, disc, level

LINKS = 60


def chain(*, turns: bool) -> Level:
    """Sixty discs in a row, let go level: rods between centres, or pivots at their rims."""
    bodies = {f"b{i}": disc((0.1 * (i + 1), 0), radius=0.05) for i in range(LINKS)}
    joints: dict[str, Spec] = {}
    for i in range(LINKS):
        before = f"b{i - 1}" if i else [0, 0]
        rod: Spec = {"type": "rod", "ends": [before, f"b{i}"]}
        ends = [{"body": f"b{i - 1}", "at": [0.05, 0]}, {"body": f"b{i}", "at": [-0.05, 0]}]
        at: Spec = {"type": "pivot", "ends": ends}
        joints[f"j{i}"] = at if turns and i else rod
    effects = {**GRAVITY, "rotation": {}} if turns else GRAVITY
    return level(bodies, effects, joints=joints, duration=1)


def net() -> Level:
    """A net of 8 by 8 knots, hung up at two corners and drawn taut by its own weight."""
    places = {f"k{i}{j}": (0.1 * i, -0.1 * j) for i in range(8) for j in range(8)}
    joints: dict[str, Spec] = {
        f"h{i}": {"type": "rod", "ends": [[0.1 * i, 0.1], f"k{i}0"]} for i in (0, 7)
    }
    for i in range(8):
        for j in range(8):
            for other in (f"k{i + 1}{j}", f"k{i}{j + 1}" if i % 2 else ""):
                if other in places:
                    joints[f"r{i}{j}{other}"] = {"type": "rod", "ends": [f"k{i}{j}", other]}
    bodies = {name: disc(at, radius=0.01) for name, at in places.items()}
    return level(bodies, GRAVITY, joints=joints, duration=1)


@pytest.mark.parametrize("scene", [chain(turns=False), chain(turns=True), net()])
def test_a_band_moves_as_the_whole_does(monkeypatch: pytest.MonkeyPatch, scene: Level) -> None:
    """Both are exact: after 40 steps they differ by rounding alone, whatever is looked at."""
    stepping = Stepping(rate=1000)
    found = make_world(scene, scene.defaults, stepping)
    together = found.scene.joints.together
    assert together is not None
    assert together.band is not None
    monkeypatch.setattr(joint_system, "FEWEST", 10_000)
    whole = make_world(scene, scene.defaults, stepping)
    assert whole.scene.joints.together is not None
    assert whole.scene.joints.together.band is None

    here, there = found.advance(40), whole.advance(40)

    assert np.abs(here.position - there.position).max() < 1e-12
    assert np.abs(here.velocity - there.velocity).max() < 1e-10
    assert np.abs(here.tension - there.tension).max() < 1e-8 * np.abs(there.tension).max()


def test_what_meets_everything_is_no_band() -> None:
    """Sixty rods on one body: each meets all the others."""
    hub = {"hub": disc((0, 0), radius=0.1)}
    rim = {f"b{i}": disc((np.cos(i), np.sin(i)), radius=0.01) for i in range(LINKS)}
    spokes: dict[str, Spec] = {
        f"s{i}": {"type": "rod", "ends": ["hub", f"b{i}"]} for i in range(LINKS)
    }
    scene = level(hub | rim, GRAVITY, joints=spokes, duration=1)
    joints = make_world(scene, scene.defaults, Stepping()).scene.joints.together

    assert joints is not None
    assert joints.band is None
    assert banded_systems.FEWEST <= LINKS
