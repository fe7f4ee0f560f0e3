"""Every quantity has one name and a unit."""

import pytest

from sandbox.model.errors import SandboxError
from sandbox.model.quantities import TIME, Quantity, QuantityError, quantities, quantity
from tests.model.levels import hanging, level

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
