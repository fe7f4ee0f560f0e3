"""The mistakes of a manifest of effects, and where they are reported."""

import json

import pytest

from sandbox.model.errors import LevelError
from sandbox.model.loading import parse

SCENE = """{"format": 1, "title": "x",
 "bodies": {"a": {"shape": {"type": "disc", "radius": 1}, "mass": 1}},
 "effects": %s}"""


@pytest.mark.parametrize(
    ("effects", "told"),
    [
        (
            '{"drag": {"linear": 1},\n  "drag": {"linear": 2}}',
            ":4:3: effects.drag: the key",
        ),
        ('{"drag": {"linear": 1, "bodies": ["b"]}}', ":3:47: effects.drag.bodies.0: unknown body"),
        ('{"drag": {"mu": 1}}', ":3:23: effects.drag.mu: unknown key 'mu'; it is a setting of"),
        ('{"drag": {}}', ":3:14: effects.drag: needs 'linear' or 'quadratic' greater than 0"),
        ('{"friction": {}}', ":3:14: effects.friction: 'friction' needs the effect 'contact'"),
        ('{"contact": {}}', ":3:14: effects.contact: 'contact' is declared but there is only one"),
        ('{"rotation": {}}', ":3:14: effects.rotation: 'rotation' is declared but nothing turns"),
        ('{"drga": {}}', ":3:14: effects.drga: unknown effect 'drga'; did you mean 'drag'?"),
    ],
)
def test_a_manifest_that_makes_no_sense_is_refused_at_its_place(effects: str, told: str) -> None:
    with pytest.raises(LevelError) as caught:
        parse(SCENE % effects, "level.json")

    assert f"level.json{told}" in str(caught.value)


@pytest.mark.sweep
def test_more_surfaces_than_can_touch_are_refused_but_may_be_drawn() -> None:
    """16 lines of 1,999 pieces and a disc; 15 lines are within bounds."""
    points = [[i, i % 2] for i in range(2000)]
    line = {"type": "static", "shape": {"type": "polyline", "points": points}}
    disc = {"shape": {"type": "disc", "radius": 1}, "mass": 1, "position": [0, 9]}
    for count, effects, fine in [(16, {"contact": {}}, False), (15, {"contact": {}}, True),
                                 (16, {"gravity": {"acceleration": [0, -1]}}, True)]:  # fmt: skip
        lines = {f"line{i}": line for i in range(count)}
        said = {"format": 1, "title": "x", "bodies": {"a": disc, **lines}, "effects": effects}
        if fine:
            assert len(parse(json.dumps(said)).bodies) == count + 1
        else:
            with pytest.raises(LevelError, match="have 31,985 surfaces in all; at most 30,000"):
                parse(json.dumps(said))
