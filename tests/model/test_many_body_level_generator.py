"""Levels of many bodies."""

import json

import pytest

from sandbox.model.body import MAX_BODIES
from sandbox.model.level_writing import text
from sandbox.model.loading import MAX_BYTES, parse
from sandbox.model.many_body_level_generator import CROWDS, CrowdError, crowd
from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import simulate


@pytest.mark.parametrize("kind", CROWDS)
@pytest.mark.parametrize("count", [2, 7, 50])
def test_a_crowd_is_a_level_with_so_many_bodies(kind: str, count: int) -> None:
    level = parse(text(crowd(kind, count)))

    assert sum(body.type == "dynamic" for body in level.bodies.values()) == count


@pytest.mark.parametrize("kind", ["gas", "chain", "cluster"])
@pytest.mark.parametrize("count", [2, pytest.param(20, marks=pytest.mark.sweep)])
def test_a_crowd_keeps_its_checks(kind: str, count: int) -> None:
    """A gas keeps its energy to 2e-5, as three discs meet at once; links and rods to rounding."""
    for result in grade(simulate(parse(text(crowd(kind, count))), duration=2)):
        assert result.verdict == "passed", result


def test_a_pile_is_as_deep_however_many_there_are() -> None:
    """So the solver's task stays equally hard: at 60 Hz, a pile twice as deep sinks."""
    heights = []
    for count in (100, 5000):
        bodies = crowd("pile", count)["bodies"]
        heights.append(max(body["position"][1] for body in bodies.values() if "mass" in body))

    assert heights[0] == heights[1]


@pytest.mark.sweep
def test_the_largest_gas_can_be_loaded() -> None:
    said = text(crowd("gas", MAX_BODIES - 1))

    assert len(said.encode()) < MAX_BYTES
    assert len(json.loads(said)["bodies"]) == MAX_BODIES


@pytest.mark.parametrize(
    ("kind", "count", "message"),
    [
        ("gass", 10, "there is no scene 'gass'; did you mean 'gas'?"),
        ("gas", 0, "a gas must have between 1 and 9999 bodies, not 0"),
        ("chain", 301, "a chain must have between 1 and 300 bodies, not 301"),
    ],
)
def test_what_cannot_be_made_is_refused(kind: str, count: int, message: str) -> None:
    with pytest.raises(CrowdError, match=message):
        crowd(kind, count)
