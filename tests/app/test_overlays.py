"""Every overlay of the stage that is registered."""

from collections.abc import Callable
from pathlib import Path

import pygame
import pytest

from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays import register
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.stage.overlays.register import OVERLAYS
from tests.app.person import Person

LEVELS = ["kinematics/projectile", "newton/two-forces", "momentum/billiard-break"]
FOLDER = Path(register.__file__).parent


def test_every_module_of_overlays_is_registered() -> None:
    modules = {path.stem for path in FOLDER.glob("*.py")} - {"__init__", "overlay", "register"}

    forgotten = modules ^ {overlay.name for overlay in OVERLAYS}
    assert not forgotten, (
        f"an overlay is called as its module, and is named in OVERLAYS: {forgotten}"
    )


@pytest.mark.sweep
@pytest.mark.parametrize("level", LEVELS)
def test_overlays_are_switched_by_their_keys_and_drawn_while_time_runs(
    person: Person, level: str
) -> None:
    person.window.open_level(level)
    person.press(pygame.K_SPACE, " ")
    for overlay in OVERLAYS:
        before = person.window.stage.shown[overlay.name]
        assert before is (overlay.on is None or overlay.on(person.session.level))

        person.press(pygame.key.key_code(overlay.key), overlay.key)
        person.wait(0.05)

        assert person.window.stage.shown[overlay.name] is not before, overlay.name


@pytest.mark.parametrize(
    "overlay", [o for o in OVERLAYS if o.caption and o.on is None], ids=lambda o: o.name
)
def test_an_overlay_that_is_on_at_first_has_a_button_in_the_bar(
    person: Person, overlay: Overlay
) -> None:
    person.window.open_level(LEVELS[0])
    person.wait()
    button = person.window.panels.controls.button(overlay.name)
    assert button.is_selected

    person.click(button.rect)
    person.wait()

    assert not person.window.stage.shown[overlay.name]
    assert not button.is_selected


@pytest.mark.parametrize(
    ("make", "part"),
    [
        (lambda: Overlay("momenta", "", "arrows of momenta", _draw), "a key"),
        (lambda: Overlay("momenta", "m", "", _draw), "a text"),
        (lambda: Overlay("momenta", "m", "arrows of momenta"), "something to draw"),
    ],
)
def test_a_part_that_is_forgotten_is_named_and_where_it_belongs(
    make: Callable[[], Overlay], part: str
) -> None:
    with pytest.raises(ValueError, match=f"'momenta' lacks {part}") as caught:
        make()

    assert "sandbox/app/stage/overlays/momenta.py" in str(caught.value)


def _draw(_surface: pygame.Surface, _view: DrawingContext) -> None: ...
