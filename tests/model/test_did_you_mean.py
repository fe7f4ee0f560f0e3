"""What a person probably meant."""

import pytest

from sandbox.model.did_you_mean import closest, did_you_mean, suggestion
from sandbox.model.errors import brief

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
