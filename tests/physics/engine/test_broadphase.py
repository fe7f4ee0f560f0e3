"""How pairs are found may change what a step costs, never what it does."""

from math import inf

import pymunk
import pytest

from sandbox.model.level import Level, Scheme, Stepping
from sandbox.model.level_writing import text
from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.physics.engine import broadphase
from sandbox.physics.engine.broadphase import choose_broad_phase
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World


def gas(count: int) -> Level:
    return parse(text(crowd("gas", count)))


def discs(count: int, radius: float = 0.05) -> pymunk.Space:
    space = pymunk.Space()
    for i in range(count):
        body = pymunk.Body(1, 1)
        body.position = i % 50, i // 50
        space.add(body, pymunk.Circle(body, radius))
    return space


@pytest.mark.parametrize(("count", "grid"), [(100, False), (999, False), (1000, True)])
def test_a_grid_is_for_crowds(count: int, grid: bool) -> None:
    assert (choose_broad_phase(discs(count)) < inf) is grid


def test_a_large_shape_among_small_ones_keeps_the_tree() -> None:
    """A slope of 1 km would fill a hundred million cells."""
    space = discs(2000)
    space.add(pymunk.Segment(space.static_body, (-500, -500), (500, 500), 0.1))

    assert choose_broad_phase(space) == inf


def test_what_begins_beyond_a_grid_keeps_the_tree() -> None:
    space = discs(1000)
    next(iter(space.bodies)).position = -1e10, 0
    space.reindex_shapes_for_body(next(iter(space.bodies)))

    assert choose_broad_phase(space) == inf


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
