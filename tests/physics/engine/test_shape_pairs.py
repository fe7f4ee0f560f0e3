"""Pairs of shapes are those that pymunk's own queries find, each once."""

from math import cos, sin
from random import Random

import pymunk
import pytest

from sandbox.physics.engine.shape_pairs import close_pairs, collision

Pairs = set[frozenset[pymunk.Shape]]


def scattered(seed: int, count: int = 40) -> pymunk.Space:
    """Discs, bars and triangles anywhere, some static, some that do not collide."""
    random, space = Random(seed), pymunk.Space()
    for _ in range(count):
        body = space.static_body if random.random() < 0.2 else pymunk.Body(1, 1)
        at = random.uniform(0, 3), random.uniform(0, 3)
        if body is not space.static_body:
            body.position, body.angle = at, random.uniform(0, 6)
            space.add(body)
        corners = [(0.4 * cos(a), 0.3 * sin(a)) for a in (0, 2, 4)]
        here = at if body is space.static_body else (0, 0)
        shapes = (
            pymunk.Circle(body, 0.3, here),
            pymunk.Segment(body, here, (here[0] + 0.5, here[1]), 0.1),
            pymunk.Poly(body, [(x + here[0], y + here[1]) for x, y in corners], radius=0.01),
        )
        shape = random.choice(shapes)
        group, own = random.choice((0, 0, 1)), random.choice((3, 1))
        shape.filter = pymunk.ShapeFilter(group, own, random.choice((3, 2)))
        space.add(shape)
    return space


def asked(space: pymunk.Space) -> Pairs:
    """The pairs with a dynamic body that pymunk finds, from each of the two."""
    return {
        frozenset((shape, hit.shape))
        for shape in space.shapes
        if shape.body is not space.static_body
        for hit in space.shape_query(shape)
        if hit.shape and hit.contact_point_set.points
    }


@pytest.mark.parametrize("seed", range(5))
def test_each_pair_that_touches_is_found_once(seed: int) -> None:
    space = scattered(seed)
    pairs = [pair for pair in close_pairs(list(space.shapes), own=True) if collision(*pair)]

    found = set(map(frozenset, pairs))
    assert found == asked(space)
    assert len(pairs) == len(found) > 10


def test_shapes_of_one_body_are_left_out_unless_they_are_asked_for() -> None:
    space = pymunk.Space()
    body = pymunk.Body(1, 1)
    space.add(body, pymunk.Circle(body, 1), pymunk.Circle(body, 2))

    assert not list(close_pairs(list(space.shapes)))
    assert len(list(close_pairs(list(space.shapes), own=True))) == 1


def test_pairs_within_reach_are_found() -> None:
    space = pymunk.Space()
    bodies = [pymunk.Body(1, 1) for _ in range(2)]
    bodies[1].position = 2.1, 0
    space.add(*bodies, *(pymunk.Circle(body, 1) for body in bodies))

    assert not list(close_pairs(list(space.shapes)))
    assert len(list(close_pairs(list(space.shapes), 0.2))) == 1


@pytest.mark.parametrize("seed", range(5))
def test_a_collision_is_pymunks_own_to_the_last_bit(seed: int) -> None:
    for one, other in close_pairs(list(scattered(seed).shapes), own=True):
        if found := collision(one, other):
            told = one.shapes_collide(other)
            assert found.normal == complex(*told.normal)
            both = [(complex(*p.point_a), complex(*p.point_b)) for p in told.points]
            assert found.points == both
