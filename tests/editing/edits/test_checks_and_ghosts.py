"""Checks and ghosts: added where they apply, and completed from what is typed."""

import pytest

from sandbox.editing.edits.checks_and_ghosts import (
    add_checks,
    drop_check_or_ghost,
    quantity_completions,
    set_ghost,
)
from sandbox.model import level_catalog
from sandbox.model.errors import LevelError
from sandbox.model.loading import parse, read

TEXT = read(level_catalog.find("newton/atwood"))
LEVEL = parse(TEXT)


def test_a_check_is_added_and_taken_away() -> None:
    check = {"quantity": "right.velocity.x", "formula": 0, "tolerance": 1e-9}
    added = add_checks(TEXT, LEVEL, [check])
    assert parse(added).checks[-1].quantity == "right.velocity.x"
    assert drop_check_or_ghost(added, "checks", len(LEVEL.checks)) == TEXT


def test_a_check_of_nothing_is_refused_with_what_was_meant() -> None:
    check = {"quantity": "right.velocty.x", "formula": 0, "tolerance": 1e-9}
    with pytest.raises(LevelError, match=r"did you mean 'right\.velocity\.x'"):
        add_checks(TEXT, LEVEL, [check])


def test_a_ghost_is_set_and_taken_away() -> None:
    without = drop_check_or_ghost(TEXT, "ghosts", "left")
    assert "left" not in parse(without).ghosts
    assert parse(set_ghost(without, "left", (-0.6, "t"))).ghosts.keys() == {"left", "right"}


def test_names_are_completed_from_their_beginning_and_from_within() -> None:
    assert quantity_completions(LEVEL, "left.pos")[0] == "left.position.x"
    assert quantity_completions(LEVEL, "TENSION") == ["string.tension"]
    assert quantity_completions(LEVEL, "string.")[0] == "string.tension"
    assert quantity_completions(LEVEL, "nothing") == []
    assert "t" in quantity_completions(LEVEL, "")
