"""Small levels for the tests."""

import json
from typing import Any

from sandbox.app.runs.session import Session
from sandbox.model import level_catalog
from sandbox.model.level import Level
from sandbox.model.loading import load, parse

BALL = "#ff0000"


def falling(**changes: object) -> str:
    """Return the JSON of a ball that falls freely for a second, at 60 steps a second."""
    level: dict[str, Any] = {
        "format": 1,
        "title": "A falling ball",
        "summary": "It falls.",
        "parameters": {
            "g": {"value": 10, "min": 0, "max": 20, "unit": "m/s²", "label": "gravity"},
            "mass": {"value": 1, "min": 0.5, "max": 2, "unit": "kg"},
        },
        "effects": {"gravity": {"acceleration": [0, "-g"]}},
        "bodies": {
            "ball": {
                "shape": {"type": "disc", "radius": 0.5},
                "mass": "mass",
                "position": [0, 5],
                "color": BALL,
            },
        },
        "duration": 1.0,
        "checks": [
            {"quantity": "ball.position.y", "formula": "5 - g*t**2/2", "tolerance": 1e-12},
            {
                "label": "half way", "quantity": "ball.speed", "formula": "g*t",
                "tolerance": 1e-12, "at": 0.5,
            },
        ],
        "ghosts": {"ball": [0, "5 - g*t**2/2"]},
        "view": {"center": [0, 2], "width": 16},
    }  # fmt: skip
    return json.dumps({**level, **changes})


def level(**changes: object) -> Level:
    """Return the falling ball, with some parts of the level changed."""
    return parse(falling(**changes))


def opened(name: str, steps: int = 0) -> Session:
    """Return a session of a level of the catalog, after some steps."""
    session = Session(load(level_catalog.find(name)))
    for _ in range(steps):
        session.step()
    return session


def play(session: Session, frame: float = 1 / 60) -> Session:
    """Play a session until it pauses by itself, at its end or where it has to stop."""
    session.playing = True
    while session.playing:
        assert not session.waiting
        assert session.world.steps < session.end
        session.update(frame, budget=10.0)
    return session


def runaway() -> str:
    """Return the JSON of a string whose lighter end is pulled into its peg."""
    disc = {"type": "disc", "radius": 0.1}
    return falling(
        parameters={"g": {"value": 10, "min": 0, "max": 20}},
        bodies={
            "up": {"shape": disc, "mass": 1, "position": [-1, 0]},
            "down": {"shape": disc, "mass": 9, "position": [1, 0]},
        },
        joints={"string": {"type": "pulley", "ends": ["up", "down"], "over": [[-1, 1], [1, 1]]}},
        checks=[],
        ghosts={},
        duration=9,
    )
