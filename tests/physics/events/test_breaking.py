"""Joints that break: where their force comes to what they bear, and before a blow goes through."""

from math import sqrt

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.physics.stepping.run_continuation import branch
from tests.physics.scenes import GRAVITY, G, booked, box, disc, floor, level


def swung(load: float, rate: float = 240, **effects: object) -> Level:
    """A bob that swings down from the right on a rod: its pull is 3 m g sin φ below the level."""
    rod = {"type": "rod", "ends": [[0, 0], "bob"], "breaks_at": load}
    bodies = {"bob": disc((1, 0)), "floor": floor(-50)}
    return level(bodies, {**GRAVITY, **effects}, joints={"rod": rod}, stepping={"rate": rate})


def caught(load: float, rate: float, height: float, **effects: object) -> Level:
    """A bob that falls on a rope of a metre, and is caught by it if it holds."""
    rope = {"type": "rope", "ends": [[0, 0], "bob"], "length": 1, "breaks_at": load}
    bodies = {"bob": disc((0, height)), "floor": floor(-50)}
    return level(bodies, {**GRAVITY, **effects}, joints={"rope": rope}, stepping={"rate": rate})


@pytest.mark.sweep
@pytest.mark.parametrize("effects", [{}, {"contact": {}}])
def test_a_rod_breaks_where_its_pull_comes_to_what_it_bears(effects: dict[str, object]) -> None:
    world, books = booked(swung(20, 960, **effects), 1)
    sine = 20 / (3 * G)

    assert world.snapshot.velocity[0, 0] == pytest.approx(-sqrt(2 * G * sine) * sine, rel=1e-5)
    assert world.snapshot.tension[0] == 0
    assert abs(books.balance.unexplained) < 1e-4
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-11


@pytest.mark.sweep
def test_the_instant_is_found_within_the_step_to_second_order() -> None:
    sine = 20 / (3 * G)

    def off(rate: float) -> float:
        across = booked(swung(20, rate), 1)[0].snapshot.velocity[0, 0]
        return abs(float(across) + sqrt(2 * G * sine) * sine)

    assert off(30) < 1e-2
    assert off(30) / off(960) > 32**2 / 2


@pytest.mark.sweep
def test_what_bears_just_enough_holds() -> None:
    most = 3 * G

    assert not booked(swung(1.001 * most), 1)[0].scene.event_times
    assert booked(swung(0.999 * most), 1)[0].scene.event_times


def test_what_must_bear_too_much_from_the_start_breaks_there() -> None:
    this = level(
        {"bob": disc((0, 1), mass=4)},
        GRAVITY,
        joints={"strut": {"type": "rod", "ends": [[0, 0], "bob"], "breaks_at": 39}},
    )
    world, _ = booked(this, 1)

    assert world.scene.event_times == {"strut breaks": 0}
    assert world.snapshot.velocity[0, 1] == pytest.approx(-G, rel=1e-12)


def test_the_one_that_is_furthest_beyond_its_load_saves_the_rest() -> None:
    """A bar hangs by a weld, and its pieces by each other: where one goes the others are free."""
    pieces = {f"piece{i}": box((0.5 * i, 0)) for i in range(5)}
    welds = {
        f"weld{i}": {
            "type": "weld",
            "ends": [
                {"body": f"piece{i - 1}", "at": [0.25, 0]} if i else [-0.25, 0],
                {"body": f"piece{i}", "at": [-0.25, 0]},
            ],
            "breaks_at": (25, 15, 18, 18, 18)[i],
        }
        for i in range(5)
    }
    world, _ = booked(level(pieces, {**GRAVITY, "rotation": {}}, joints=welds), 0.5)

    assert world.scene.event_times == {"weld1 breaks": 0}


@pytest.mark.parametrize("height", [0.1, 0.11, 0.12, 0.13])
@pytest.mark.parametrize("effects", [{}, {"contact": {}}])
def test_a_rope_that_a_jerk_breaks_takes_nothing_wherever_in_the_step_it_is(
    height: float, effects: dict[str, object]
) -> None:
    world, books = booked(caught(500, 240, height, **effects), 0.8)

    assert world.snapshot.velocity[0, 1] == pytest.approx(-0.8 * G, rel=1e-9)
    assert list(world.scene.event_times) == ["rope breaks"]
    assert abs(books.balance.unexplained) < 1e-9
    assert books.balance.loss["impacts"] == pytest.approx(0, abs=1e-12)


def test_a_rope_that_bears_the_jerk_within_a_step_stops_the_fall() -> None:
    world, books = booked(caught(2000, 240, 0.1), 0.8)

    assert not world.scene.event_times
    assert world.snapshot.velocity[0, 1] == pytest.approx(0, abs=1e-12)
    assert books.balance.loss["impacts"] == pytest.approx(1.1 * G, rel=1e-3)


