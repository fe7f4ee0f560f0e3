"""A level of a few lines, and the result of a command on it."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

Write = Callable[..., Path]


class Outcome(NamedTuple):
    status: int
    out: str
    err: str


Run = Callable[..., Outcome]


def fall() -> dict[str, Any]:
    """A ball falls from 10 m for a second."""
    return {
        "format": 1,
        "title": "Fall",
        "summary": "A ball falls.",
        "parameters": {"g": {"value": 9.81, "min": 0, "max": 25, "unit": "m/s²"}},
        "effects": {"gravity": {"acceleration": [0, "-g"]}},
        "bodies": {
            "ball": {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": [0, 10]},
            "floor": {"type": "static", "shape": {"type": "box", "width": 5, "height": 1}},
        },
        "duration": 1,
        "checks": [height()],
    }


def height(formula: str = "10 - g*t**2/2", **parts: object) -> dict[str, Any]:
    return {"quantity": "ball.position.y", "formula": formula, "tolerance": 1e-12, **parts}


WRONG = height("10 - g*t**2/3")
NEVER = height(at={"event": "landing", "body": "ball", "height": -100})
