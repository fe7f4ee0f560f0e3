"""The one place where y flips."""

import pytest

from sandbox.app.drawing.camera import Camera
from sandbox.model.view import View


@pytest.fixture
def camera() -> Camera:
    camera = Camera((800, 600))
    camera.fit(View.model_validate_json('{"center": [1, 2], "width": 8}'), {})
    return camera


def test_higher_in_the_plane_is_higher_on_the_screen(camera: Camera) -> None:
    assert camera.to_screen((1, 3))[1] < camera.to_screen((1, 2))[1]


def test_a_view_shows_the_width_that_the_level_asks_for(camera: Camera) -> None:
    left, _, right, _ = camera.bounds

    assert (left, right) == pytest.approx((-3, 5))


def test_a_low_window_still_shows_nine_sixteenths_of_the_width() -> None:
    camera = Camera((1600, 450))
    camera.fit(View.model_validate_json('{"width": 16}'), {})
    _, bottom, _, top = camera.bounds

    assert top - bottom == pytest.approx(9)


def test_a_narrow_window_shows_the_middle_of_the_width_and_the_whole_height() -> None:
    view = View.model_validate_json('{"width": 16, "middle": 0.375}')
    narrow, square, wide = Camera((600, 1200)), Camera((900, 900)), Camera((1600, 900))
    for camera in (narrow, square, wide):
        camera.fit(view, {})

    left, _, right, _ = narrow.bounds
    assert (left, right) == pytest.approx((-3, 3))
    _, bottom, _, top = square.bounds
    assert (bottom, top) == pytest.approx((-4.5, 4.5))
    assert wide.scale == pytest.approx(100)


def test_the_way_to_the_screen_and_back_ends_where_it_began(camera: Camera) -> None:
    assert camera.to_world(camera.to_screen((0.3, -1.7))) == pytest.approx((0.3, -1.7))


def test_zooming_keeps_the_point_under_the_mouse(camera: Camera) -> None:
    before = camera.to_world((100, 500))

    camera.zoom(2.5, (100, 500))

    assert camera.to_world((100, 500)) == pytest.approx(before)
    assert camera.scale == pytest.approx(250)


def test_panning_takes_the_plane_along_with_the_mouse(camera: Camera) -> None:
    point = camera.to_world((100, 100))

    camera.pan(30, -20)

    assert camera.to_screen(point) == pytest.approx((130, 80))


def test_a_chosen_view_survives_a_change_of_size(camera: Camera) -> None:
    camera.zoom(2)

    camera.resize((400, 300))

    assert camera.scale == pytest.approx(200)
    assert camera.center == pytest.approx((1, 2))
