"""What is within a hoop does not touch what is outside: the hoop lies between the two."""

import pytest

from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World
from tests.physics.scenes import GRAVITY, G, Spec, disc, floor, level

SOLVERS: list[Spec] = [{"solver": "direct"}, {"solver": "iterative"}]
FLOOR = floor(friction=0.7)


def hoop(radius: float, x: float, y: float, **rest: object) -> Spec:
    """Return a hoop of 2 kg."""
    shape = {"type": "hoop", "radius": radius}
    return {"shape": shape, "mass": 2, "position": [x, y], "friction": 0.7, **rest}


def world_of(bodies: dict[str, Spec], contact: Spec, rate: float = 240) -> World:
    effects = {**GRAVITY, "contact": contact, "friction": {}, "rotation": {}}
    return build(level(bodies, effects, stepping={"rate": rate}))


def pairs(world: World) -> set[frozenset[str]]:
    """Return who touches whom."""
    names = list(world.scene.bodies)
    return {frozenset(names[row] for row in pair) for pair in world.contacts.bodies.tolist()}


@pytest.mark.parametrize("contact", SOLVERS)
def test_a_ball_in_a_hoop_stands_on_the_hoop_and_not_on_the_floor(contact: Spec) -> None:
    """The floor bore the ball, at the point where the hoop lies between the two."""
    ball = disc((0, 0.2), radius=0.2, mass=3, friction=0.7)
    world = world_of({"floor": FLOOR, "ring": hoop(0.5, 0, 0.5), "ball": ball}, contact)
    world.advance(240)

    assert pairs(world) == {frozenset(("floor", "ring")), frozenset(("ring", "ball"))}
    assert world.snapshot.normal == pytest.approx([5 * G, 8 * G, 3 * G], rel=1e-6)


def test_hoops_within_each_other_stand_on_each_other() -> None:
    bodies = {
        "floor": FLOOR,
        "outer": hoop(0.5, 0, 0.5),
        "inner": hoop(0.3, 0, 0.3),
        "ball": disc((0, 0.1), radius=0.1, mass=3, friction=0.7),
    }
    world = world_of(bodies, {"solver": "direct"})
    world.advance(60)

    weights = [7 * G, 7 * G + 5 * G, 5 * G + 3 * G, 3 * G]
    assert world.snapshot.normal == pytest.approx(weights, rel=1e-6)


@pytest.mark.parametrize("contact", SOLVERS)
def test_equal_hoops_around_one_point_are_told_to_overlap(contact: Spec) -> None:
    """Each was within the other and outside of it, and was to be kept from touching itself."""
    rings = {"one": hoop(10, 0, 0), "other": hoop(10, 0, 0)}

    with pytest.raises(SimulationError, match="'one' and 'other' overlap by 20 m"):
        world_of({**rings, "ball": disc((30, 0), friction=0.7)}, contact)


def test_a_floor_that_crosses_a_hoop_bears_what_is_in_it() -> None:
    still: Spec = {"type": "static", "mass": None}
    ring = {k: v for k, v in {**hoop(1, 0, 0.9), **still}.items() if v is not None}
    ball = disc((0, 0.2), radius=0.2, mass=3, friction=0.7)
    world = world_of({"floor": FLOOR, "ring": ring, "ball": ball}, {"solver": "direct"})
    world.advance(60)

    assert pairs(world) == {frozenset(("floor", "ball"))}


def test_what_is_put_out_of_a_hoop_stands_on_the_floor() -> None:
    ball = disc((0, 0.2), radius=0.2, mass=3, friction=0.7)
    bodies = {"floor": FLOOR, "ring": hoop(0.5, 0, 0.5), "ball": ball}
    world = world_of(bodies, {"solver": "direct"})
    world.place({"ball": (3, 0.2)})
    world.advance(60)

    assert pairs(world) == {frozenset(("floor", "ring")), frozenset(("floor", "ball"))}


@pytest.mark.parametrize("rate", [60, 240])
def test_a_hoop_that_falls_lands_at_its_own_time(rate: int) -> None:
    """It was met where the step ended: 46 mm deep at 60 Hz, and lifted out by 0.9 J."""
    beside = disc((3, 0.1), radius=0.1, friction=0.7)
    bodies = {"floor": FLOOR, "ring": hoop(0.5, 0, 1.6), "beside": beside}
    world = world_of(bodies, {"solver": "direct"}, rate)
    heights = [float(world.advance().position[1, 1]) for _ in range(rate)]

    assert min(heights) >= 0.5 - 1e-7
    assert heights[-1] == pytest.approx(0.5, abs=1e-7)


def test_more_pairs_than_can_be_excluded_are_refused() -> None:
    """30 hoops with 100 discs in each took half a minute and more than half a gigabyte."""
    inside = {f"in{i}": disc((i % 15 - 7, i // 15 - 7), radius=0.1) for i in range(225)}
    beside = {f"out{i}": disc((i % 15 + 20, i // 15), radius=0.1) for i in range(225)}
    ring = {"shape": {"type": "hoop", "radius": 12}, "mass": 2}

    with pytest.raises(SimulationError, match="hoops separate more than 50,000 pairs") as told:
        build(level({"ring": ring, **inside, **beside}, {"contact": {}}))
    assert told.value.subject == "ring"


def test_more_hollow_bodies_in_one_place_than_can_be_judged_are_refused() -> None:
    """300 arcs within each other took 25 s to check."""
    shapes = [{"type": "arc", "radius": 1 + i / 10, "start": 0, "end": 3} for i in range(46)]
    arcs = {f"arc{i}": {"shape": shape, "mass": 1} for i, shape in enumerate(shapes)}

    with pytest.raises(SimulationError, match="more than 1,000 pairs of bodies are close"):
        build(level(arcs, {"contact": {}}))
