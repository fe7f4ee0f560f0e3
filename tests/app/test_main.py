"""Starting the app."""

import sys

import pygame
import pytest

from sandbox.app import main
from tests.elsewhere import python


@pytest.mark.parametrize("driver", ["dummy", "offscreen"])
def test_a_driver_without_a_screen_is_no_display(
    driver: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", driver)

    assert not main.has_display()


def test_a_display_that_was_found_stays_open(monkeypatch: pytest.MonkeyPatch) -> None:
    """When it was closed for a moment, a server without other clients refused the window."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "")
    monkeypatch.setenv("DISPLAY", ":99")
    monkeypatch.setattr(pygame.display, "init", lambda: None)
    monkeypatch.setattr(pygame.display, "get_driver", lambda: "x11")
    monkeypatch.setattr(pygame.display, "quit", lambda: pytest.fail("the display was left"))

    assert main.has_display()


@pytest.mark.sweep
@pytest.mark.skipif(sys.platform != "linux", reason="other systems always have a display server")
def test_without_a_display_nothing_is_printed() -> None:
    code = "from sandbox.app.main import has_display; raise SystemExit(has_display())"
    done = python("-c", code, environment={})

    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.sweep
def test_the_rest_of_the_sandbox_does_not_need_pygame() -> None:
    code = (
        "import sys, sandbox, sandbox.app, sandbox.model.level_catalog;"
        "import sandbox.physics.measuring.recording;"
        "raise SystemExit('pygame' in sys.modules)"
    )

    assert python("-c", code).returncode == 0


PRELOADED = """
import sys, threading, time
from sandbox.app.window import Window

window = Window((900, 600))
window.open_level({level!r})
end = time.monotonic() + 10
while "scipy.optimize" not in sys.modules and time.monotonic() < end:
    if not {waits}:
        break
    time.sleep(0.05)
print("scipy.optimize" in sys.modules)
"""


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("level", "direct"), [("machines/waiters-tray", True), ("newton/atwood", False)]
)
def test_what_contacts_may_need_is_imported_before_they_need_it(level: str, direct: bool) -> None:
    """It took a quarter of a second in the middle of a run; scenes without contacts never do."""
    code = PRELOADED.format(level=level, waits=direct)

    assert python("-c", code).stdout.split()[-1] == str(direct)
