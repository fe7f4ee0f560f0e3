"""Contacts asked for between two steps are those that a step finds."""

import numpy as np
import pytest

from sandbox.physics.contacts.detection.contact_queries import Query
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Contacts
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from tests.physics.scenes import Spec, box, disc, fixed, level

HOOP: Spec = {"type": "hoop", "radius": 1}
SKIN = 1e-6  # m
VALLEY: Spec = {"type": "polyline", "points": [[-2, 1], [0, 0], [2, 1]]}


def world(bodies: dict[str, Spec]) -> World:
    """What touches from the start on, and is solved directly."""
    contact = {"solver": "direct", "overlaps": True, "correction": 0}
    effects = {"contact": contact, "rotation": {}}
    return build(level(bodies, effects, stepping={"rate": 240}))


def asked(of: World, known: Contacts = NO_CONTACTS) -> Contacts:
    query = Query(of.scene.space, list(of.scene.bodies.values()), of.scene.hollows)
    rows = np.flatnonzero(of.scene.mass).tolist()
    return query.updated(known, rows, SKIN)


def sorted_out(contacts: Contacts) -> Contacts:
    """The same contacts, from the body that comes first to the other."""
    back = contacts.bodies[:, 0] > contacts.bodies[:, 1]
    sign = np.where(back, -1.0, 1.0)[:, None]
    return contacts._replace(
        bodies=np.sort(contacts.bodies, axis=1), direction=sign * contacts.direction
    ).in_order()


@pytest.mark.parametrize(
    "bodies",
    [
        {
            "a": box((0, 0.249)),
            "ground": fixed({"type": "box", "width": 4, "height": 1}, (0, -0.5)),
        },
        {"a": disc((0, 0)), "b": disc((0.6, 0.7))},
        {"a": box((0, 0)), "b": box((0.49, 0.1)), "c": disc((-0.7, 0.1))},
        {"a": disc((0, 0.51), radius=0.46), "valley": fixed(VALLEY)},
        {"a": disc((0.6, 0.01), radius=0.4), "hoop": fixed(HOOP)},
        {"hoop": fixed(HOOP), "a": disc((1.39, 0.01), radius=0.4)},
        {"a": box((0, 0.76), size=(0.1, 0.5)), "hoop": fixed(HOOP)},
    ],
)
def test_they_are_those_that_a_step_finds_there(bodies: dict[str, Spec]) -> None:
    scene = world(bodies)  # its first kick is given where everything is

    told, found = sorted_out(scene.contacts), asked(scene)

    assert len(told.bodies) > 0
    for name in ("bodies", "touches"):
        assert np.array_equal(getattr(found, name), getattr(told, name)), name
    assert found.direction == pytest.approx(told.direction, abs=1e-12)
    for row, count in enumerate(told.touches.tolist()):
        places = [np.column_stack((c.points[row], c.depths[row]))[:count] for c in (found, told)]
        one, other = (np.array(sorted(map(tuple, place.round(11)))) for place in places)
        assert one == pytest.approx(other, abs=1e-10)


def test_what_is_known_stays_as_it_is() -> None:
    scene = world({"a": disc((0, 0)), "b": disc((0.6, 0.7))})

    assert asked(scene, scene.contacts) is scene.contacts


def test_what_touches_at_more_shapes_than_it_did_is_found_anew() -> None:
    scene = world({"a": disc((0, 0.51), radius=0.46), "valley": fixed(VALLEY)})
    first = Contacts._make(field[:1] for field in scene.contacts)

    assert len(scene.contacts.bodies) == 2
    assert len(asked(scene, first).bodies) == 2


@pytest.mark.parametrize(("depths", "touches"), [((2e-8, 0), 2), ((1e-3, 0), 2), ((1e-3, 1e-3), 1)])
def test_what_is_deep_at_more_points_than_it_was_is_found_anew(
    depths: tuple[float, float], touches: int
) -> None:
    """A box on a floor, of which one corner was known, and which was turned onto the other."""
    ground = fixed({"type": "box", "width": 4, "height": 1}, (0, -0.5))
    scene = world({"a": box((0, 0.249)), "ground": ground})
    known = scene.contacts._replace(touches=np.array([1]), depths=np.array([depths]))

    assert asked(scene, known).touches.tolist() == [touches]
