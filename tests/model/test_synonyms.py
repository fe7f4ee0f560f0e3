"""What newcomers write is answered by what the format calls it, and where it belongs."""

import json
from typing import Any

import pytest

from sandbox.model.did_you_mean import _WORDS
from sandbox.model.errors import LevelError
from sandbox.model.loading import parse


def told(*path: str, value: object) -> str:
    """Return the mistakes of a block on a floor in which something is put at a path."""
    floor = {"type": "segment", "start": [-5, 0], "end": [5, 0]}
    block: dict[str, Any] = {"shape": {"type": "box", "width": 0.4, "height": 0.4}, "mass": 1}
    level: dict[str, Any] = {
        "format": 1,
        "title": "T",
        "effects": {"gravity": {"acceleration": [0, -9.81]}, "contact": {}, "friction": {}},
        "bodies": {
            "floor": {"type": "static", "shape": floor, "friction": 0.5},
            "block": {**block, "position": [0, 0.2], "friction": 1},
        },
    }
    part = level
    for step in path[:-1]:
        part = part.setdefault(step, {})
    part[path[-1]] = value
    with pytest.raises(LevelError) as error:
        parse(json.dumps(level))
    return str(error.value)


@pytest.mark.parametrize(
    ("path", "value", "answer"),
    [
        ("effects.friction.coefficient", 0.3, "belongs to each body, as its 'friction'"),
        ("effects.restitution", {"coefficient": 1}, "belongs to each body, as its 'restitution'"),
        ("effects.drag", {"coefficient": 1}, "did you mean 'linear'?"),
        ("effects.gravity", 9.81, 'must be an object, {"acceleration": ...}'),
        ("effects.gravity.acceleration", -9.81, "must be a list, [x, y]"),
        ("effects.friction", True, "must be an object, {}"),
        ("effects.force", {}, 'must be a list, [{"body": ..., "force": ...}]'),
        ("effects.spring", {"k": 1}, "'spring' is a joint, declared under 'joints'"),
        ("effects.hinge", {}, "'pivot' is a joint, declared under 'joints'"),
        ("bodies.block.force", [1, 0], "it is an effect, declared under 'effects'"),
        ("bodies.block.shape", {"type": "circle", "radius": 1}, "did you mean 'disc'?"),
        ("bodies.block.shape", {"type": "rectangle"}, "did you mean 'box'?"),
        ("bodies.block.x", 1, "did you mean 'position'?"),
        ("bodies.block.mu", 0.3, "did you mean 'friction'?"),
        ("bodies.block.mass", "2 kg", "write no unit"),
        ("bodies.block.angle", "30°", "is written 30*deg"),
        ("bodies.block.fixed", True, "did you mean 'type'?"),
        ("joints.s", {"type": "string", "ends": ["block", [0, 2]]}, "did you mean 'rope'?"),
        ("joints.s", {"type": "hinge", "ends": ["block", [0, 2]]}, "did you mean 'pivot'?"),
        ("joints.s", {"type": "spring", "k": 1}, "did you mean 'stiffness'?"),
        ("joints.s", {"type": "rod", "bodies": ["block", [0, 2]]}, "did you mean 'ends'?"),
        ("parameters", {"m": 2}, 'must be an object, {"value": ..., "min": ..., "max": ...}'),
        ("stepping.dt", 0.01, "did you mean 'rate'?"),
        ("duration", "10 s", "write no unit"),
        ("events", [], 'must be an object, {"name": {"at": ...}}'),
    ],
)
def test_what_newcomers_write_is_answered_by_what_they_meant(
    path: str, value: object, answer: str
) -> None:
    assert answer in told(*path.split("."), value=value)


@pytest.mark.parametrize(
    ("check", "answer"),
    [
        ({"quantity": "block.x", "formula": "0"}, "did you mean 'block.position.x'?"),
        ({"quantity": "block.vy", "formula": "0"}, "did you mean 'block.velocity.y'?"),
        ({"quantity": "block.position.x", "formula": "x = 2*t"}, "only what is right of the ="),
        (
            {"quantity": "block.position.x", "formula": "0", "at": "contact"},
            'an event is written {"event": "contact", ...}',
        ),
    ],
)
def test_so_are_checks(check: dict[str, object], answer: str) -> None:
    assert answer in told("checks", value=[{"tolerance": 1e-3, **check}])


def test_a_misspelt_name_comes_before_a_word_for_another_one() -> None:
    assert "did you mean 'spring'?" in told("joints", "s", value={"type": "sprin", "ends": []})


def test_no_name_of_the_format_stands_for_itself() -> None:
    assert [name for name, words in _WORDS.items() if name in words.split()] == []
