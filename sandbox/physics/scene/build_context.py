"""Data that is passed between the parts of a scene while it is built."""

from math import inf
from typing import TYPE_CHECKING, NamedTuple

import pymunk

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.engine.space_arrays import Batch
from sandbox.physics.joints.scene_joints import Joints

if TYPE_CHECKING:
    from collections.abc import Mapping

    from sandbox.physics.contacts.coefficients.static_friction import Sticking
    from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
    from sandbox.physics.contacts.shapes.one_way_surfaces import Gates


class Pairs(NamedTuple):
    """The fields of a `Scene` for pairs of bodies, and the restitution of impacts in sequence."""

    callbacks: int = 0
    sticking: "Mapping[frozenset[int], Sticking]" = {}  # noqa: RUF012 (nobody writes to it)
    restitution: Array | None = None
    reach: float = inf
    hollows: "Hollows | None" = None
    gates: "Gates | None" = None


class BuildContext(NamedTuple):
    """The fields of a scene that are needed to make the solver of contacts; see `Scene`."""

    level: Level
    values: Values
    stepping: Stepping
    bodies: dict[str, pymunk.Body]
    batch: Batch
    joints: Joints
    inertia: Array
    inverse_mass: Array
