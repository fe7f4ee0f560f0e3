"""Drag and given forces: limits and figures of the chapter."""

from math import pi

import pytest

from validation.formulas import drag


def test_drag_ends_at_its_terminal_velocity_and_begins_as_a_free_fall() -> None:
    assert drag.fall_velocity(100, 1, 0.2, 9.81) == pytest.approx(
        -drag.terminal_velocity(1, 0.2, 9.81)
    )
    assert drag.fall_velocity(1e-3, 1, 0.2, 9.81) == pytest.approx(-9.81e-3, rel=1e-5)
    assert drag.throw_with_drag(1, 3, 1, 1e-6, 9.81) == pytest.approx(3 - 9.81 / 2, rel=1e-4)


def test_a_half_sine_gives_the_area_under_it() -> None:
    assert drag.half_sine_momentum(5, 10, 1) == pytest.approx(20 / pi)


def test_a_movable_pulley_is_balanced_by_half_its_weight() -> None:
    assert drag.movable_pulley_acceleration(1, 2, 9.81) == 0
    assert drag.resultant((3, 4), (-1, 2)) == (2, 6)
