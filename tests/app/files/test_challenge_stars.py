"""Stars are kept from one day to the next, and a damaged file of them does no harm."""

from pathlib import Path

import pytest

from sandbox.app.files import challenge_stars
from sandbox.app.files.challenge_stars import ChallengeStars


def test_stars_are_found_again_and_never_become_fewer() -> None:
    assert ChallengeStars().stars("Into the bucket") == 0

    assert ChallengeStars().earn("Into the bucket", 2) == ""
    ChallengeStars().earn("Into the bucket", 1)
    ChallengeStars().earn("Over the wall", 3)

    assert ChallengeStars().stars("Into the bucket") == 2
    assert ChallengeStars().stars("Over the wall") == 3


def test_two_windows_keep_each_others_stars() -> None:
    one, other = ChallengeStars(), ChallengeStars()

    one.earn("Into the bucket", 1)
    other.earn("Over the wall", 1)

    assert (ChallengeStars().stars("Into the bucket"), ChallengeStars().stars("Over the wall")) == (
        1,
        1,
    )


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"a": 9}', b'{"a": "x"}', b"\xff\xfe"])
def test_a_file_that_something_else_has_written_counts_as_none(content: bytes) -> None:
    challenge_stars.file().parent.mkdir(parents=True)
    challenge_stars.file().write_bytes(content)

    found = ChallengeStars()

    assert found.stars("a") == 0
    assert found.earn("a", 1) == ""
    assert ChallengeStars().stars("a") == 1
    aside = challenge_stars.file().with_name("stars.json.broken")
    assert (aside.read_bytes() if aside.exists() else b"") == content  # it may be mended


def test_stars_that_cannot_be_kept_count_until_the_window_is_closed(tmp_path: Path) -> None:
    (tmp_path / "stars").write_text("a file where the folder should be")
    found = ChallengeStars()

    why = found.earn("a", 3)

    assert "could not be saved" in why
    assert found.stars("a") == 3
