"""The points of the plane through which the joints of a world are drawn."""

from collections.abc import Callable, Mapping
from itertools import chain, islice

import numpy as np

from sandbox.app.drawing.camera import Camera
from sandbox.app.stage import joints
from sandbox.model.joints import Joint, Rail, body_of
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.stepping.world import World

NONE: Mapping[str, list[XY]] = {}


def between_ends(world: World, name: str) -> list[XY]:
    """Return the points of a joint's anchors [m]."""
    places = (
        anchor.position_and_arm(world.snapshot)[0] for anchor in world.scene.joints.paths[name]
    )
    return [(float(place.real), float(place.imag)) for place in places]


def between_all_ends(world: World) -> Mapping[str, list[XY]]:
    """Return the points of the anchors of all joints [m], found at once."""
    paths, now = world.scene.joints.paths, world.snapshot
    anchors = list(chain.from_iterable(paths.values()))
    fixed = np.array([anchor.body is None for anchor in anchors])
    row = np.array([anchor.body or 0 for anchor in anchors])
    point = np.array([anchor.point for anchor in anchors])
    moved = now.position[row] @ (1, 1j) + point * np.exp(1j * now.angle[row])
    places = np.where(fixed, point, moved)
    ends = iter(zip(places.real.tolist(), places.imag.tolist(), strict=True))
    return {name: list(islice(ends, len(path))) for name, path in paths.items()}


def path_of(
    camera: Camera, world: World, name: str, joint: Joint, angle_of: Callable[[str], float],
    known_paths: Mapping[str, list[XY]] = NONE,
) -> list[XY]:  # fmt: skip
    """Return the points through which a joint is drawn [m], given the angles of bodies [rad].

    `known_paths` are the points of anchors that are known already.
    """
    if spring := world.scene.joints.springs.get(name):
        ends = spring.span(world.snapshot)
        return [(float(end.real), float(end.imag)) for end in ends]
    path = known_paths[name] if name in known_paths else between_ends(world, name)
    if isinstance(joint, Rail) and body_of(joint.ends[1]) is None:
        return _rail_ends(camera, world, joint, path[1])
    return joints.drawn_path(joint, path, world.values, angle_of)


def _rail_ends(camera: Camera, world: World, rail: Rail, through: XY) -> list[XY]:
    """Return two points of a rail outside the picture [m]."""
    (x, y), seen = camera.center, max(camera.size) / camera.scale
    direction = complex(*evaluate(rail.direction, world.values))
    direction /= abs(direction)
    start = complex(*through)
    position = start + direction * ((complex(x, y) - start) * direction.conjugate()).real
    return [
        (end.real, end.imag) for end in (position - seen * direction, position + seen * direction)
    ]
