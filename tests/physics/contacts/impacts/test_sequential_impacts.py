"""Impacts one after the other: rows, clusters, piles, and the speed that collides."""

from math import cos, pi, radians, sin, sqrt
from time import process_time

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.contacts.impacts import pile_impacts, sequential_impacts
from sandbox.physics.contacts.impacts.pile_impacts import Pile, pushes
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, floor, level, run, worst

SEQUENCE: Spec = {"contact": {}, "restitution": {"impacts": "sequence"}}
TOGETHER: Spec = {"contact": {}, "restitution": {}}


def row(
    masses: Array,
    velocities: Array,
    e: float = 1,
    effects: Spec = SEQUENCE,
    away: Array | None = None,
) -> Level:
    """Discs that touch each other on a line, with a gap of exactly nothing, or some way off."""
    places = 0.2 * np.arange(len(masses)) - (0 if away is None else away)
    bodies = {
        f"ball{i}": disc(
            (float(places[i]), 0), radius=0.1, mass=m, velocity=[v, 0], restitution=sqrt(e)
        )
        for i, (m, v) in enumerate(zip(masses.tolist(), velocities.tolist(), strict=True))
    }
    return level(bodies, effects)


def kinetic(world: World, flight: Snapshot) -> Array:
    scene = world.scene
    linear = np.sum(scene.mass * np.sum(flight.velocity**2, axis=-1), axis=-1)
    return np.asarray((linear + np.sum(scene.moment * flight.angular_velocity**2, axis=-1)) / 2)


@pytest.mark.parametrize("count", [2, 3, 5, 17, 50])
@pytest.mark.parametrize("come", [1, 2, 3])
def test_as_many_balls_leave_a_row_as_come(count: int, come: int) -> None:
    """They touch exactly; those that come have 0.35 m to go."""
    coming = (np.arange(count) < min(come, count - 1)).astype(np.float64)
    scene = row(np.ones(count), coming * 2.0, away=0.35 * coming)
    flight = run(build(scene), 60)

    assert np.abs(flight.velocity[-1, :, 0] - 2.0 * coming[::-1]).max() <= 1e-14  # 4e-16
    assert (flight.velocity[..., 1] == 0).all()


def test_pymunk_alone_moves_half_of_the_row() -> None:
    """(−1/3, 0, 0, 2/3, 2/3): the check above can fail."""
    shot = row(np.ones(5), np.array([1.0, 0, 0, 0, 0]), effects=TOGETHER)
    end = build(shot).advance(10)

    assert np.abs(end.velocity[:, 0] - [0, 0, 0, 0, 1]).max() > 0.3


def test_the_first_impacts_may_be_at_the_very_start() -> None:
    """The state at the start is the given one, and an impact is no acceleration."""
    world = build(row(np.ones(5), np.array([1.0, 0, 0, 0, 0])))

    assert world.snapshot.velocity[:, 0].tolist() == [1, 0, 0, 0, 0]
    assert (world.snapshot.acceleration == 0).all()
    assert world.advance().velocity[:, 0].tolist() == [0, 0, 0, 0, 1]
    assert world.snapshot.position[4, 0] == pytest.approx(0.8 + 1 / 60, rel=1e-14)


MASSES = st.floats(-1, 1).map(lambda power: 10.0**power)


@st.composite
def rows(draw: st.DrawFn) -> tuple[Array, Array]:
    count = draw(st.integers(2, 12))
    masses = st.lists(MASSES, min_size=count, max_size=count)
    speeds = st.lists(st.floats(-3, 3), min_size=count, max_size=count)
    return np.array(draw(masses)), np.array(draw(speeds))


@pytest.mark.sweep
@settings(max_examples=60, deadline=None)
@given(rows(), st.floats(0, 1))
def test_no_row_gains_energy_or_changes_its_momentum(thrown: tuple[Array, Array], e: float) -> None:
    masses, velocities = thrown
    world = build(row(masses, velocities, e))
    start, end = world.snapshot, world.advance()
    fastest = float(np.abs(velocities).max()) or 1.0  # what speeds are rounded to a share of
    before, after = (kinetic(world, s) for s in (start, end))

    assert abs(masses @ (end.velocity[:, 0] - velocities)) <= 1e-12 * masses.sum() * fastest
    assert after <= before * (1 + 1e-12)
    assert (np.diff(end.velocity[:, 0]) >= -1e-9).all(), "nothing approaches any more"


