"""Plugins of a step: a level has those that it needs, and loads no others."""

import inspect
import json
from collections.abc import Callable

import pytest

from sandbox.model.level import Level
from sandbox.physics.engine.broadphase import CROWD
from sandbox.physics.run import build
from sandbox.physics.scene.make_scene import make_scene
from sandbox.physics.stepping import world
from sandbox.physics.stepping.plugins.register import PLUGINS
from sandbox.physics.stepping.step_plugin import set_up
from tests.elsewhere import python
from tests.physics.scenes import GRAVITY, atwood, disc, floor, level, orbit

CONTACT = {**GRAVITY, "contact": {}}
BALL = {"ball": disc((0, 1)), "floor": floor(-1)}
IN_SEQUENCE = {**CONTACT, "restitution": {"impacts": "sequence"}}

CALLS: dict[str, Callable[[], Level]] = {
    "events that act": lambda: level(
        {"ball": disc((1, 0))},
        GRAVITY,
        joints={"rod": {"type": "rod", "ends": [[0, 0], "ball"]}},
        events={"go": {"at": 0.01, "cut": ["rod"]}},
    ),
    "force laws": orbit,
    "motions of kinematic bodies": lambda: level(
        {"ball": disc(), "plate": {**floor(-1), "type": "kinematic", "motion": {"turn": "t"}}},
        GRAVITY,
    ),
    "joints": lambda: atwood(1, 2),
    "located impacts, and located ends of slipping": lambda: level(
        BALL, {**GRAVITY, "contact": {"located": ["ball"]}}
    ),
    "sequential impacts": lambda: level(
        {"ball": disc((0, 1), restitution=0.5), "floor": floor(-1, restitution=1)}, IN_SEQUENCE
    ),
    "contacts solved directly": lambda: level(BALL, {**GRAVITY, "contact": {"solver": "direct"}}),
    "one-way surfaces": lambda: level({**BALL, "floor": {**floor(-1), "one_way": "left"}}, CONTACT),
    "several drifts and kicks": lambda: orbit(scheme="fourth-order"),
    "the bounds of a crowd's grid": lambda: level(
        {f"ball{i}": disc((3 * i, 0)) for i in range(CROWD)}, CONTACT
    ),
}
"""A level that calls for each plugin."""


def called(scene: Level) -> list[str]:
    """The plugins that a level needs."""
    made = make_scene(scene, scene.defaults, scene.stepping)
    setup = set_up(scene, scene.defaults, scene.stepping, made)
    return [name for name, (wanted, _) in PLUGINS.items() if wanted(setup)]


@pytest.mark.parametrize("plugin", PLUGINS)
def test_each_stage_is_called_for_by_a_level_and_takes_part_in_its_steps(plugin: str) -> None:
    scene = CALLS[plugin]()

    assert plugin in called(scene)
    build(scene).advance(3)


def test_a_level_that_declares_nothing_special_has_no_stage() -> None:
    assert called(level({"ball": disc()}, GRAVITY)) == []
    assert called(level(BALL, CONTACT)) == []


LOADED = """
import json, pathlib, sys
from sandbox.model.loading import load
from sandbox.physics.stepping.make_world import make_world
level = load(pathlib.Path("levels/kinematics/free-fall.json"))
make_world(level, level.defaults, level.stepping).advance(3)
names = [name for name in sys.modules if name.startswith("sandbox.physics")]
print(json.dumps({name: len(open(sys.modules[name].__file__).readlines()) for name in names}))
"""

MOST = 3030
"""Lines of physics that a level of nothing but uniform gravity may load: comments and all."""


@pytest.mark.sweep
def test_what_a_plain_level_does_not_declare_is_not_even_loaded() -> None:
    loaded = json.loads(python("-c", LOADED).stdout)

    rooms = {name.split(".")[2] for name in loaded if name.count(".") > 1}
    assert rooms <= {"state", "engine", "forces", "joints", "scene", "guarding", "stepping"}
    assert not [name for name in loaded if "stepping.plugins." in name and "register" not in name]
    assert sum(loaded.values()) <= MOST


def test_a_world_fits_in_one_head() -> None:
    assert len(inspect.getsourcelines(world.World)[0]) <= 200
    assert len(vars(build(orbit()))) <= 12
