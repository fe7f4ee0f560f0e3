"""Where slipping ends, located in time: at rest, on a belt, in rolling, or the other way."""

from collections.abc import Callable
from functools import partial
from math import cos, inf, log, sin
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sandbox.model.errors import LevelError
from sandbox.model.expressions import Array
from sandbox.model.level import Level, Stepping
from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.engine.space_arrays import Batch
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, floor, level, pulley, run
from validation.case import textbook

MU = 0.3
BELT = 2.0  # m/s
FLAT: Spec = {"type": "box", "width": 200, "height": 1}


def rub(*located: str, **rest: object) -> Spec:
    """Return the effects of bodies that rub; `located` is left out where nobody is named.

    The direct solver would locate them by itself.
    """
    friction = {"located": located, **rest} if located else rest
    return {**GRAVITY, "contact": {"solver": "iterative"}, "friction": friction}


def thrown_along(speed: float, mu: float = MU, *, located: bool = True, rate: float = 60) -> Level:
    block = box(mass=2, friction=mu, velocity=[speed, 0])
    ground = fixed(FLAT, (0, -0.75), friction=1)
    effects = rub(*["block"] * located)
    return level({"block": block, "ground": ground}, effects, stepping={"rate": rate})


def sent_up(angle: float, static: float, *, located: bool = True) -> Level:
    """A block that is sent up a slope at 4 m/s, its centre at the origin."""
    velocity = [4 * cos(angle), 4 * sin(angle)]
    block = box(angle=angle, velocity=velocity, friction=MU, static_friction=static)
    ground = fixed(FLAT, (0.75 * sin(angle), -0.75 * cos(angle)), angle=angle, friction=1)
    return level({"block": block, "ground": ground}, rub(*["block"] * located))


def put_on_belt(angle: float, speed: float = 0.0, *, located: bool = True) -> Level:
    ground = fixed(FLAT, (0.75 * sin(angle), -0.75 * cos(angle)), angle=angle, friction=1)
    effects = rub(*["block"] * located) | {"belt": [{"body": "ground", "velocity": [BELT, 0]}]}
    block = box(angle=angle, friction=0.5, velocity=[speed * cos(angle), speed * sin(angle)])
    return level({"block": block, "ground": ground}, effects)


def thrown_on_plate(*, located: bool = True) -> Level:
    """A block on a kinematic plate."""
    plate = fixed(FLAT, (0, -0.75), friction=1) | {"type": "kinematic", "velocity": [1.5, 0]}
    scene = {"block": box(friction=MU, velocity=[4, 0]), "plate": plate}
    return level(scene, rub(*["block"] * located))


def bowled(shape: str, *, located: bool = True) -> Level:
    ball = disc(radius=0.4, mass=3, friction=0.2, velocity=[5, 0])
    ball["shape"]["type"] = shape
    scene = {"ball": ball, "ground": fixed(FLAT, (0, -0.9), friction=1)}
    return level(scene, {**rub(*["ball"] * located), "rotation": {}})


def drawn_by_weight(*, located: bool = True) -> Level:
    """A block that slides towards a peg, over which a weight hangs on it."""
    scene = {
        "block": box(mass=2, friction=0.4, velocity=[2, 0]),
        "weight": box((5, -1), size=(0.2, 0.2), mass=0.5, friction=0, velocity=[0, -2]),
        "table": fixed(FLAT, (-96, -0.75), friction=1),
    }
    string = pulley(["block", "weight"], [(5, 0)])
    return level(scene, rub(*["block"] * located), joints={"string": string})


def on_each_other(*, located: bool = True) -> Level:
    """A small block slides on a long one, until they go together on the ground."""
    scene = {
        "upper": box(mass=1, friction=1, velocity=[4, 0]),
        "lower": box((0, -0.5), size=(8, 0.5), mass=3, friction=1),
        "ground": fixed(FLAT, (0, -1.25), friction=1),
    }
    pairs = [
        {"bodies": ["upper", "lower"], "coefficient": 0.4},
        {"bodies": ["lower", "ground"], "coefficient": 0.05},
    ]
    return level(scene, rub(*["upper", "lower"] * located, pairs=pairs))


