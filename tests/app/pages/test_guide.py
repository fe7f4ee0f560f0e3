"""The code of the guide's page and overlay draws what the guide says."""

import re
from pathlib import Path
from typing import Any

import pygame

from sandbox.app.drawing.text import Pen
from sandbox.app.pages.page import Page
from sandbox.app.runs.session import Session
from tests.app import scenes
from tests.app.person import Person

GUIDE = Path(__file__).resolve().parents[3] / "docs" / "how-to" / "add-a-page.md"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def module(title: str) -> dict[str, Any]:
    """Run the code of the guide under a title, and return what it defines."""
    (code,) = (block for block in BLOCK.findall(GUIDE.read_text("utf-8")) if title in block)
    defined: dict[str, Any] = {}
    exec(code, defined)
    return defined


def test_the_card_of_the_guide_is_drawn(pen: Pen) -> None:
    card = module("The momentum of each body.")["momentum"]

    assert card(pen, 276, Session(scenes.level())).width == 276


def test_the_declaration_of_the_guide_is_complete() -> None:
    assert isinstance(module("The page of the momenta.")["PAGE"], Page)


def test_the_overlay_of_the_guide_is_drawn(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    person.wait()
    overlay = module("The centre of mass of what moves.")["OVERLAY"]
    surface = pygame.Surface((1280, 800))

    overlay.draw(surface, person.window.stage.view)

    assert pygame.surfarray.array3d(surface).any()
