"""Friction that ends a slip within a drift, where contacts are solved directly."""

import pytest

from sandbox.model.level import Level
from tests.physics.contacts.direct.courses import course
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, level

MU = 0.3


def scene(bodies: dict[str, Spec], rate: float, restitution: float = 0.0, **more: object) -> Level:
    """A level on a floor, with more effects; any two bodies have the same coefficients."""
    floor = fixed({"type": "box", "width": 40, "height": 1}, (0, -0.5))
    known = {"friction": MU**0.5, "restitution": restitution**0.5}
    all_bodies = {name: {**body, **known} for name, body in {"floor": floor, **bodies}.items()}
    direct = {"contact": {"solver": "direct"}, "friction": {}, "restitution": {}, "rotation": {}}
    return level(all_bodies, {**GRAVITY, **direct, **more}, stepping={"rate": rate})


@pytest.mark.parametrize("rate", [60, 73, 240])
@pytest.mark.parametrize("speed", [0.533, 0.7, 1.0, 1.3])
def test_a_box_stops_where_friction_has_taken_its_speed(speed: float, rate: float) -> None:
    """It was up to 6e-5 m off at 60 Hz, and 5e-6 m at 240 Hz."""
    sliding = box((-3, 0.05), size=(0.2, 0.1), velocity=[speed, 0])

    state, energy, momentum = course(scene({"box": sliding}, rate), 0.6)

    assert state.position[-1, 0] == pytest.approx(-3 + speed**2 / (2 * MU * G), abs=1e-12)
    assert state.velocity[-1] == pytest.approx([0, 0], abs=1e-12)
    assert max(energy, momentum) <= 1e-12


@pytest.mark.parametrize("rate", [60, 240])
def test_a_disc_slides_until_it_rolls(rate: float) -> None:
    """It was 7e-6 m off at 60 Hz."""
    speed, duration = 2.0, 0.8
    sliding = disc((-3, 0.2), radius=0.2, velocity=[speed, 0])

    state, energy, _ = course(scene({"disc": sliding}, rate), duration)

    until = speed / (3 * MU * G)
    way = speed * until - MU * G * until**2 / 2 + speed * 2 / 3 * (duration - until)
    assert state.position[-1, 0] == pytest.approx(-3 + way, abs=1e-12)
    assert state.angular_velocity[-1] == pytest.approx(-speed * 2 / 3 / 0.2, abs=1e-11)
    assert energy <= 1e-12


@pytest.mark.parametrize("rate", [60, 240])
def test_a_box_on_a_box_stops_on_it_before_both_stop(rate: float) -> None:
    """Both ends of slipping at their own time."""
    bodies = {
        "below": box((0, 0.1), size=(4, 0.2), mass=2),
        "above": box((-0.5, 0.25), size=(0.2, 0.1), mass=1, velocity=[1, 0]),
    }

    state, energy, _ = course(scene(bodies, rate), 0.6)

    assert state.position[-1, 0] == pytest.approx(-0.5 + 1 / (2 * MU * G), abs=1e-12)
    assert state.position[-2, 0] == pytest.approx(0, abs=1e-12)
    assert energy <= 1e-12


@pytest.mark.sweep
@pytest.mark.parametrize("late", [0.0, 0.002, 0.004])
def test_a_ball_catches_up_with_a_box_as_it_stops(late: float) -> None:
    """`late` is how much later than the box stops it is there [s]."""
    speed, stop, until = 0.7, 0.7**2 / (2 * MU * G), 0.7 / (MU * G)
    away = 0.1 + 0.1 + 3 * (until + late)
    bodies = {
        "box": box((0, 0.1), size=(0.2, 0.2), mass=2, velocity=[speed, 0]),
        "ball": disc((stop - away, 0.1), radius=0.1, velocity=[3, 0], angular_velocity=-30),
    }

    states = [course(scene(bodies, rate, 1.0), 0.3) for rate in (60, 240, 960)]

    places = [state.position[1:, 0] for state, _, _ in states]
    for place, (_, energy, momentum) in zip(places, states, strict=True):
        assert place == pytest.approx(places[-1], abs=1e-7)
        assert max(energy, momentum) <= 1e-9


def test_a_light_box_that_is_shot_out_of_a_stack_is_caught_by_friction() -> None:
    """Stopped for a whole kick at once, it left 0.91 J without a cause."""
    spots = {"low": (0.15, 39.5, 0.2254), "light": (0.45, 0.308, 0.8154), "high": (0.75, 56.8, 0.4)}
    bodies = {
        name: box((0, y), size=(0.3, 0.3), mass=mass, friction=friction, restitution=1)
        for name, (y, mass, friction) in spots.items()
    }
    at = (-1.329843516761, 0.756467183371)
    ball = disc(at, radius=0.2, mass=1.54, friction=0.9865, restitution=1)
    floor = fixed({"type": "box", "width": 40, "height": 1}, (0, -0.5), friction=0.9, restitution=1)
    made = level(
        {"floor": floor, **bodies, "ball": ball},
        {**GRAVITY, "contact": {}, "friction": {}, "restitution": {}, "rotation": {}},
        joints={"rope": {"type": "rope", "ends": ["ball", [-0.35, 2.5]]}},
        stepping={"rate": 60},
    )

    _, energy, momentum = course(made, 0.8)

    assert energy <= 0.2
    assert momentum <= 1e-9


@pytest.mark.parametrize("rate", [60, 120, 240])
@pytest.mark.parametrize(("pull", "speed"), [(4.0, 0.5), (4.0, 0.7), (4.0, 1.0), (6.0, 0.7)])
def test_a_box_pushed_up_a_slope_turns_round_and_slides_back(
    pull: float, speed: float, rate: float
) -> None:
    """Friction is reversed within a kick: it was up to 4e-3 m and 8e-3 m/s off.

    The slope is the floor, with a force along it. If the box turns round early in a drift, the
    books read it on the parabola of the whole kick: off by less than m a² h²/8.
    """
    duration = 0.6
    sliding = box((-3, 0.05), size=(0.2, 0.1), velocity=[speed, 0])
    force = {"body": "box", "force": [-pull, 0], "at": [0, -0.05]}

    state, energy, momentum = course(scene({"box": sliding}, rate, force=[force]), duration)

    turns, back = speed / (pull + MU * G), pull - MU * G
    height = speed * turns / 2 - back * (duration - turns) ** 2 / 2
    assert state.position[-1, 0] == pytest.approx(-3 + height, abs=1e-12)
    assert state.velocity[-1] == pytest.approx([-back * (duration - turns), 0], abs=1e-12)
    assert momentum <= 1e-12
    assert energy <= (2 * MU * G / rate) ** 2 / 8  # 1e-4 of 1e-3; mostly 1e-14
