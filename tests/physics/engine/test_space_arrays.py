"""Arrays of bodies and contacts: right rows, right order, and nobody else's memory."""

import os

import numpy as np
import pymunk
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pymunk.batch import ArbiterFields, Buffer, get_space_arbiters

from sandbox.physics.engine.arbiters import ArbiterTable
from sandbox.physics.engine.space_arrays import Batch
from sandbox.physics.run import build
from tests.elsewhere import python
from tests.physics.scenes import GRAVITY, box, disc, fixed, floor, level

TYPES = {
    "d": pymunk.Body.DYNAMIC,
    "s": pymunk.Body.STATIC,
    "k": pymunk.Body.KINEMATIC,
}


def space(types: str) -> tuple[pymunk.Space, list[pymunk.Body]]:
    made, bodies = pymunk.Space(), []
    for i, kind in enumerate(types):
        body = pymunk.Body(1, 1, TYPES[kind])
        body.position, body.angle = (i, 2 * i), 3 * i
        if kind != "s":
            body.velocity, body.angular_velocity = (4 * i, 5 * i), 6 * i
        bodies.append(body)
        made.add(body)
    return made, bodies


@settings(max_examples=50, deadline=None)
@given(st.text("dsk", min_size=1, max_size=12))
def test_rows_are_in_the_order_of_the_bodies_whatever_their_types(types: str) -> None:
    made, bodies = space(types)
    batch = Batch(made, bodies)
    moves = [kind != "s" for kind in types]
    i = np.arange(len(types), dtype=float)
    speeds = np.stack([4 * i, 5 * i, 6 * i], axis=1) * np.array(moves)[:, None]

    assert np.array_equal(batch.state()[:, :3], np.stack([i, 2 * i, 3 * i], axis=1))
    assert np.array_equal(batch.state()[:, 3:], speeds)
    assert np.array_equal(batch.velocity(), speeds)

    batch.set_velocity(speeds + 1)
    for body, expected in zip(bodies, speeds + 1, strict=True):
        if body.body_type != pymunk.Body.STATIC:
            assert [*body.velocity, body.angular_velocity] == expected.tolist()
    wrench = np.stack([7 * i, 8 * i, 9 * i], axis=1)
    batch.set_force(wrench)
    assert [[*body.force, body.torque] for body in bodies] == wrench.tolist()


def test_what_was_read_stays_when_the_space_moves_on() -> None:
    made, bodies = space("dd")
    batch = Batch(made, bodies)
    before = batch.state()
    copy = before.copy()
    made.step(1)
    batch.state()
    batch.set_velocity(np.zeros((2, 3)))

    assert np.array_equal(before, copy)


def test_contacts_are_in_the_order_of_the_bodies() -> None:
    """pymunk's own order is that of addresses: sums over it would differ from run to run."""
    bodies = {"floor": floor(), **{f"b{i}": disc((1.5 * i, 0.5)) for i in range(30)}}
    world = build(level(bodies, {**GRAVITY, "contact": {}}))
    world.advance()
    contacts = world.contacts

    assert len(contacts.bodies) == 30
    assert contacts.bodies.tolist() == sorted(contacts.bodies.tolist())
    assert contacts.normal * 60 == pytest.approx(np.full(30, 9.81))
    assert (contacts.friction == 0).all()
    body = contacts.bodies.max(axis=1)
    away = np.where(contacts.bodies[:, 0] == body, -1.0, 1.0)  # from the floor, up
    assert contacts.direction[:, 1] * away == pytest.approx(np.ones(30))


def test_pairs_are_read_as_pymunk_s_own_call_reads_them() -> None:
    """Its arguments are made once here, and the arrays grow as more bodies come to touch."""
    bodies = {"floor": floor(), **{f"b{i}": box((1.5 * i, 0.6 + i)) for i in range(12)}}
    space = build(level(bodies, {**GRAVITY, "contact": {}})).scene.space
    fields = ArbiterFields.BODY_A_ID | ArbiterFields.CONTACT_COUNT | ArbiterFields.POINT_A_1
    table, buffer, most = ArbiterTable(space, fields), Buffer(), 0
    for _ in range(120):
        space.step(1 / 60)
        buffer.clear()
        get_space_arbiters(space, fields, buffer)
        found = table.read()

        assert found == (bytes(buffer.int_buf()), bytes(buffer.float_buf()))
        most = max(most, len(found[0]))

    assert most >= 10 * 2 * 8


def test_a_pair_that_has_parted_is_no_contact() -> None:
    """pymunk remembers it for three steps, in case it comes back."""
    scene = level(
        {"ball": disc((0, 0.6), velocity=[0, -12], restitution=1), "wall": floor(restitution=1)},
        {"contact": {}, "restitution": {}},
    )
    world = build(scene)
    touched = []
    for _ in range(6):
        world.advance()
        touched.append(len(world.contacts.bodies))

    assert touched == [1, 0, 0, 0, 0, 0]


SCRIPT = """
import numpy as np
from sandbox.physics.run import build
from tests.elsewhere import python
from tests.physics.scenes import GRAVITY, atwood, box, disc, fixed, floor, level

build(atwood(1, 1.5)).advance(30)
for count in (1, 2, 3, 5, 8, 13, 100):
    shapes = [disc, box]
    bodies = {f"b{i}": shapes[i % 2]((i % 10, 1 + i // 10)) for i in range(count)}
    walls = {f"w{i}": floor(-1 - i) for i in range(count // 2 + 1)}
    bodies = dict(sorted({**bodies, **walls}.items(), key=lambda item: item[0][::-1]))
    sun = {"mu": 1, "center": [50, 50]}
    world = build(level(bodies, {**GRAVITY, "contact": {}, "attraction": [sun]}))
    for _ in range(30):
        assert np.isfinite(world.advance().position).all()
    world.place({name: (0.5 * i, 9) for i, name in enumerate(bodies)})
    world.advance(10)
print("unharmed")
"""


@pytest.mark.sweep
def test_the_arrays_write_nowhere_but_in_their_own_memory() -> None:
    """Under Python's debugging allocator a byte beyond the end of an array ends the process."""
    environment = {**os.environ, "PYTHONMALLOC": "debug", "MALLOC_CHECK_": "3"}
    done = python("-X", "faulthandler", "-c", SCRIPT, environment=environment)

    assert done.stdout == "unharmed\n", done.stderr


def test_a_thousand_bodies_mixed_keep_their_rows() -> None:
    shape = {"type": "disc", "radius": 0.1}
    bodies = {
        f"b{i}": fixed(shape, (i, 0)) if i % 3 else disc((i, 0), velocity=[0, i])
        for i in range(1000)
    }
    end = build(level(bodies, {})).advance(60)
    i = np.arange(1000)

    assert np.array_equal(end.position[:, 0], i)
    assert end.position[:, 1] == pytest.approx(np.where(i % 3, 0, i))


def test_a_box_beside_a_disc_is_one_contact_pair() -> None:
    world = build(level({"a": box(), "b": disc((0.7, 0))}, {"contact": {"overlaps": True}}))

    assert world.contacts.bodies.tolist() in ([[0, 1]], [[1, 0]])
