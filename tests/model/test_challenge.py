"""Challenges: the tasks of a level, and their mistakes."""

from typing import Any

import pytest

from sandbox.model.errors import LevelError
from tests.physics.scenes import GRAVITY, disc, floor, level

GOAL = {"label": "high", "quantity": "ball.position.y", "at": 1, "above": 1}
CHALLENGE: dict[str, Any] = {
    "task": "Throw it high.",
    "free": ["v"],
    "goals": [GOAL],
    "solution": {"v": 10},
}


def scene(**changes: object) -> None:
    """Read a level whose challenge differs from a correct one."""
    level(
        {"ball": disc((0, 0), velocity=[0, "v"]), "floor": floor(-9)},
        GRAVITY,
        parameters={"v": {"value": 1, "min": 0, "max": 20}, "w": {"value": 1, "min": 0, "max": 2}},
        duration="2 + 0*w",
        challenge={**CHALLENGE, **changes},
    )


def test_a_challenge_that_is_right_is_read() -> None:
    scene()


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"free": ["u"], "solution": {}}, "challenge.free.0: unknown parameter 'u'"),
        ({"free": ["v", "v"]}, "challenge.free.1: 'v' is named twice"),
        ({"solution": {"w": 1}}, "challenge.solution.w: 'w' is not one of the 'free' parameters"),
        ({"solution": {"v": 21}}, "challenge.solution.v: is 21, but must lie between 'min', 0"),
        ({"goals": []}, "challenge.goals: has 0 entries, but needs at least 1"),
        ({"goals": [{**GOAL, "quantity": "bal.speed"}]}, "did you mean 'ball.speed'?"),
        ({"goals": [{**GOAL, "above": "u"}]}, "challenge.goals.0.above: unknown parameter 'u'"),
        ({"goals": [{**GOAL, "below": "exp(700*u)"}]}, "goals.0.below: unknown parameter 'u'"),
        ({"goals": [{**GOAL, "below": "exp(700*20)"}]}, "goals.0.below"),
        ({"goals": [{**GOAL, "below": 0}]}, "is 1, but 'below' is 0: no value can meet both"),
        ({"goals": [{**GOAL, "at": 3}]}, "challenge.goals.0.at: is at 3 s, but the run lasts"),
        (
            {"stars": [{**GOAL, "at": {"event": "landing", "body": "floor"}}]},
            "challenge.stars.0.at.body: 'floor' is static, so its landing never happens",
        ),
        (
            {"goals": [{"label": "any", "quantity": "ball.speed"}]},
            "challenge.goals.0: needs 'above', 'below', or both",
        ),
    ],
)
def test_a_mistake_in_a_challenge_is_told_with_its_place(
    changes: dict[str, object], told: str
) -> None:
    with pytest.raises(LevelError) as refused:
        scene(**changes)
    assert told in str(refused.value)