@pytest.mark.sweep
@settings(max_examples=60, deadline=None)
@given(rows())
@example((np.array([1, 0.1]), np.array([0, -5e-324])))  # the smallest number there is
def test_an_elastic_row_keeps_its_energy(thrown: tuple[Array, Array]) -> None:
    masses, velocities = thrown
    world = build(row(masses, velocities))
    before = kinetic(world, world.snapshot)

    assert kinetic(world, world.advance()) == pytest.approx(before, rel=1e-12, abs=1e-20)


@st.composite
def clusters(draw: st.DrawFn) -> dict[str, Spec]:
    """Discs and boxes in rows that touch each other, thrown about and spinning."""
    spin = draw(st.booleans())
    count = draw(st.integers(2, 9))
    return {f"body{i}": _thrown(draw, i, spin=spin) for i in range(count)}


def _thrown(draw: st.DrawFn, i: int, *, spin: bool) -> Spec:
    place = (0.5 * (i % 3), 0.5 * (i // 3))
    rest: Spec = {
        "mass": draw(MASSES),
        "velocity": [draw(st.floats(-3, 3)), draw(st.floats(-3, 3))],
        "restitution": 1,
    }
    if spin:
        rest["angular_velocity"] = draw(st.floats(-5, 5))
    return disc(place, radius=0.25, **rest) if draw(st.booleans()) else box(place, **rest)


@pytest.mark.sweep
@settings(max_examples=60, deadline=None)
@given(clusters())
def test_elastic_clusters_keep_energy_momentum_and_angular_momentum(
    bodies: dict[str, Spec],
) -> None:
    """In 30 steps they fly apart, with more impacts on the way."""
    spin = "angular_velocity" in bodies["body0"]
    world = build(level(bodies, {**SEQUENCE, **({"rotation": {}} if spin else {})}))
    flight = run(world, 30)
    mass, moment = world.scene.mass, world.scene.moment
    momentum = np.einsum("i,tik->tk", mass, flight.velocity)
    x, y = np.moveaxis(flight.position, -1, 0)
    u, v = np.moveaxis(flight.velocity, -1, 0)
    turning = np.sum(mass * (x * v - y * u) + moment * flight.angular_velocity, axis=1)
    energy = kinetic(world, flight)
    scale = float(np.sum(mass * (np.abs(u[0]) + np.abs(v[0])))) or 1.0

    assert np.abs(momentum - momentum[0]).max() <= 1e-12 * scale
    assert np.abs(energy - energy[0]).max() <= 1e-12 * (energy[0] or 1.0)
    if spin:
        assert np.abs(turning - turning[0]).max() <= 1e-11 * (scale + np.abs(turning[0]))


def test_a_break_of_fifteen_discs_keeps_energy_and_momentum() -> None:
    """A triangle of five rows, each disc touching its neighbours to the last digit or not quite."""
    r = 0.05
    discs = [(sqrt(3) * r * i, r * (2 * j - i)) for i in range(5) for j in range(i + 1)]
    rest: Spec = {"radius": r, "restitution": 1}
    bodies = {f"ball{i}": disc(place, **rest) for i, place in enumerate(discs)}
    cue = {"cue": disc((-0.6, 0.003), velocity=[5, 0], **rest)}
    world = build(level({**cue, **bodies}, SEQUENCE, stepping={"rate": 240}))
    flight = run(world, 240)
    momentum = flight.velocity.sum(axis=1)

    assert worst(kinetic(world, flight), 12.5) <= 1e-12  # 6e-16
    assert np.abs(momentum - [5, 0]).max() <= 1e-12
    assert (np.hypot(*flight.velocity[-1].T) > 1e-3).sum() > 8, "it goes through the triangle"


def rack(
    rows: int, e: float, size: float, mass: float, rate: float, effects: Spec
) -> tuple[Level, list[int]]:
    """A ball that comes straight on at a triangle; and which ball is whose mirror image."""
    rest: Spec = {"restitution": sqrt(e)}
    places = [(i, 2 * j - i) for i in range(rows) for j in range(i + 1)]
    balls = {
        f"ball{k}": disc((sqrt(3) * size * i, size * j), radius=size, mass=0.17, **rest)
        for k, (i, j) in enumerate(places)
    }
    cue = disc((-0.5, 0), radius=0.04, mass=mass, velocity=[3, 0], **rest)
    made = level({**balls, "cue": cue}, effects, stepping={"rate": rate})
    return made, [*(places.index((i, -j)) for i, j in places), len(places)]


@pytest.mark.parametrize("rows", [2, 3, 4, 5])
@pytest.mark.parametrize("e", [1, 0.9, 0.5])
@pytest.mark.parametrize(("size", "mass", "rate"), [(0.03, 0.17, 960), (0.11, 1.7, 240)])
@pytest.mark.parametrize("effects", [SEQUENCE, TOGETHER])
def test_mirror_images_stay_so_in_a_straight_break(
    rows: int, e: float, size: float, mass: float, rate: float, effects: Spec
) -> None:
    """Taken one after the other, approaches that are equally fast end up to 1.3 m/s apart."""
    made, mirrored = rack(rows, e, size, mass, rate, effects)
    world = build(made)
    flight = run(world, int(0.3 * rate))
    energy, momentum = kinetic(world, flight), world.scene.mass @ flight.velocity
    images = flight.velocity[:, mirrored] * [1, -1]

    assert np.abs(flight.velocity - images).max() <= 1e-12  # 8e-15 m/s
    assert (flight.velocity[-1, :, 0] != 0).sum() >= 3, "it goes through the triangle"
    assert np.abs(momentum - momentum[0]).max() <= 1e-14
    assert worst(energy, energy[0]) <= 1e-12 if e == 1 else energy[-1] < energy[0]


@pytest.mark.parametrize("e", [1, 0.6, 0])
@pytest.mark.parametrize("mass", [0.2, 1, 5])
def test_what_is_struck_equally_from_both_sides_stays(e: float, mass: float) -> None:
    """And those that struck it bounce as off a wall."""
    end = build(row(np.array([1, mass, 1]), np.array([2.0, 0, -2.0]), e)).advance(10)

    # rounding, passed on to what is five times as light: 1.1e-14 on some processors, less on others
    assert np.abs(end.velocity[:, 0] - [-2 * e, 0, 2 * e]).max() <= 5e-14


@pytest.mark.parametrize("hang", [1, 2, 3])
@pytest.mark.parametrize("drawn", [1, 2])
def test_a_cradle_hit_from_both_sides_sends_both_back(drawn: int, hang: int) -> None:
    """All balls alike: each velocity is passed through the row."""
    comes = np.array([1.5] * drawn + [0.0] * hang + [-1.5] * drawn)
    away = 0.35 * np.sign(comes)
    flight = run(build(row(np.ones(len(comes)), comes, away=away)), 60)

    assert np.abs(flight.velocity[-1, :, 0] + comes).max() <= 1e-14


@pytest.mark.parametrize(("count", "e"), [(5, 0), (5, 0.1), (50, 0), (50, 0.5)])
def test_balls_that_hardly_bounce_go_on_together(count: int, e: float) -> None:
    """They would collide for ever; at last none approaches, and all have the same velocity."""
    first = np.arange(count) == 0
    end = build(row(np.ones(count), 3.0 * first, e)).advance(60)

    assert np.abs(end.velocity[:, 0] - 3 / count).max() <= 1e-12  # 1e-14


def turned_round(mass: float, e: float) -> float:
    """Return the speed of a heavy body after a ball of 1 kg has bounced to and fro before it."""
    light, heavy = 0.0, -1.0
    for _ in range(2000):
        if max(-light, light - heavy) <= 1e-13:
            break
        if -light > light - heavy:
            light *= -e
        else:
            push = (1 + e) * (light - heavy) * mass / (1 + mass)
            light, heavy = light - push, heavy + push / mass
    return heavy


@pytest.mark.parametrize("e", [0.99, 0.999])
def test_what_bounces_well_is_turned_round_by_however_many_impacts(e: float) -> None:
    """A ball between a wall and 10 t has 314: if it came to rest after 200, so would the 10 t."""
    wall = fixed({"type": "box", "width": 0.2, "height": 1}, (0, 0), restitution=sqrt(e))
    heavy, light = (
        disc((x, 0), radius=0.1, mass=m, velocity=[v, 0], restitution=sqrt(e))
        for x, m, v in ((0.4, 1e4, -1.0), (0.2, 1.0, 0.0))
    )
    end = build(level({"wall": wall, "light": light, "heavy": heavy}, SEQUENCE)).advance()

    assert end.velocity[2, 0] == pytest.approx(turned_round(1e4, e), abs=1e-9)


def test_a_pile_up_is_solved_once_though_its_kick_is_repeated(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Carts that collide hundreds of times, in a first kick that settles after 150 tries."""
    carts = {
        f"cart{i}": box((x, 0.25), mass=m, velocity=[v, 0], restitution=sqrt(0.06))
        for i, (x, m, v) in enumerate(
            [(0, 5.55, 0.05), (0.5, 0.109, 0.0), (1, 2.6, 0.0), (1.51, 0.1005, -0.05)]
        )
    }
    effects = {**GRAVITY, **SEQUENCE, "rotation": {}}
    solved: list[int] = []
    settle = Pile.settle

    def counted(pile: Pile, bodies: Integers) -> Array:
        solved.append(len(bodies))
        return settle(pile, bodies)

    monkeypatch.setattr(Pile, "settle", counted)
    world = build(level({**carts, "track": floor(restitution=0)}, effects))

    assert len(solved) == 1
    assert np.ptp(world.advance().velocity[:3, 0]) <= 1e-12


@pytest.mark.sweep
def test_elastic_impacts_without_end_are_told() -> None:
    """A ball of 1 kg between a wall and one of 1e12 kg: 1e6 π impacts would turn that round."""
    wall = fixed({"type": "box", "width": 0.2, "height": 1}, (0, 0), restitution=1)
    heavy, light = (
        disc((x, 0), radius=0.1, mass=m, velocity=[v, 0], restitution=1)
        for x, m, v in ((0.4, 1e12, -1.0), (0.2, 1.0, 0.0))
    )
    with pytest.raises(SimulationError, match="collide too often") as told:
        build(level({"wall": wall, "light": light, "heavy": heavy}, SEQUENCE))
    assert told.value.subject in ("light", "heavy")


@pytest.mark.parametrize("gap", [0, 0.01])
def test_what_is_pressed_on_an_elastic_floor_is_told_soon(gap: float) -> None:
    """A plate comes down on two balls; only two of the three impacts lose energy."""
    plate = {"type": "box", "width": 1, "height": 0.2}
    bodies = {
        "floor": floor(restitution=1),
        "low": disc((0, 0.1), radius=0.1, restitution=1),
        "high": disc((0, 0.3), radius=0.1, restitution=0.5),
        "plate": {**fixed(plate, (0, 0.5 + gap), restitution=1), "type": "kinematic"},
    }
    bodies["plate"]["velocity"] = [0, -1]

    start = process_time()
    with pytest.raises(SimulationError, match="are wedged in and would collide for ever"):
        build(level(bodies, SEQUENCE)).advance(6)
    assert process_time() - start < 0.5  # 0.01 s; it took 0.8 s a kick, of up to 500


def test_the_impulses_that_stop_a_pile_push_and_leave_the_least_energy() -> None:
    """They push, nothing approaches then, and what parts is not pushed (Kuhn and Tucker)."""
    random = np.random.default_rng(5)
    for _ in range(100):
        k = int(random.integers(1, 6))
        jacobian = random.normal(size=(k, k + 2))
        delassus, parting = jacobian @ jacobian.T, random.normal(size=k)
        found = pushes(delassus, parting)
        assert found.min() >= 0
        assert (parting + delassus @ found).min() >= -1e-9
        assert abs(found @ (parting + delassus @ found)) <= 1e-9


def test_impulses_beyond_the_largest_number_come_to_an_end() -> None:
    """As those of light bodies that are thrown at each other as if they were nothing."""
    random = np.random.default_rng(5)
    with np.errstate(all="ignore"):
        for _ in range(200):
            jacobian = random.normal(size=(4, 6)) * 1e-16
            parting = random.normal(size=4) * 1e152
            parting[1] = -1e308
            assert not (pushes(jacobian @ jacobian.T, parting) < 0).any()


@pytest.mark.parametrize("endless", [np.inf, -np.inf, np.nan])
def test_what_answers_without_end_has_no_impulses(endless: float) -> None:
    """A decomposition of a matrix that holds an infinity never ends."""
    delassus = np.array([[2.0, 1.0, endless], [1.0, 2.0, 1.0], [endless, 1.0, 2.0]])

    assert np.isnan(pushes(delassus, -np.ones(3))).all()
    assert np.isnan(pushes(np.eye(2), np.array([endless, -1]))).all()


@pytest.mark.parametrize("degrees", [0, 40])
def test_a_box_that_lands_flat_on_two_corners_does_not_turn(degrees: float) -> None:
    angle = radians(degrees)
    ground = fixed({"type": "segment", "start": [-9, 0], "end": [9, 0]}, angle=angle, restitution=1)
    up = np.array([-sin(angle), cos(angle)])
    falling = box((1.25 * up).tolist(), angle=angle, velocity=(-2 * up).tolist(), restitution=0.8)
    world = build(level({"box": falling, "ground": ground}, {**SEQUENCE, "rotation": {}}))
    flight = run(world, 60)

    assert worst(flight.velocity[-1, 0] @ up, 1.6) <= 1e-12
    assert np.abs(flight.angular_velocity).max() <= 1e-12


def aligned(e: float, rate: float, height: float, effects: Spec) -> Array:
    """Return the speeds just after the first impact, of a ball let go above the ground."""
    scene = level(
        {"ball": disc((0, height), radius=0.1, restitution=e), "floor": floor(-0.1, restitution=1)},
        effects,
        stepping={"rate": rate},
    )
    flight = run(build(scene), int(rate))
    first = int(np.argmax(flight.velocity[:, 0, 1] > 0))
    return np.array([*flight.velocity[first - 1 : first + 2, 0, 1]])


@pytest.mark.parametrize("rate", [60, 240])
@pytest.mark.parametrize("e", [0.3, 0.8, 1])
def test_a_bounce_under_gravity_has_e_times_the_speed_at_the_impact(rate: int, e: float) -> None:
    """The impact falls on a step; pymunk is (1 − e) g dt / 2 too fast there."""
    height = G * 0.5**2 / 2  # half a second
    landing = G * 0.5
    ours, its = (
        aligned(e, rate, height, {**GRAVITY, **effects})[1] for effects in (SEQUENCE, TOGETHER)
    )

    assert ours == pytest.approx(e * landing, rel=1e-9)  # 1e-10: the skin
    assert its - ours == pytest.approx((1 - e) * G / rate / 2, rel=1e-6, abs=1e-8)


def test_the_speed_of_an_impact_is_of_second_order_where_forces_change() -> None:
    """A ball drawn to a wall by a spring meets it at a step, after a sixth of a period."""
    errors = []
    for rate in (60, 120):
        scene = level(
            {
                "ball": disc((1, 0), radius=0.1, restitution=0.5),
                "wall": fixed({"type": "box", "width": 0.2, "height": 1}, (0.3, 0), restitution=1),
            },
            SEQUENCE,
            joints={
                "spring": {
                    "type": "spring",
                    "ends": ["ball", [0, 0]],
                    "stiffness": (pi / 3 / 0.5) ** 2,
                    "length": 0,
                }
            },
            stepping={"rate": rate},
        )
        flight = run(build(scene), rate)
        first = int(np.argmax(flight.velocity[:, 0, 0] > 0))
        place, speed = flight.position[first, 0, 0], flight.velocity[first, 0, 0]
        errors.append(abs(speed - 0.5 * pi / 3 / 0.5 * sqrt(1 - place**2)))

    assert errors[0] <= 2e-4  # 1.4e-4
    assert 3.5 < errors[0] / errors[1] < 4.5


def test_a_pairs_own_coefficient_counts_in_sequence() -> None:
    pair = {"bodies": ["ball1", "ball0"], "coefficient": 0}
    effects = {"contact": {}, "restitution": {"impacts": "sequence", "pairs": [pair]}}
    end = build(row(np.ones(2), np.array([1.0, 0]), effects=effects)).advance(5)

    assert end.velocity[:, 0].tolist() == [0.5, 0.5]


def test_impacts_in_sequence_do_not_rub() -> None:
    with pytest.raises(LevelError, match="are frictionless"):
        level(
            {"a": disc(friction=1, restitution=1), "b": disc((3, 0), friction=1, restitution=1)},
            {**SEQUENCE, "friction": {}},
        )


def test_which_points_touch_is_worked_out_when_contacts_come_or_go(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Balls that lie side by side keep theirs; one that comes later changes them."""
    made, work_out = [0], sequential_impacts._PointIndices.of

    def counted(contacts: Contacts, turning: Booleans) -> sequential_impacts._PointIndices:
        made[0] += 1
        return work_out(contacts, turning)

    balls = {f"b{i}": disc((0.2 * i, 0.1), radius=0.1, restitution=0) for i in range(4)}
    late = disc((0.3, 1.5), radius=0.1, restitution=0)
    monkeypatch.setattr(sequential_impacts._PointIndices, "of", counted)
    world = build(
        level({"floor": floor(restitution=0), **balls, "late": late}, {**GRAVITY, **SEQUENCE})
    )
    begun = made[0]
    world.advance(30)

    assert made[0] == begun

    world.advance(30)

    assert begun < made[0] <= begun + 20


@pytest.mark.parametrize("closed", [False, pytest.param(True, marks=pytest.mark.sweep)])
def test_many_contacts_are_pushed_as_few_are(
    monkeypatch: pytest.MonkeyPatch, *, closed: bool
) -> None:
    """By Cholesky's factors instead of singular values; not in a ring, which is no better known."""
    count = 150
    delassus = 2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    if closed:
        delassus[0, -1] = delassus[-1, 0] = -1
    rates = -np.random.default_rng(1).uniform(0.5, 1, count)
    rates += closed * -rates.mean()  # a ring that is pressed everywhere cannot yield
    quick = pushes(delassus, rates)
    monkeypatch.setattr(pile_impacts, "LARGE", count)
    slow = pushes(delassus, rates)

    assert quick == pytest.approx(slow, rel=1e-9, abs=1e-9 * slow.max())
    assert (rates + delassus @ quick).min() > -1e-9


@pytest.mark.sweep
def test_a_long_wedged_row_is_told_soon() -> None:
    """400 elastic balls between a wall and a heavy ball took 2.4 s to be told."""
    masses = np.append(1e9, np.ones(399))
    scene = row(masses, np.append(3.0, np.zeros(399)))
    walled = {"wall": fixed({"type": "segment", "start": [79.9, -1], "end": [79.9, 1]})}
    bodies = scene.model_dump(mode="json", exclude_defaults=True)["bodies"]
    whole = level({**bodies, "wall": {**walled["wall"], "restitution": 1}}, SEQUENCE)
    start = process_time()
    with pytest.raises((LevelError, SimulationError), match="collide too often"):
        build(whole).advance(5)

    assert process_time() - start < 2  # 1.0 s
