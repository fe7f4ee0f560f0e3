"""Goals of a challenge: met, missed, or open while the run can still decide them."""

import pytest

from sandbox.model.level import Level
from sandbox.physics.measuring.challenge_goals import Attempt, attempt
from sandbox.physics.run import simulate
from tests.physics.scenes import GRAVITY, G, Spec, disc, level

SPEED = 3 * G
"""m/s: it comes back to its start after six seconds."""


def thrown(*goals: Spec, stars: tuple[Spec, ...] = ()) -> Level:
    """Return a level in which a ball is thrown up for six seconds."""
    return level(
        {"ball": disc((0, 0), velocity=[0, "v"])},
        GRAVITY,
        parameters={"v": {"value": SPEED, "min": 0, "max": 100}},
        duration=6,
        challenge={
            "task": "Throw it.",
            "free": ["v"],
            "goals": [{"label": "goal", **goal} for goal in goals],
            "stars": [{"label": "star", **star} for star in stars],
            "solution": {},
        },
    )


def judged(scene: Level, duration: float = 6, **settings: float) -> Attempt:
    """Run a level for a while and judge it."""
    found = attempt(simulate(scene, {**scene.defaults, **settings}, duration))
    assert found is not None
    return found


def test_a_level_without_a_challenge_is_not_judged() -> None:
    assert attempt(simulate(level({"ball": disc((0, 0))}, GRAVITY), duration=0.1)) is None


@pytest.mark.parametrize(
    ("bounds", "standing"),
    [
        ({"above": 4.5 * G - 1e-9, "below": 4.5 * G + 1e-9}, "met"),
        ({"above": 4.5 * G + 1e-6}, "missed"),
        ({"below": 4.5 * G - 1e-6}, "missed"),
    ],
)
def test_a_goal_at_an_event_holds_its_quantity_against_both_bounds(
    bounds: Spec, standing: str
) -> None:
    """The apex of a throw with 3 g is at (3 g)² / 2g = 4.5 g."""
    apex = {"event": "apex", "body": "ball"}
    (outcome,) = judged(thrown({"quantity": "ball.position.y", "at": apex, **bounds})).outcomes

    assert outcome.standing == standing
    assert outcome.measured == pytest.approx(4.5 * G, rel=1e-12)
    assert outcome.t == pytest.approx(3, rel=1e-12)


def test_a_goal_without_an_instant_has_to_hold_at_every_step_to_the_end() -> None:
    scene = thrown({"quantity": "ball.velocity.y", "above": -2 * G})

    early, late = judged(scene, 4.9), judged(scene, 5.1)
    assert early.outcomes[0].standing == "open"
    assert late.outcomes[0].standing == "missed"
    assert late.outcomes[0].t == pytest.approx(5.1, abs=0.02)


def test_an_event_that_never_comes_is_open_until_the_run_is_over() -> None:
    landing = {"event": "landing", "body": "ball", "height": -5}
    scene = thrown({"quantity": "t", "at": landing, "below": 9})

    assert judged(scene, 3).outcomes[0].standing == "open"
    assert judged(scene).outcomes[0].standing == "missed"


def test_stars_count_once_every_goal_is_met() -> None:
    goal = {"quantity": "ball.position.y", "at": 1, "above": 20}
    stars = (
        {"quantity": "ball.speed", "at": 0, "below": 30},
        {"quantity": "ball.speed", "at": 0, "below": 28},
    )
    scene = thrown(goal, stars=stars)

    assert [judged(scene, v=v).stars for v in (20, 26, 29, 31)] == [0, 3, 2, 1]
    assert judged(scene, v=26).possible_stars == 3
    assert not judged(scene, v=20).solved


def test_a_goal_whose_bound_is_not_a_number_is_missed() -> None:
    """Nor is a bound that has no value with these parameters, though it has at their limits."""
    goal = {"quantity": "ball.position.y", "at": 1, "above": "1/(v - 50)"}

    assert judged(thrown(goal), v=50).outcomes[0].standing == "missed"


def test_no_star_counts_once_a_locked_parameter_is_changed() -> None:
    scene = level(
        {"ball": disc((0, 0), velocity=[0, "v"])},
        {"gravity": {"acceleration": [0, "-g"]}},
        parameters={
            "v": {"value": 1, "min": 0, "max": 100},
            "g": {"value": G, "min": 1, "max": 25},
        },
        duration=1,
        challenge={
            "task": "Throw it.",
            "free": ["v"],
            "goals": [{"label": "high", "quantity": "ball.position.y", "at": 1, "above": 5}],
            "solution": {"v": 12},
        },
    )

    assert judged(scene, 1, v=12).stars == 1
    cheated = judged(scene, 1, v=12, g=1)
    assert cheated.outcomes[0].standing == "met"
    assert (cheated.stars, cheated.changed_parameters) == (0, ("g",))
