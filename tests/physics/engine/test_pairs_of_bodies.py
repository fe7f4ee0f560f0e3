"""Two bodies read and written by themselves, whichever way is the shortest."""

from itertools import permutations, product

import pymunk
import pytest

from sandbox.physics.engine.pairs_of_bodies import Pair, PairWithFixed, WholeSpace, pair_of

KINDS = [pymunk.Body.DYNAMIC, pymunk.Body.KINEMATIC, pymunk.Body.STATIC]


def bodies(*kinds: int) -> tuple[pymunk.Space, list[pymunk.Body]]:
    """A space with bodies of some kinds, each with a position and a velocity of its own."""
    space, made = pymunk.Space(), []
    for i, kind in enumerate(kinds):
        body = pymunk.Body(1, 1, kind)
        body.position = 1.5 + i, -2.5 * i - 1
        if kind != pymunk.Body.STATIC:
            body.velocity = 0.5 - i, 7.5 + i
        space.add(body)
        made.append(body)
    return space, made


@pytest.mark.parametrize("kinds", list(product(KINDS, repeat=2)))
@pytest.mark.parametrize("others", [(), (pymunk.Body.DYNAMIC,), (pymunk.Body.STATIC,)])
def test_a_pair_is_what_pymunk_says_of_its_bodies(
    kinds: tuple[int, int], others: tuple[int, ...]
) -> None:
    space, held = bodies(*kinds, *others)
    nail = pymunk.Body(body_type=pymunk.Body.STATIC)
    nail.position = 8, 9
    for a, b in permutations([*held[:2], space.static_body, nail], 2):
        pair = pair_of(a, b)

        assert list(pair.read()) == [*a.position, *a.velocity, *b.position, *b.velocity]

        before = {body: (body.position, body.velocity) for body in (*held, space.static_body)}
        moves = [body.body_type != pymunk.Body.STATIC for body in (a, b)]
        wanted = [(3.5, -4.5) if moves[0] else (0, 0), (0.25, 1.25) if moves[1] else (0, 0)]
        pair.set_velocity(*wanted[0], *wanted[1])

        assert [a.velocity, b.velocity] == wanted
        assert list(pair.read()) == [*a.position, *wanted[0], *b.position, *wanted[1]]
        for body, (position, velocity) in before.items():
            assert body.position == position
            assert body is a or body is b or body.velocity == velocity


def test_the_shortest_way_is_taken() -> None:
    space, (a, b) = bodies(pymunk.Body.DYNAMIC, pymunk.Body.DYNAMIC)
    more, (c, d, _) = bodies(*[pymunk.Body.DYNAMIC] * 3)

    assert type(pair_of(a, b)) is WholeSpace
    assert type(pair_of(b, a)) is Pair  # in another order
    assert type(pair_of(c, d)) is Pair
    assert type(pair_of(a, space.static_body)) is PairWithFixed
    assert type(pair_of(more.static_body, c)) is PairWithFixed
