"""Every quantity has one name and a unit."""

from math import inf
from time import process_time

import pytest

from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.quantities import TIME, Quantity, QuantityError, quantities, quantity
from tests.model.levels import bare, hanging, level

LEVEL = level(hanging())


@pytest.mark.parametrize("expected", list(quantities(LEVEL)), ids=lambda q: q.name)
def test_every_quantity_is_found_by_its_name(expected: Quantity) -> None:
    assert quantity(expected.name, LEVEL) == expected
    assert expected.unit


def test_names_are_unique() -> None:
    names = [quantity.name for quantity in quantities(LEVEL)]

    assert len(names) == len(set(names))


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("t", TIME),
        ("ball.speed", Quantity("ball.speed", "body", "ball", "speed", None, "m/s")),
        ("ball.velocity", Quantity("ball.velocity", "body", "ball", "velocity", None, "m/s")),
        ("ball.position.y", Quantity("ball.position.y", "body", "ball", "position", "y", "m")),
        (
            "ball.contact.normal",
            Quantity("ball.contact.normal", "body", "ball", "contact.normal", None, "N"),
        ),
        ("string.tension", Quantity("string.tension", "joint", "string", "tension", None, "N")),
        ("system.energy", Quantity("system.energy", "system", "system", "energy", None, "J")),
    ],
)
def test_a_name_is_taken_apart(name: str, expected: Quantity) -> None:
    assert quantity(name, LEVEL) == expected


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("", "known: ball, other, string, system, t"),
        ("ball", "'ball' is not a quantity"),
        ("bal.speed", "did you mean 'ball.speed'?"),
        ("ball.sped", "did you mean 'ball.speed'?"),
        ("ball.tension", "did you mean"),
        ("ball.position.z", "did you mean 'ball.position"),
        ("zzz.speed", "known: ball, other, string, system, t"),
        ("string.xyz", "did you mean 'string.length'?"),
        ("t.x", "is not a quantity"),
        ("x" * 10**6, "…"),
    ],
)
def test_an_unknown_name_is_told_with_what_was_meant(name: str, told: str) -> None:
    with pytest.raises(QuantityError) as caught:
        quantity(name, LEVEL)

    assert told in str(caught.value)
    assert len(str(caught.value)) < 800
    assert isinstance(caught.value, SandboxError)


@pytest.mark.sweep
def test_a_name_is_found_as_fast_among_thousands_of_bodies_as_alone() -> None:
    """All 40,000 quantities of 10,000 bodies took half a minute."""
    crowd = bare()
    crowd["bodies"] |= {f"b{i}": crowd["bodies"]["ball"] for i in range(9000)}
    alone, among = level(bare()), level(crowd)

    def took(where: Level) -> float:
        began = process_time()
        for _ in range(200):
            quantity("ball.position.y", where)
        return process_time() - began

    shortest = [inf, inf]
    for _ in range(3):
        shortest = [min(shortest[0], took(alone)), min(shortest[1], took(among))]

    assert shortest[1] < 3 * shortest[0]