def stack(draw: np.random.Generator) -> Level:
    """One to three blocks on each other on a slope, all in motion, the lower ones long."""
    angle = draw.uniform(-0.5, 0.5)
    along, up = (np.array(way) for way in ((cos(angle), sin(angle)), (-sin(angle), cos(angle))))
    blocks, pairs, below = {}, [], "ground"
    for i, width in enumerate((40, 20, 1)[draw.integers(3) :]):
        velocity = list(draw.uniform(-4, 4) * along)
        size, mass = (width, 0.5), 10 ** draw.uniform(-0.5, 0.8)
        rest: Spec = {"angle": angle, "friction": 1, "velocity": velocity}
        blocks[f"block{i}"] = box(list(0.5 * i * up), size=size, mass=mass, **rest)
        mu = draw.uniform(0.05, 0.8)
        pairs.append({"bodies": [f"block{i}", below], "coefficient": mu, "static": 1.3 * mu})
        below = f"block{i}"
    ground = fixed({**FLAT, "width": 400}, list(-0.75 * up), angle=angle, friction=1)
    effects = rub(*blocks, pairs=pairs)
    if draw.random() < 0.5:
        effects["belt"] = [{"body": "ground", "velocity": [draw.uniform(-3, 3), 0]}]
    return level({**blocks, "ground": ground}, effects)


Phases = tuple[tuple[float, float], ...]
"""Each an acceleration [m/s²], and how long it lasts [s]."""


class Slide(NamedTuple):
    """A scene, and the closed form of its first body: which way, how fast, and how that changes."""

    make: Callable[..., Level]
    angle: float
    speed: float
    phases: Phases

    def at(self, t: float) -> np.ndarray:
        """Return way, velocity and acceleration at a time."""
        way, speed = 0.0, self.speed
        for rate, lasts in self.phases:
            if t < lasts:
                return np.array([way + speed * t + rate * t * t / 2, speed + rate * t, rate])
            way += speed * lasts + rate * lasts * lasts / 2
            speed, t = speed + rate * lasts, t - lasts
        raise AssertionError(t)


def until(speed: float, end: float, rate: float, after: float = 0.0) -> tuple[float, Phases]:
    """Return how fast a slide begins, and that at a certain speed it slides no more."""
    return speed, ((rate, (end - speed) / rate), (after, inf))


def up_and(angle: float, back: float) -> tuple[float, Phases]:
    return until(4, 0, -G * (sin(angle) + MU * cos(angle)), back)


def rolls(factor: float) -> tuple[float, Phases]:
    """k of I = k m r²: the speed at the end of sliding is 1 / (1 + k) of that at the start."""
    return until(5, 5 / (1 + factor), -0.2 * G)


DOWN = -G * (sin(0.6) - MU * cos(0.6))
TOGETHER = 4 / (0.4 * G + (0.4 - 0.05 * 4) * G / 3)  # s, until both blocks are as fast
SHARED = 4 - 0.4 * G * TOGETHER  # m/s
SLIDES = {
    "stops": Slide(partial(thrown_along, 3.0), 0, *until(3, 0, -MU * G)),
    "stops in the first step": Slide(partial(thrown_along, 0.01), 0, *until(0.01, 0, -MU * G)),
    "stays on a slope": Slide(partial(sent_up, 0.2, MU), 0.2, *up_and(0.2, 0)),
    "slides back": Slide(partial(sent_up, 0.6, MU), 0.6, *up_and(0.6, DOWN)),
    "static friction gives": Slide(partial(sent_up, 0.6, 0.5), 0.6, *up_and(0.6, DOWN)),
    "static friction holds": Slide(partial(sent_up, 0.6, 0.8), 0.6, *up_and(0.6, 0)),
    "on a belt": Slide(partial(put_on_belt, 0.0), 0, *until(0, BELT, 0.5 * G)),
    "against a belt": Slide(partial(put_on_belt, 0.0, -3.0), 0, *until(-3, BELT, 0.5 * G)),
    "up a belt": Slide(
        partial(put_on_belt, 0.2), 0.2, *until(0, BELT, G * (0.5 * cos(0.2) - sin(0.2)))
    ),
    "on a plate": Slide(thrown_on_plate, 0, *until(4, 1.5, -MU * G)),
    "disc rolls": Slide(partial(bowled, "disc"), 0, *rolls(1 / 2)),
    "hoop rolls": Slide(partial(bowled, "hoop"), 0, *rolls(1)),
    "on a string": Slide(drawn_by_weight, 0, *until(2, 0, -(0.4 * 2 - 0.5) * G / 2.5)),
    "on each other": Slide(
        on_each_other,
        0,
        4,
        ((-0.4 * G, TOGETHER), (-0.05 * G, SHARED / (0.05 * G)), (0, inf)),
    ),
}

slides = pytest.mark.parametrize("slide", SLIDES.values(), ids=SLIDES.keys())


