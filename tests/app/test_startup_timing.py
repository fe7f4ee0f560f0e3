"""The first picture is timed in a separate program, from before its start."""

from time import perf_counter

import pygame
import pytest

from sandbox.app import main, window_benchmark
from sandbox.model.errors import SandboxError


@pytest.mark.sweep
def test_the_first_picture_is_there_after_one_flip(monkeypatch: pytest.MonkeyPatch) -> None:
    flipped: list[tuple[float, str]] = []
    flip = pygame.display.flip

    def watched() -> None:
        flip()
        flipped.append((perf_counter(), pygame.display.get_caption()[0]))

    monkeypatch.setattr(pygame.display, "flip", watched)
    shown = main.first_picture("newton/atwood")

    [(at, title)] = flipped
    assert at <= shown <= perf_counter()
    assert title.startswith("Atwood")


@pytest.mark.sweep
def test_a_start_is_timed_from_before_its_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(window_benchmark, "STARTS", 1)
    begun = perf_counter()
    took = window_benchmark.first_picture("newton/atwood")

    assert 0 < took < perf_counter() - begun


@pytest.mark.sweep
def test_a_program_that_fails_is_a_sentence() -> None:
    with pytest.raises(SandboxError) as raised:
        window_benchmark.first_picture("newton/atwod")

    message = str(raised.value)
    assert message.startswith("newton/atwod: a window that was started on it showed no picture: ")
    assert "did you mean 'newton/atwood'?" in message
    assert "Traceback" not in message


def test_a_program_that_shows_nothing_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(window_benchmark, "LIMIT", 0.05)

    with pytest.raises(SandboxError, match=r"newton/atwood: .* showed no picture in 0\.05 s"):
        window_benchmark.first_picture("newton/atwood")
