"""Groups are made, selected, moved and taken apart with the mouse and keys."""

from pathlib import Path

import numpy as np
import pygame
import pytest
from numpy.typing import NDArray

from tests.app.building.builder import Builder
from tests.app.person import Person

DISCS = """{
  "format": 1,
  "title": "Three discs",
  "effects": {"gravity": {"acceleration": [0, -9.81]}},
  "bodies": {
    "left": {"shape": {"type": "disc", "radius": 0.4}, "mass": 1, "position": [-3, 0]},
    "middle": {"shape": {"type": "disc", "radius": 0.4}, "mass": 1, "position": [0, 0]},
    "right": {"shape": {"type": "disc", "radius": 0.4}, "mass": 1, "position": [3, 0]}
  },
  "view": {"center": [0, 0], "width": 12}
}"""


@pytest.fixture
def mine(person: Person, tmp_path: Path) -> Builder:
    """Somebody at the Build page of three discs."""
    person.open(tmp_path, DISCS)
    return Builder(person)


def chosen(builder: Builder) -> set[str]:
    return set(builder.editor.work.selected_bodies)


def place(builder: Builder, name: str) -> tuple[float, float]:
    x, y = builder.document["bodies"][name]["position"]
    return float(x), float(y)


def group(builder: Builder) -> None:
    """Make the left one and the one in the middle a group."""
    builder.drag((-3.8, 0.8), (0.8, -0.8))
    builder.key(pygame.K_g, mod=pygame.KMOD_CTRL)
    builder.key(pygame.K_ESCAPE)


@pytest.mark.sweep
def test_a_click_selects_the_group_and_a_second_one_the_body_alone(mine: Builder) -> None:
    group(mine)
    assert chosen(mine) == set()
    mine.at(-3, 0)
    assert chosen(mine) == {"left", "middle"}
    mine.at(0, 0)
    assert chosen(mine) == {"middle"}
    mine.at(3, 0)
    assert chosen(mine) == {"right"}


def test_a_frame_that_catches_one_of_a_group_catches_all_of_it(mine: Builder) -> None:
    group(mine)
    mine.drag((-0.8, 0.8), (3.8, -0.8))

    assert chosen(mine) == {"left", "middle", "right"}


def test_a_group_is_dragged_as_one_and_undone_as_one(mine: Builder) -> None:
    group(mine)
    mine.drag((0, 0), (0, 2))
    (x, y), (u, v) = place(mine, "left"), place(mine, "middle")

    assert (u - x, v - y) == pytest.approx((3, 0))
    assert v == pytest.approx(2, abs=0.3)
    assert place(mine, "right") == (3, 0)
    mine.key(pygame.K_z, mod=pygame.KMOD_CTRL)
    assert (place(mine, "left"), place(mine, "middle")) == ((-3, 0), (0, 0))


def test_buttons_make_a_group_and_take_it_apart(mine: Builder) -> None:
    mine.drag((-3.8, 0.8), (0.8, -0.8))
    mine.act("Group")
    assert mine.document["view"]["together"] == [["left", "middle"]]
    mine.act("Ungroup")
    assert "together" not in mine.document["view"]
    mine.key(pygame.K_ESCAPE)
    mine.at(-3, 0)
    assert chosen(mine) == {"left"}


def test_a_copy_of_a_group_is_selected_as_one(mine: Builder) -> None:
    group(mine)
    mine.at(0, 0)
    mine.key(pygame.K_d, mod=pygame.KMOD_CTRL)
    first, second = mine.document["view"]["together"]

    assert first == ["left", "middle"]
    assert chosen(mine) == set(second)
    assert not set(first) & set(second)


def test_a_frame_is_drawn_around_a_group_that_is_selected(mine: Builder) -> None:
    """Half-way between two discs and above them there is nothing but its dashes."""

    def seen() -> NDArray[np.uint8]:
        mine.person.wait(0.1)
        x, y = mine.person.on_screen((-1.5, 0.4))
        place = pygame.Rect(round(x) - 20, round(y) - 14, 40, 14)
        return pygame.surfarray.array3d(mine.person.window.surface.subsurface(place))

    group(mine)
    bare = seen()
    mine.at(0, 0)
    assert np.count_nonzero(np.any(seen() != bare, axis=2)) > 10
    mine.at(0, 0)
    assert (seen() == bare).all()


def test_several_bodies_are_turned_together_about_their_middle(mine: Builder) -> None:
    """The handle stands above them."""
    group(mine)
    mine.at(0, 0)
    x, y = mine.person.on_screen((-1.5, 0.4))
    middle = mine.person.on_screen((-1.5, 0))
    above = x, y - 30
    away = middle[1] - above[1]
    mine.person.drag(above, (middle[0] - away, middle[1]))  # a quarter turn to the left
    mine.person.wait(0.1)
    assert place(mine, "left") == pytest.approx((-1.5, -1.5), abs=1e-9)
    assert place(mine, "middle") == pytest.approx((-1.5, 1.5), abs=1e-9)
    assert mine.document["bodies"]["middle"]["angle"] == "90*deg"
    assert place(mine, "right") == (3, 0)
