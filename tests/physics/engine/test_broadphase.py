"""How pairs are found may change what a step costs, never what it does."""

from math import inf
from random import Random
from time import process_time

import pymunk
import pytest

from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.level_writing import text
from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.physics.engine import broadphase
from sandbox.physics.engine.broadphase import add_shapes
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World


def gas(count: int) -> Level:
    return parse(text(crowd("gas", count)))


class Crowd:
    """Discs that are still to be added to their space, 50 in a row."""

    def __init__(self, count: int = 0) -> None:
        self.space, self.shapes = pymunk.Space(), list[pymunk.Shape]()
        for i in range(count):
            self.put(complex(i % 50, i // 50))

    def put(self, place: complex, radius: float = 0.05) -> None:
        body = pymunk.Body(1, 1)
        body.position = place.real, place.imag
        self.space.add(body)
        self.shapes.append(pymunk.Circle(body, radius))

    def has_grid(self) -> bool:
        return add_shapes(self.space, self.shapes) < inf


@pytest.mark.parametrize(("count", "grid"), [(100, False), (999, False), (1000, True)])
def test_a_grid_is_for_crowds(count: int, grid: bool) -> None:
    assert Crowd(count).has_grid() is grid


def test_a_large_shape_among_small_ones_keeps_the_tree() -> None:
    """It would fill a hundred million cells."""
    crowd = Crowd(2000)
    crowd.put(0, 500)

    assert not crowd.has_grid()


def test_what_begins_beyond_a_grid_keeps_the_tree() -> None:
    crowd = Crowd(1000)
    crowd.put(-1e10)

    assert not crowd.has_grid()


@pytest.mark.parametrize("growth", [1.0, 1.001])
def test_a_row_is_added_as_fast_in_order_as_in_disorder(growth: float) -> None:
    """In order, a tree is as deep as its shapes are many: 10,000 discs took 0.8 s, not 0.04."""
    ordered, mixed = list(range(5000)), list(range(5000))
    Random(1).shuffle(mixed)

    def took(order: list[int]) -> float:
        crowd = Crowd()
        for i in order:
            crowd.put(0.3 * i * growth**i, 0.1 * growth**i)
        began = process_time()
        assert crowd.has_grid() is (growth == 1)
        return process_time() - began

    both = [(took(ordered), took(mixed)) for _ in range(2)]

    assert min(a for a, _ in both) < 3 * min(b for _, b in both)


@pytest.mark.parametrize("speed", [-1e12, 1e12, -1e300])
@pytest.mark.parametrize("scheme", ["leapfrog", "symplectic-euler"])
def test_what_flies_out_of_a_grid_is_told(
    monkeypatch: pytest.MonkeyPatch, scheme: Scheme, speed: float
) -> None:
    """pymunk would look for it in cells without end, and never come back."""
    monkeypatch.setattr(broadphase, "CROWD", 10)
    world = build(gas(20), stepping=Stepping(scheme=scheme))
    name, body = next(iter(world.scene.bodies.items()))
    body.velocity = speed, 0

    with pytest.raises(SimulationError, match=f"'{name}' is more than"):
        world.advance()
    with pytest.raises(SimulationError):
        world.advance()


def test_nothing_is_put_beyond_a_grid(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(broadphase, "CROWD", 10)
    world = build(gas(20))
    name = next(iter(world.scene.bodies))

    with pytest.raises(SimulationError, match=f"'{name}' is more than"):
        world.place({name: (-1e12, 0)})
    world.advance()


def pairs(world: World) -> set[frozenset[int]]:
    return set(map(frozenset, world.contacts.bodies.tolist()))


def test_a_grid_finds_what_a_tree_finds(monkeypatch: pytest.MonkeyPatch) -> None:
    """The pairs are the same; in what order they are solved is not: 3e-7 m after half a second."""
    level = gas(400)
    tree = build(level)
    monkeypatch.setattr(broadphase, "CROWD", 10)
    grid = build(level)
    for _ in range(30):
        one, other = tree.advance(), grid.advance()
        assert pairs(tree) == pairs(grid)

    assert len(tree.contacts.bodies) > 10
    assert one.position == pytest.approx(other.position, abs=1e-5)


def test_a_grid_runs_alike_to_the_last_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(broadphase, "CROWD", 10)
    level = gas(300)
    one, other = (build(level).advance(120) for _ in range(2))

    assert one.position.tobytes() == other.position.tobytes()
    assert one.velocity.tobytes() == other.velocity.tobytes()
