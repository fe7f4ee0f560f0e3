"""Every challenge of the catalog can be solved, and is not solved by doing nothing."""

import pytest

from sandbox.model import level_catalog
from sandbox.model.level import Level
from sandbox.model.loading import load
from sandbox.physics.measuring.challenge_goals import Attempt, attempt
from sandbox.physics.run import simulate
from tests.sample import sampled

LEVELS = {name: load(level_catalog.find(name)) for name in level_catalog.challenges()}

LEAST = 15
"""How many there are at the least."""


def played(level: Level, settings: dict[str, float]) -> Attempt:
    """Play a challenge with some of its free parameters changed."""
    found = attempt(simulate(level, {**level.defaults, **settings}))
    assert found is not None
    return found


def test_there_are_challenges_of_every_chapter() -> None:
    assert len(LEVELS) >= LEAST
    chapters = {level.reference.partition(".")[0] for level in LEVELS.values()}
    assert {"4", "5", "6", "7", "8", "9"} <= chapters


@pytest.mark.parametrize("name", sampled(LEVELS, "its start"))
def test_is_not_solved_by_its_starting_values(name: str) -> None:
    assert played(LEVELS[name], {}).stars == 0


@pytest.mark.sweep
@pytest.mark.parametrize("name", LEVELS)
def test_its_solution_earns_every_star(name: str) -> None:
    level = LEVELS[name]
    assert level.challenge is not None
    found = played(level, dict(level.challenge.solution))

    assert found.stars == found.possible_stars == 3
    assert level.challenge.hints
