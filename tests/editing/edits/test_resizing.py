"""Handles: the dragged point follows, and the opposite one stays."""

import pytest

from sandbox.editing.bodies_at_start import placed
from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import DENSITY, add_box, add_disc, add_polygon, add_surface
from sandbox.editing.edits.moving_and_aligning import turn
from sandbox.editing.edits.resizing import drag_handle, handles, scale
from sandbox.editing.text_patches import put, value_at
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.loading import parse, read


def drawn() -> str:
    text = Draft.empty().text
    text = add_disc(text, parse(text), (0, 2), (0.5, 2)).text
    text = add_box(text, parse(text), (2, 1), (3, 1.5)).text
    text = add_polygon(text, parse(text), [(4, 1), (6, 1), (6, 2), (4.5, 3)]).text
    return add_surface(text, parse(text), [(-4, 3), (-2, 2), (0, 4)]).text


def test_a_box_keeps_the_corner_opposite_to_the_one_that_is_dragged() -> None:
    text = drawn()
    tilted = turn(text, parse(text), ["box1"], 0.3)
    level = parse(tilted)
    at = handles(level, "box1")
    after = handles(parse(drag_handle(tilted, level, "box1", 4, (3.7, 2.2))), "box1")
    assert after[4] == pytest.approx((3.7, 2.2))
    assert after[0] == pytest.approx(at[0])


def test_a_side_that_is_dragged_leaves_the_height_alone() -> None:
    text = drawn()
    changed = drag_handle(text, parse(text), "box1", 3, (5, 7))
    shape = value_at(changed, ("bodies", "box1", "shape"))
    assert shape == {"type": "box", "width": 3, "height": 0.5}


@pytest.mark.parametrize("name", ["polygon1", "surface1"])
@pytest.mark.parametrize("index", [0, 1, 2])
def test_one_corner_moves_and_the_others_stay(name: str, index: int) -> None:
    text = drawn()
    turned = turn(text, parse(text), [name], 0.4)
    level = parse(turned)
    before = handles(level, name)
    to = (before[index][0] + 0.1, before[index][1] - 0.2)
    after = handles(parse(drag_handle(turned, level, name, index, to)), name)
    before[index] = to
    for one, other in zip(after, before, strict=True):
        assert one == pytest.approx(other, abs=1e-12)


def test_a_drawn_body_keeps_its_density_and_a_chosen_mass_stays() -> None:
    text = drawn()
    wide = drag_handle(text, parse(text), "disc1", 0, (1, 2))
    body = placed(parse(wide))["disc1"]
    assert body.body.mass is not None
    assert body.body.mass({}) == pytest.approx(DENSITY * body.area, rel=5e-3)
    chosen = put(text, ("bodies", "disc1", "mass"), 2)
    wide = drag_handle(chosen, parse(chosen), "disc1", 0, (1, 2))
    assert value_at(wide, ("bodies", "disc1", "mass")) == 2


def test_what_is_scaled_covers_the_square_of_it() -> None:
    text = drawn()
    for name in ("disc1", "box1", "polygon1"):
        before, after = (
            placed(parse(one))[name] for one in (text, scale(text, parse(text), name, 1.5))
        )
        assert after.area == pytest.approx(before.area * 2.25)
        assert after.center == before.center


def test_nothing_is_left_of_no_body() -> None:
    text = drawn()
    with pytest.raises(SandboxError, match="nothing"):
        drag_handle(text, parse(text), "disc1", 0, (0, 2))
    with pytest.raises(SandboxError, match="nothing"):
        drag_handle(text, parse(text), "box1", 4, (1, 1))
    with pytest.raises(SandboxError, match="nothing"):
        scale(text, parse(text), "box1", 0)


def test_the_handle_of_an_arc_changes_its_radius() -> None:
    text = read(level_catalog.find("rotation/half-pipe"))
    level = parse(text)
    pipe = next(name for name, body in level.bodies.items() if body.shape.type == "arc")
    ((x, y),) = handles(level, pipe)
    center = placed(level)[pipe].center
    to = (complex(x, y) - center) * 2 + center
    after = parse(drag_handle(text, level, pipe, 0, (to.real, to.imag)))
    assert handles(after, pipe)[0] == pytest.approx((to.real, to.imag))