def errors(slide: Slide, rate: float, *, located: bool = True) -> np.ndarray:
    """Return the largest errors of place, velocity and acceleration, read at the steps: (3,)."""
    flight = run(build(slide.make(located=located), stepping=Stepping(rate=rate)), int(2.5 * rate))
    way = np.array([cos(slide.angle), sin(slide.angle)])
    read = (flight.position, flight.velocity, flight.acceleration)
    expected = np.array([slide.at(float(t)) for t in flight.t])
    along = np.stack([values[:, 0] for values in read], axis=1)
    return np.asarray(np.abs(along - expected[..., None] * way).max(axis=(0, 2)))


@slides
@pytest.mark.parametrize("rate", [60, 73])
def test_slipping_ends_when_the_textbook_has_it(slide: Slide, rate: float) -> None:
    """Everything read at a step is right there: places to 3e-14, velocities to 2e-14."""
    place, velocity, acceleration = errors(slide, rate)

    assert place <= 1e-12
    assert velocity <= 1e-12
    assert acceleration <= 1e-9  # a string's pull is rounded by the square of the rate


@pytest.mark.parametrize("speed", [3.0, 3.02, 0.01])
def test_friction_is_read_as_it_acts_until_the_end(speed: float) -> None:
    """At the step before it, too, where pymunk has weakened it."""
    flight = run(build(thrown_along(speed)), 80)

    slipping = flight.t < speed / (MU * G)
    assert flight.friction[:, 0] == pytest.approx(np.where(slipping, 2 * MU * G, 0.0), abs=1e-11)
    assert flight.normal[:, 0] == pytest.approx(2 * G, rel=1e-12)


@pytest.mark.parametrize("share", [0, 1e-15, -1e-15, 1e-10, -1e-10])
def test_the_speed_is_right_where_slipping_ends_on_a_step(share: float) -> None:
    speed = MU * G / 60 * (50 + share)
    flight = run(build(thrown_along(speed)), 60)

    expected = np.maximum(speed - MU * G * flight.t, 0.0)
    assert np.abs(flight.velocity[:, 0, 0] - expected).max() <= 1e-10


@pytest.mark.parametrize("seed", range(4))
def test_a_coarse_run_agrees_with_a_fine_one(seed: int) -> None:
    """Stacks on slopes and belts with static friction, in which one slip after the other ends."""
    scene = stack(np.random.default_rng(seed))
    coarse, fine = (build(scene, stepping=Stepping(rate=rate)) for rate in (60, 240))
    ledger = Ledger(coarse)
    for _ in range(40):
        there, here = fine.advance(4), coarse.advance()
        ledger.note()
        assert np.abs(there.position - here.position).max() <= 1e-11

    assert abs(ledger.balance.unexplained) <= 1e-10
    assert np.abs(ledger.balance.unexplained_impulse).max() <= 1e-10


@slides
def test_without_locating_it_ends_in_the_next_kick(slide: Slide) -> None:
    """The check above can fail: pymunk weakens the friction of the whole kick."""
    assert max(errors(slide, rate, located=False)[0] for rate in (60, 67, 73)) > 1e-6


@slides
def test_the_books_close_over_the_end_of_slipping(slide: Slide) -> None:
    world = build(slide.make())
    ledger = Ledger(world)
    for _ in range(150):
        world.advance()
        ledger.note()

    balance = ledger.balance
    assert abs(balance.unexplained) <= 1e-12 * max(balance.loss["friction"], 1.0)
    assert np.abs(balance.unexplained_impulse).max() <= 1e-11


def test_what_flies_beside_an_end_of_slipping_is_seen_as_it_flies() -> None:
    """The kicks that are tried out for the block leave the ball's drag in the books as it was."""
    bodies = {
        "block": box((0, 0.25), mass=2, friction=1, velocity=[1, 0]),
        "ball": disc((5, 3), velocity=[1, 5], friction=1),
        "floor": floor(friction=1),
    }
    rubs = {"contact": {}, "friction": {"located": ["block"]}}
    world = build(level(bodies, {**GRAVITY, **rubs, "drag": {"linear": 0.3}}))
    ledger = Ledger(world)
    for _ in range(30):
        world.advance()
        ledger.note()

    assert np.abs(ledger.balance.unexplained_impulse[:2]).max() <= 1e-12


@slides
def test_it_ends_the_same_whether_each_step_is_looked_at_or_not(slide: Slide) -> None:
    watched, alone = build(slide.make()), build(slide.make())
    flight = run(watched, 150)

    last = alone.advance(150)

    assert last.position.tobytes() == flight.position[-1].tobytes()
    assert last.velocity.tobytes() == flight.velocity[-1].tobytes()
    assert last.friction.tobytes() == flight.friction[-1].tobytes()


