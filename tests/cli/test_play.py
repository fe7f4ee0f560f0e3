"""`play`, and no command at all: how the window is opened, or is not opened."""

from pathlib import Path

import pytest

from sandbox.app import main as window
from sandbox.cli import tour as touring
from tests.cli.helpers import Run, Write

Opened = list[tuple[object, ...]]


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> Opened:
    """The arguments with which a window was opened, on a machine with a display."""
    calls: Opened = []
    monkeypatch.setattr(window, "has_display", lambda: True)

    def run(*arguments: object, racing: bool = False) -> None:
        calls.append((*arguments, "racing") if racing else arguments)

    monkeypatch.setattr(window, "run", run)
    return calls


@pytest.fixture
def no_display(opened: Opened, monkeypatch: pytest.MonkeyPatch) -> Opened:
    """The arguments with which a window was opened, on a machine without a display."""
    monkeypatch.setattr(window, "has_display", lambda: False)
    return opened


def test_a_level_is_opened_with_its_settings(run: Run, write: Write, opened: Opened) -> None:
    path = write()

    assert run("play", path, "--set", "g=1.6").status == 0
    assert opened == [(str(path), {"g": 1.6}, None)]


def test_a_level_is_opened_with_the_race_under_way(run: Run, write: Write, opened: Opened) -> None:
    path = write()

    assert run("play", path, "--race").status == 0
    assert opened == [(str(path), {}, None, "racing")]


def test_the_first_picture_alone_needs_no_display(
    run: Run, write: Write, no_display: Opened, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write()
    asked: list[object] = []

    def first_picture(*arguments: object, racing: bool) -> float:
        asked.append((*arguments, racing))
        return 12.5

    monkeypatch.setattr(window, "first_picture", first_picture)

    assert run("play", path, "--first-picture", "--set", "g=1.6") == (0, "12.5\n", "")
    assert asked == [(str(path), {"g": 1.6}, None, False)]
    assert no_display == []


def test_without_a_command_the_window_opens(run: Run, opened: Opened) -> None:
    assert run() == (0, "", "")
    assert opened == [()]


@pytest.mark.parametrize(("setting", "status"), [("g=99", 2), ("h=1", 2), ("g", 2)])
def test_a_wrong_setting_opens_no_window(
    run: Run, write: Write, opened: Opened, setting: str, status: int
) -> None:
    assert run("play", write(), "--set", setting).status == status
    assert opened == []


def test_a_level_that_is_not_there_opens_no_window(run: Run, opened: Opened) -> None:
    outcome = run("play", "newton/atwod")

    assert outcome.status == 1
    assert "did you mean 'newton/atwood'?" in outcome.err
    assert opened == []


def test_without_a_display_play_says_what_else_there_is(
    run: Run, write: Write, no_display: Opened
) -> None:
    outcome = run("play", write())

    assert outcome.status == 1
    assert outcome.err.startswith("there is no display")
    assert "'render'" in outcome.err
    assert no_display == []


@pytest.mark.usefixtures("no_display")
@pytest.mark.parametrize("status", [0, 1])
def test_without_a_display_the_sandbox_takes_the_tour_into_a_folder_that_it_names(
    run: Run, monkeypatch: pytest.MonkeyPatch, status: int
) -> None:
    folders: list[Path] = []

    def tour(folder: Path) -> int:
        folders.append(folder)
        return status

    monkeypatch.setattr(touring, "tour", tour)

    outcome = run()

    assert outcome.status == status
    assert "no display" in outcome.out
    assert str(folders[0]) in outcome.out
