"""The books of a run close as well as its scheme can, or say by how much they do not."""

import pytest

from sandbox.model.level import Level
from sandbox.physics.energy.balance_check import Closing
from sandbox.physics.run import simulate
from tests.physics.scenes import (
    GRAVITY,
    Spec,
    atwood,
    box,
    disc,
    fixed,
    floor,
    level,
    orbit,
    straddle,
)


def closing(scene: Level, duration: float = 1.0) -> Closing:
    found = simulate(scene, duration=duration, books=True).closing
    assert found is not None
    return found


def swing(rate: float) -> Level:
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 40, "length": 1}
    return level({"bob": disc((1.5, 0))}, {}, joints={"k": spring}, stepping={"rate": rate})


def test_where_forces_are_constant_the_books_close_to_rounding() -> None:
    found = closing(atwood(1, 1.5))

    assert found.closes
    assert found.unexplained < 1e-13 * found.turnover
    assert found.text.startswith("closes to ")


@pytest.mark.parametrize("rate", [30, 60, 240])
def test_a_spring_is_unexplained_by_no_more_than_its_step_and_about_as_much(rate: float) -> None:
    """(ω dt)² / 4 of it, ω² = k / m; the bound is twice that."""
    found = closing(swing(rate), 2.0)

    assert found.closes
    assert found.unexplained == pytest.approx(40 / rate**2 / 4 * found.turnover, rel=0.02)
    assert found.bound == pytest.approx(2 * found.unexplained, rel=0.02)


def test_a_bend_that_is_too_sharp_for_the_steps_is_told() -> None:
    """What is thrown past the centre of an attraction is not where it would be."""
    found = closing(orbit(speed=0.3, rate=60), 4.0)

    assert found.unexplained_fraction > 1e-2


def test_eulers_scheme_does_not_close() -> None:
    found = closing(orbit(scheme="explicit-euler"))

    assert not found.closes
    assert "J unexplained (" in found.text


def test_what_overlaps_gave_is_told() -> None:
    """The iterative solver meets arcs where steps end, and so in each other."""
    arc = {"type": "arc", "radius": 50, "start": "260*deg", "end": "280*deg"}
    scene = level(
        {"ball": disc((0, 1), radius=0.1), "bowl": fixed(arc, (0, 50))},
        {**GRAVITY, "contact": {"solver": "iterative"}},
    )
    found = closing(scene)

    assert not found.closes
    assert "J of it by taking back overlaps" in found.text


@pytest.mark.parametrize(
    ("unexplained", "text"),
    [
        (3500, "3.5e+03 J of 7e+03 J unexplained (50 %)"),
        (500, "5e+02 J of 7e+03 J unexplained (7.1 %)"),
    ],
)
def test_books_of_far_too_coarse_steps_do_not_close_whatever_these_may_leave(
    unexplained: float, text: str
) -> None:
    found = Closing(turnover=7000, unexplained=unexplained, overlaps=0, bound=9500, scale=7000)

    assert not found.closes
    assert found.text == text


def test_what_rests_turns_nothing_over() -> None:
    scene = level({"box": box((0, 0.25)), "floor": floor()}, {**GRAVITY, "contact": {}})

    assert closing(scene).text == "nothing turned over"


@pytest.mark.sweep
@pytest.mark.parametrize("far", [1.3, 1.7, 2.9])
def test_what_rests_on_springs_turns_nothing_over_but_rounding(far: float) -> None:
    """Springs hold it to 1e-16 m, so it trembles: 1e-28 J, all of them without a cause."""
    bodies = {"one": disc((far, 0.3)), "other": disc((-0.7, far), mass=30)}
    places = {"one": complex(far, 0.3), "other": complex(-0.7, far)}
    ends = [["one", "other"], [[0, 0], "one"], [[0, 0], "other"]]
    lengths = [abs(places["one"] - places["other"]), abs(places["one"]), abs(places["other"])]
    joints: dict[str, Spec] = {
        f"spring{i}": {"type": "spring", "ends": two, "stiffness": 100, "length": length}
        for i, (two, length) in enumerate(zip(ends, lengths, strict=True))
    }
    found = closing(level(bodies, {}, joints=joints, stepping={"rate": 960}), 3.0)

    assert found.closes
    assert found.text == "nothing turned over"


@pytest.mark.sweep
def test_a_load_that_hops_without_gaining_is_told_by_its_books() -> None:
    """Each landing takes what the hop gave: forces are wrong by far, and nothing diverges."""
    assert closing(straddle(4000), 0.2).unexplained_fraction > 0.1