@pytest.mark.sweep
@settings(max_examples=50)
@given(speed=st.floats(0.01, 8), mu=st.floats(0.2, 1.5), rate=st.floats(20, 240))
@example(speed=MU * G / 60 * 50, mu=MU, rate=60)  # on a step
@example(speed=MU * G / 60 * 50.5, mu=MU, rate=60)  # between two
def test_what_brakes_comes_as_far_as_its_energy_takes_it(
    speed: float, mu: float, rate: float
) -> None:
    """v² / (2 μ g), wherever in a step it comes to rest; and there it rests."""
    world = build(thrown_along(speed, mu, rate=rate))

    last = world.advance(int(speed / (mu * G) * rate) + 4)

    assert last.position[0, 0] == pytest.approx(speed**2 / (2 * mu * G), rel=1e-12)
    assert abs(last.velocity[0, 0]) <= 1e-14
    assert last.friction[0] <= 1e-9


@settings(max_examples=16)
@given(more=st.sampled_from([0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-6, 1e-3, 0.02]), first=st.booleans())
def test_several_come_to_rest_in_one_step(more: float, first: bool) -> None:
    """However close together: each goes on as it did until its own slipping ends."""
    speeds = [3.0, 3.0 * (1 + more)][:: 1 if first else -1]
    blocks = {
        f"block{i}": box((0, 2 * i), friction=MU, velocity=[v, 0]) for i, v in enumerate(speeds)
    }
    shelves = {f"shelf{i}": fixed(FLAT, (0, 2 * i - 0.75), friction=1) for i in range(2)}
    last = build(level({**blocks, **shelves}, rub(*blocks))).advance(80)

    assert last.position[:2, 0] == pytest.approx([v * v / (2 * MU * G) for v in speeds], rel=1e-12)


@pytest.mark.parametrize("rate", [60, 120])
def test_with_drag_the_end_is_of_second_order(rate: float) -> None:
    """v' = −μ g − k v ends at log(1 + k v / μ g) / k; it is 8e-6, 1.7e-6 of its way short."""
    speed, k, slows = 5.0, 0.8, MU * G
    scene = thrown_along(speed).model_dump(by_alias=True, exclude_none=True)
    scene["effects"]["drag"] = {"linear": 2 * k}
    last = build(Level.model_validate(scene), stepping=Stepping(rate=rate)).advance(int(2 * rate))

    way = (speed - slows / k * log(1 + k * speed / slows)) / k
    assert abs(last.position[0, 0] / way - 1) <= 1e-5 * (60 / rate) ** 2
    assert abs(last.velocity[0, 0]) <= 1e-15


def test_impacts_and_stops_are_located_side_by_side() -> None:
    scene = {
        "block": box(friction=MU, restitution=0, velocity=[3, 0]),
        "ball": disc((-5, 2), radius=0.2, friction=0, restitution=1),
        "ground": fixed(FLAT, (0, -0.75), friction=1, restitution=1),
    }
    effects = {**rub("block"), "contact": {"located": ["ball"]}, "restitution": {}}
    flight = run(build(level(scene, effects)), 120)

    slide, fall = Slide(thrown_along, 0, *until(3, 0, -MU * G)), np.sqrt(2 * 2.05 / G)
    expected = np.array([slide.at(float(t))[0] for t in flight.t])
    late = (flight.t + fall) % (2 * fall) - fall
    assert np.abs(flight.position[:, 0, 0] - expected).max() <= 1e-12
    assert np.abs(flight.position[:, 1, 1] + 0.05 - 2.05 + G * late**2 / 2).max() <= 1e-8


def test_a_block_that_hits_a_wall_as_it_comes_to_rest_stays_there() -> None:
    """The impact is pymunk's, and nothing is located in its step."""
    way = 3.0**2 / (2 * MU * G)
    scene = {
        "block": box(friction=MU, velocity=[3.0, 0]),
        "wall": fixed({"type": "box", "width": 1, "height": 1}, (way + 0.75 - 1e-4, 0), friction=1),
        "ground": fixed(FLAT, (0, -0.75), friction=1),
    }
    last = build(level(scene, rub("block"))).advance(120)

    assert last.position[0, 0] == pytest.approx(way, abs=2e-3)
    assert abs(last.velocity[0, 0]) <= 1e-12


def test_a_hand_may_pull_what_has_come_to_rest() -> None:
    world = build(thrown_along(1.0))
    world.advance(30)
    world.grab("block", (0.3, 0))

    world.drag((2.3, 0))
    pulled = world.advance(120).position[0, 0]
    world.release()

    assert pulled > 1.5
    assert abs(world.advance(60).velocity[0, 0]) <= 1e-12


