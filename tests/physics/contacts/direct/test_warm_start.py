"""The warm start of a kick recognises contacts whose bodies pymunk has exchanged."""

from collections.abc import Callable

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solver import DirectSolver
from sandbox.physics.contacts.direct.solving.warm_start import recalled
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, Spec, box, fixed, level

EFFECTS = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
LEAN = 0.1
"""The slope of the floor [rad]."""


def sloping() -> DirectSolver:
    """Return the solver of two boxes, one on the other, that rest on a slope by unequal corners."""
    c, s = np.cos(LEAN), np.sin(LEAN)

    def above(along: float, high: float) -> tuple[float, float]:
        return c * along - s * high, s * along + c * high

    bodies: dict[str, Spec] = {
        "floor": fixed({"type": "box", "width": 4, "height": 1}, above(0, -0.5)),
        "lower": box(above(0, 0.25), size=(1, 0.5)),
        "upper": box(above(0.15, 0.65), size=(0.4, 0.3), mass=5),
    }
    for body in bodies.values():
        body |= {"angle": LEAN, "friction": 0.8}
    world = build(level(bodies, EFFECTS, stepping={"rate": 240}))
    world.advance(4)
    direct = world.scene.direct
    assert direct
    return direct


def exchanged(contacts: Contacts) -> Contacts:
    """Return contacts as pymunk finds them if it takes the other body of each first."""
    return contacts._replace(
        bodies=contacts.bodies[:, ::-1].copy(),
        direction=-contacts.direction,
        points=contacts.points[:, ::-1].copy(),
        depths=contacts.depths[:, ::-1].copy(),
    )


def reordered(contacts: Contacts) -> Contacts:
    """Return the same contacts in another order."""
    return Contacts._make(field[::-1].copy() for field in contacts)


def forces_on(kick: Kick, forces: Array, body: int) -> Array:
    """Return the normal forces on a body, and friction: (2, 3) [N, N m]."""
    return kick.wrenches(forces, body).sum(axis=1)


@pytest.mark.parametrize("change", [exchanged, reordered])
def test_contacts_keep_their_forces_where_their_bodies_change_places(
    change: Callable[[Contacts], Contacts],
) -> None:
    """Both points of a side, and the friction, whose row is on the surface of the second body.

    Before, the torque of the normal forces of exchanged bodies was -11.9 instead of -2.7 N m.
    """
    direct = sloping()
    taken = direct._taken
    assert taken
    assert (taken.kick.contacts.touches == 2).all()
    builder, old = direct._build, taken.kick

    new = builder.rebuilt(old.pose, change(old.contacts), old.kept_lengths)
    forces, active = recalled(old, taken.forces, taken.active, new)

    for body in (1, 2):
        there, here = forces_on(old, taken.forces, body), forces_on(new, forces, body)
        assert here == pytest.approx(there, abs=1e-6)  # but for the skin
    assert active.on.sum() == taken.active.on.sum()
