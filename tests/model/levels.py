"""Small levels that tests modify."""

import json
from collections.abc import Callable
from typing import Any

from sandbox.model.errors import LevelError, Mistake
from sandbox.model.level import Level
from sandbox.model.loading import parse

Data = dict[str, Any]
Change = Callable[[Data], None]


def bare() -> Data:
    """Return the data of a falling ball, with only what a level needs."""
    return {
        "format": 1,
        "title": "A ball",
        "parameters": {
            "m": {"value": 2, "min": 1, "max": 4, "unit": "kg", "label": "mass"},
            "g": {"value": 9.81, "min": 0, "max": 25, "unit": "m/s²"},
        },
        "effects": {"gravity": {"acceleration": [0, "-g"]}},
        "bodies": {"ball": {"shape": {"type": "disc", "radius": 0.5}, "mass": "m"}},
        "duration": 1,
        "checks": [
            {"quantity": "ball.position.y", "formula": "-g*t**2/2", "tolerance": 1e-9},
        ],
        "ghosts": {"ball": [0, "-g*t**2/2"]},
    }


def touching() -> Data:
    """Return the data of a ball above a floor, with every surface effect."""
    data = bare()
    data["effects"] |= {"contact": {}, "friction": {}, "restitution": {}, "rotation": {}}
    data["bodies"]["ball"] |= {"friction": 1, "restitution": 0.5, "position": [0, 2]}
    data["bodies"]["floor"] = {
        "type": "static",
        "shape": {"type": "segment", "start": [-5, 0], "end": [5, 0]},
        "friction": 0.3,
        "restitution": 1,
    }
    return data


def hanging() -> Data:
    """Return the data of two masses on a string over a peg."""
    data = bare()
    data["bodies"]["ball"]["position"] = [-1, 0]
    data["bodies"]["other"] = data["bodies"]["ball"] | {"position": [1, 0]}
    data["joints"] = {
        "string": {"type": "pulley", "ends": ["ball", "other"], "over": [[-1, 3], [1, 3]]}
    }
    return data


def setting(path: str, value: object) -> Change:
    """Return a change that puts a value at a path such as `bodies.ball.mass`."""

    def change(data: Data) -> None:
        *outside, last = path.split(".")
        part: Any = data
        for step in outside:
            part = part[int(step) if isinstance(part, list) else step]
        part[int(last) if isinstance(part, list) else last] = value

    return change


def changed(data: Data, *changes: Change) -> str:
    """Return the JSON text of some data after the changes."""
    for change in changes:
        change(data)
    return json.dumps(data, indent=2, ensure_ascii=False)


def level(data: Data, *changes: Change) -> Level:
    """Return the level of some data after the changes."""
    return parse(changed(data, *changes))


def mistakes(data: Data, *changes: Change) -> tuple[Mistake, ...]:
    """Return the mistakes of some data after the changes; empty if there are none."""
    return mistakes_in(changed(data, *changes))


def mistakes_in(text: str) -> tuple[Mistake, ...]:
    """Return the mistakes of a text; empty if there are none."""
    try:
        parse(text)
    except LevelError as error:
        return error.mistakes
    return ()


def said(found: tuple[Mistake, ...]) -> list[str]:
    """Return the mistakes as `path: rule`, without their places in the text."""
    return [f"{mistake.path}: {mistake.rule}" for mistake in found]
