"""A level that is too expensive per step is refused, with the number that is too large."""

from typing import Any

import pytest

from sandbox.model.rules.consistency import stepping
from tests.model.levels import Data, mistakes

BASE = {"format": 1, "title": "Sizes", "effects": {}}


def crowd(count: int, **rest: object) -> dict[str, Any]:
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, **rest}
    return {f"b{i}": {**ball, "position": [i, 0]} for i in range(count)}


def told(data: Data) -> list[tuple[str, str]]:
    return [(m.path, m.rule) for m in mistakes(data)]


@pytest.mark.parametrize(("count", "refused"), [(2000, False), (2001, True)])
def test_more_bodies_than_a_step_can_go_through_do_not_attract_each_other(
    count: int, refused: bool
) -> None:
    data = {**BASE, "bodies": crowd(count), "effects": {"gravitation": {"constant": 1}}}

    rule = (
        f"'gravitation' acts between every two of {count:,} bodies; a step can take at most 2,000"
    )
    assert told(data) == ([("effects.gravitation", rule)] if refused else [])


def test_only_those_that_attract_each_other_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stepping, "MOST_PULLS", 9)
    effects = {"gravitation": {"constant": 1, "bodies": ["b0", "b1", "b2"]}}

    assert told({**BASE, "bodies": crowd(8), "effects": effects}) == []


@pytest.mark.sweep
def test_more_centres_than_a_step_can_go_through_are_refused() -> None:
    effects = {"attraction": [{"mu": 1}] * 1000}

    ((path, rule),) = told({**BASE, "bodies": crowd(5000), "effects": effects})

    assert path == "effects.attraction"
    assert "5,000,000 forces, but a step can take at most 4,000,000" in rule


def arcs(count: int) -> dict[str, Any]:
    shape = {"type": "arc", "radius": 1, "start": 0, "end": 3}
    return {f"arc{i}": {"type": "static", "shape": shape, "position": [i, 0]} for i in range(count)}


def hoops(count: int) -> dict[str, Any]:
    shape = {"type": "hoop", "radius": 0.1}
    return {f"h{i}": {"shape": shape, "mass": 1, "position": [i, 0]} for i in range(count)}


def test_more_hollow_bodies_than_can_be_made_are_refused() -> None:
    """2,000 arcs took 7 s to check, and 1,000 hoops 13 s: each is prepared for each ball inside."""
    data = {**BASE, "effects": {"contact": {}}}

    ((_, rule),) = told({**data, "bodies": {**arcs(1501), **crowd(1)}})
    assert "30,021 surfaces in all" in rule
    ((_, rule),) = told({**data, "bodies": {**arcs(400), **crowd(251)}})
    assert "400 arcs, hoops and curves make 100,400 pairs" in rule
    ((_, rule),) = told({**data, "bodies": hoops(320)})
    assert "make 102,080 pairs" in rule
    assert told({**data, "bodies": {**arcs(400), **crowd(250)}}) == []


def test_more_pairs_that_stick_than_can_be_watched_are_refused() -> None:
    """A thousand bodies took 17 s to build, for half a million pairs."""
    data = {**BASE, "effects": {"contact": {}, "friction": {}}}

    few = {**data, "bodies": crowd(200, friction=0.3, static_friction=0.5)}
    many = {**data, "bodies": crowd(202, friction=0.3, static_friction=0.5)}

    assert told(few) == []
    ((path, rule),) = told(many)
    assert path == "bodies"
    assert "20,301 pairs of bodies" in rule
