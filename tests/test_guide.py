"""The tutorial and the recipes are true: each of their levels loads, runs and meets its checks."""

import json
import re
from pathlib import Path

import pytest

import sandbox
from sandbox.model.level import Level
from sandbox.model.rules.level_validation import corners
from sandbox.physics.measuring.challenge_goals import Attempt, attempt

DOCS = Path(__file__).resolve().parents[1] / "docs"
BLOCK = re.compile(r"^```json\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TUTORIAL = BLOCK.findall((DOCS / "tutorial" / "first-level.md").read_text(encoding="utf-8"))
RECIPES = BLOCK.findall((DOCS / "how-to" / "recipes.md").read_text(encoding="utf-8"))
EVERY = [*TUTORIAL, *RECIPES]


def made(text: str) -> Level:
    return sandbox.make(json.loads(text))


def title(text: str) -> str:
    return str(json.loads(text)["title"])


def played(level: Level, settings: dict[str, float]) -> Attempt:
    found = attempt(sandbox.simulate(level, settings))
    assert found is not None
    return found


@pytest.mark.parametrize("text", EVERY, ids=title)
def test_every_level_of_the_guide_runs_and_keeps_its_checks(text: str) -> None:
    level = made(text)
    trace = sandbox.simulate(level)

    assert trace.t[-1] == pytest.approx(level.duration(level.defaults), abs=0.02)
    for result in sandbox.grade(trace):
        assert result.verdict == "passed", f"{result.check.label}: {result.error:.1e}"


@pytest.mark.sweep
@pytest.mark.parametrize("text", [text for text in EVERY if made(text).parameters], ids=title)
def test_every_level_of_the_guide_keeps_its_checks_at_the_ends_of_its_sliders(text: str) -> None:
    level = made(text)
    for values in corners(level):
        for result in sandbox.grade(sandbox.simulate(level, values)):
            assert result.verdict != "failed", f"{values}: {result.check.label}"


def test_the_tutorial_goes_on_from_nothing_to_a_challenge() -> None:
    levels = [made(text) for text in TUTORIAL]

    assert [bool(level.checks) for level in levels] == [False] * 3 + [True] * 3
    assert levels[0].effects.gravity is None
    assert [level.challenge is not None for level in levels] == [False] * 5 + [True]


def test_its_challenge_begins_unsolved_and_is_solved_by_the_values_that_the_page_shows() -> None:
    page = (DOCS / "tutorial" / "first-level.md").read_text(encoding="utf-8")
    shown = {name: float(value) for name, value in re.findall(r"--set (\w+)=([\d.]+)", page)}
    level = made(TUTORIAL[-1])
    assert level.challenge is not None

    assert played(level, {}).stars == 0
    assert played(level, {"speed": 11, "angle": 20}).stars == 0, "straight through the ring"
    assert shown == dict(level.challenge.solution)
    solved = played(level, shown)
    assert solved.stars == solved.possible_stars == 2


def test_the_wrong_formula_and_the_impact_that_is_not_located_fail_as_the_tutorial_says() -> None:
    wrong = made(TUTORIAL[3].replace("t - g*t**2/2", "t - g*t**2"))
    late = made(TUTORIAL[4].replace('{"located": ["ball"]}', "{}"))

    for level in (wrong, late):
        assert "failed" in {result.verdict for result in sandbox.grade(sandbox.simulate(level))}


def test_recipes_have_titles_of_their_own_and_nearly_all_check_themselves() -> None:
    levels = [made(text) for text in RECIPES]

    assert len({level.title for level in levels}) == len(levels) >= 20
    assert sum(not level.checks for level in levels) <= 1