def test_a_blow_leaves_the_rope_that_it_does_not_go_through() -> None:
    """Two weights that fall on ropes: the stronger rope is not asked to bear the other's jerk."""
    ropes = {
        name: {"type": "rope", "ends": [[x, 0], name], "length": 1, "breaks_at": load}
        for name, x, load in (("weak", -2, 100), ("strong", 2, 1e5))
    }
    bodies = {"weak": disc((-2, 0)), "strong": disc((2, 0))}
    ropes = {f"{name}_rope": rope for name, rope in ropes.items()}
    world, _ = booked(level(bodies, GRAVITY, joints=ropes), 1)

    assert list(world.scene.event_times) == ["weak_rope breaks"]
    assert world.snapshot.velocity[:, 1].tolist() == pytest.approx([-G, 0], abs=1e-9)


@pytest.mark.sweep
def test_the_energy_in_a_spring_that_breaks_leaves_and_is_told() -> None:
    spring = {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 50, "length": 1}
    this = level(
        {"bob": disc((0, -1))},
        GRAVITY,
        joints={"spring": {**spring, "breaks_at": 18}},
        stepping={"rate": 960},
    )
    world, books = booked(this, 1)

    assert books.balance.work["events"] == pytest.approx(-(18**2) / 50 / 2, rel=1e-4)
    assert abs(books.balance.unexplained) < 1e-4
    assert world.snapshot.acceleration[0, 1] == pytest.approx(-G, rel=1e-12)


def test_a_branch_knows_what_has_broken() -> None:
    world, _ = booked(swung(20), 0.6)
    other = branch(world, {})
    other.advance(10)

    assert other.scene.event_times == world.scene.event_times
    assert other.snapshot.tension[0] == 0


def struck(load: float, rate: float = 240) -> Level:
    """A ball that falls half a metre on a weight on a rope, and one that falls to the ground."""
    bodies = {
        "weight": disc((0, 5), radius=0.1, mass=2, restitution=1),
        "ball": disc((0, 5.7), radius=0.1, restitution=1),
        "far": disc((5, 0.6), radius=0.1, restitution=1),
        "ground": floor(restitution=1),
    }
    rope = {"type": "rope", "ends": [[0, 7], "weight"], "breaks_at": load}
    effects = {**GRAVITY, "contact": {}, "restitution": {}}
    return level(bodies, effects, joints={"rope": rope}, stepping={"rate": rate})


@pytest.mark.parametrize("rate", [60, 240])
def test_what_lands_beside_a_joint_that_may_break_lands_at_its_time(rate: float) -> None:
    """Both balls sank up to 5 cm into what they met at 60 Hz, and their books did not close."""
    world, books = booked(struck(1e6, rate), 0.55)
    fell = sqrt(2 * 0.5 / G)
    t = 0.55 - fell
    rise = G * fell * t - G * t**2 / 2

    assert not world.scene.event_times
    assert world.snapshot.position[1:3, 1] == pytest.approx([5.2 + rise, 0.1 + rise], abs=1e-7)
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-11
    assert abs(books.balance.unexplained) < 1e-9


@pytest.mark.parametrize("rate", [60, 240])
def test_a_landing_that_breaks_a_rope_goes_on_as_if_it_had_not_been_there(rate: float) -> None:
    """Balls of 1 and 2 kg then part with a third and two thirds of the speed of the first."""
    world, books = booked(struck(50, rate), 0.35)
    fell = sqrt(2 * 0.5 / G)
    speed, late = G * fell, G * (0.35 - fell)

    assert list(world.scene.event_times) == ["rope breaks"]
    assert 0 <= fell - world.scene.event_times["rope breaks"] <= 1 / rate
    assert world.snapshot.velocity[:2, 1] == pytest.approx(
        [-2 / 3 * speed - late, speed / 3 - late], abs=2 * G / rate
    )
    assert np.abs(books.balance.unexplained_impulse).max() < 1e-11


def test_a_load_that_is_nothing_is_told() -> None:
    with pytest.raises(LevelError, match="breaks_at"):
        swung(0)


def test_what_breaks_has_no_scheme_of_fourth_order() -> None:
    this = swung(20)
    with pytest.raises(LevelError, match="'rod', which may break"):
        level(
            {"bob": disc((1, 0))},
            GRAVITY,
            joints={"rod": this.joints["rod"].model_dump(mode="json", exclude_none=True)},
            stepping={"scheme": "fourth-order"},
        )
