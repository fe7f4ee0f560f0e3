"""What a manifest of effects must not say, and where it is told."""

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
