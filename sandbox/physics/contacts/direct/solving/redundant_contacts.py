"""Contacts made redundant by joints, such as that of a body with the ground to which it is pinned.

Such a contact has no freedom left, and as its rounded corner turns, it contradicts the pin by some
nanometres. There the pin holds, and the contact bears nothing.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.redundant_systems import CUT, nearest
from sandbox.physics.contacts.direct.rows.contact_properties import SLOP
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Layout
from sandbox.physics.contacts.shapes.pymunk_shapes import DIRECT_SKIN
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.state.simulation_errors import NoForces

MOVES = 1e3 * CUT
"""Joints determine a contact if they leave it less than this share of its inverse mass."""


def without_held(kick: Kick) -> tuple[Layout, Booleans] | None:
    """Return the layout without the contacts that joints determine, and which these are: (k,).

    None if there are none.
    """
    layout = kick.layout
    if not len(layout.joined):
        return None
    count, rows = len(layout.joined), layout.tied
    delassus = kick.rows_at_start.jacobian.take(rows, axis=0).dot(
        kick.response.take(rows, axis=0).T
    )
    across, own = delassus[:count, count:], delassus.diagonal()[:count]
    shares = nearest(delassus[count:, count:], across.T)
    redundant = layout.joined[own - np.vecdot(across, shares.T) <= MOVES * own]
    if not len(redundant):
        return None
    decided = np.zeros(layout.gaps.stop - layout.gaps.start, dtype=bool)
    decided[redundant] = True
    pushes = layout.problem.pushes.copy()
    pushes[layout.gaps] &= ~decided
    return layout.asking(layout.problem._replace(pushes=pushes)), decided


def check_held(kick: Kick, decided: Booleans, motion: Array) -> None:
    """Refuse a motion in which joints push bodies into each other.

    `decided`, (k,), tells which contacts joints determine; `motion`, (3 N,), are the velocities in
    the drift [m/s, rad/s]. Raises `NoForces` if bodies come to overlap by more than the skin.
    """
    gaps, touching = kick.layout.gaps, kick.layout.touching
    end_rows = kick.rows(motion * kick.joints.drift).total
    deep = (np.minimum(kick.targets(), -SLOP) - end_rows)[gaps] * decided
    if deep.max() > DIRECT_SKIN:
        raise NoForces(*touching.bodies[:, int(deep.argmax())].tolist())