def test_a_run_goes_on_from_where_a_body_is_put() -> None:
    """Just before it would have come to rest."""
    world = build(thrown_along(3.0))
    left = world.advance(61).velocity[0, 0]
    assert 0 < left < MU * G / 60

    world.place({"block": (10, 0)})

    assert world.advance(10).position[0, 0] == pytest.approx(10 + left**2 / (2 * MU * G), rel=1e-13)


@pytest.mark.parametrize("located", [True, False])
def test_only_who_asks_pays(located: bool) -> None:
    assert build(thrown_along(3.0, located=located)).hooks == located


def test_stock_pymunk_locates_nothing() -> None:
    assert build(thrown_along(3.0), stepping=Stepping(scheme="symplectic-euler")).hooks == 0


@pytest.mark.parametrize(
    ("name", "told"),
    [("ground", "'ground' is static"), ("blok", "'blok'"), ("", "at least 1")],
)
def test_who_cannot_come_to_rest_is_told(name: str, told: str) -> None:
    scene = {"block": box(friction=MU), "ground": fixed(FLAT, (0, -0.75), friction=1)}
    effects = {**GRAVITY, "contact": {}, "friction": {"located": [name] * bool(name)}}
    with pytest.raises(LevelError) as error:
        level(scene, effects)

    assert told in str(error.value)
    assert "friction.located" in str(error.value)


def test_what_hangs_on_a_rod_is_refused() -> None:
    scene = {"block": box(friction=MU), "ground": fixed(FLAT, (0, -0.75), friction=1)}
    rod = {"type": "rod", "ends": ["block", [0, 1]]}
    with pytest.raises(LevelError, match=r"'block' is held by 'rod'; the end of slipping"):
        level(scene, rub("block"), joints={"rod": rod})


def test_what_changes_its_mass_is_refused() -> None:
    scene = {"block": box(friction=MU), "ground": fixed(FLAT, (0, -0.75), friction=1)}
    with pytest.raises(LevelError, match="the mass of 'block' changes, so the end of its slip"):
        level(scene, {**rub("block"), "accretion": [{"body": "block", "rate": 1}]})


def test_what_rubs_on_something_that_hangs_on_a_rod_is_left_to_pymunk() -> None:
    """Rods and contacts come to terms too late for a kick to tell how they go on."""
    ground = fixed(FLAT, (0, -1.25), friction=0)
    scene = {**on_each_other().model_dump(by_alias=True, exclude_none=True)["bodies"]}
    scene |= {"ground": ground, "bob": disc((0, 2), radius=0.1, friction=0)}
    rod = {"type": "rod", "ends": ["lower", "bob"]}
    sweeps = {"solver": "iterative"}
    flights = [
        run(
            build(
                level(scene, {**rub(*["upper"] * located), "contact": sweeps}, joints={"rod": rod})
            ),
            90,
        )
        for located in (True, False)
    ]

    assert flights[0].position.tobytes() == flights[1].position.tobytes()


def test_a_heap_of_bodies_that_still_fall_is_left_to_pymunk() -> None:
    """What meets as its slipping ends is an impact; and no energy comes from it."""
    draw = np.random.default_rng(3)
    bodies = {}
    for i in range(4):
        rest: Spec = {"friction": 0.5, "velocity": [draw.uniform(-3, 3), 0]}
        place = (draw.uniform(-2, 2), 0.7 * i)
        bodies[f"b{i}"] = box(place, **rest) if i % 2 else disc(place, radius=0.3, **rest)
    ground = {"ground": fixed(FLAT, (0, -0.75), friction=1)}
    effects = {**rub(*bodies), "contact": {"overlaps": True}, "rotation": {}}
    world = build(level({**bodies, **ground}, effects))

    last = world.advance(40)  # the watchdog ends what gains energy

    assert np.abs(last.velocity).max() < 10


def test_rounding_that_goes_in_circles_is_not_kicked_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the ball begins to roll at 30 Hz, its last digits never settle: 1006 kicks, now 46."""
    scene = textbook("rotation/slide-to-roll")
    world = build(scene, stepping=Stepping(rate=30))
    kicks: list[Array] = []
    set_velocity = Batch.set_velocity

    def counted(batch: Batch, velocity: Array) -> None:
        kicks.append(velocity)
        set_velocity(batch, velocity)

    monkeypatch.setattr(Batch, "set_velocity", counted)
    world.advance(count_steps(world))

    assert len(kicks) < 300
