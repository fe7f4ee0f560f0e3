"""What a person probably meant."""

from collections.abc import Iterable
from difflib import get_close_matches

import pytest

from sandbox.model.did_you_mean import closest, did_you_mean, suggestion
from sandbox.model.errors import MAX_MISTAKES, brief
from tests.model.levels import bare, mistakes

EFFECTS = ["gravity", "contact", "friction"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("gravty", "gravity"),
        ("Gravity", "gravity"),
        ("GRAVITY", "gravity"),
        ("xyz", None),
        ("", None),
    ],
)
def test_a_slip_of_the_keyboard_is_seen_through(name: str, expected: str | None) -> None:
    assert closest(name, EFFECTS) == expected


def test_many_misspelt_names_are_compared_with_many_others_no_more_than_are_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """400 rods to bodies that are not there took 4 s: each was compared twice with 360 names."""
    compared = list[str]()

    def counted(name: str, names: Iterable[str], n: int, cutoff: float) -> list[str]:
        compared.extend([name] if names else [])
        return get_close_matches(name, names, n=n, cutoff=cutoff)

    monkeypatch.setattr("sandbox.model.did_you_mean.get_close_matches", counted)
    data = bare()
    knots = {"i": [0, 19], "j": 20}
    disc = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": ["i", "j"]}
    rod = {"type": "rod", "ends": ["knot{i}_{j}", "knt{i}_{j}"], "repeat": knots}
    data["bodies"]["knot{i}_{j}"] = {"repeat": knots, **disc}
    data["joints"] = {"rod{i}_{j}": rod}

    assert mistakes(data)
    assert len(compared) <= MAX_MISTAKES + 10
    compared.clear()
    assert closest("knt", [f"knot{i}" for i in range(1001)]) is None
    assert not compared


def test_a_message_ends_with_what_was_meant_or_with_what_there_is() -> None:
    assert suggestion("frction", EFFECTS) == did_you_mean("frction", EFFECTS) != ""
    assert suggestion("xyz", EFFECTS) == "; known: contact, friction, gravity"
    assert suggestion("xyz", EFFECTS, longest=1) == "; known: contact, …"
    assert suggestion("xyz", []) == "; there are none"
    assert did_you_mean("xyz", EFFECTS) == ""


@pytest.mark.parametrize("text", ["x" * 10**6, "a\nb", "\ud800", "\x1b[31m", "m/s² − ok"])
def test_what_a_file_holds_is_shown_on_one_short_line(text: str) -> None:
    assert brief(text).isprintable()
    assert len(brief(text)) <= 60
