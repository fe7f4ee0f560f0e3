"""A progress bar is for terminals: elsewhere nothing is written, not even after an error."""

from collections.abc import Iterator

import pytest

from sandbox import progress_bar


def failing() -> Iterator[int]:
    """Yield a thing, then raise an error."""
    yield 1
    raise ValueError("no more")


def test_items_come_in_order(capsys: pytest.CaptureFixture[str]) -> None:
    assert progress_bar.consume(iter("abc"), "Reading", 3) == ["a", "b", "c"]
    assert capsys.readouterr() == ("", "")


def test_after_an_error_nothing_is_written_either(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(ValueError, match="no more"):
        progress_bar.consume(failing(), "Reading", 2)
    assert capsys.readouterr() == ("", "")
