"""The points of the plane through which the joints of a world are drawn."""

from collections.abc import Callable

from sandbox.app.drawing.camera import Camera
from sandbox.app.stage import joints
from sandbox.model.joints import Joint, Rail, body_of
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.stepping.world import World


def between_ends(world: World, name: str) -> list[XY]:
    """Return the points of a joint's anchors [m]."""
    places = (anchor.look(world.snapshot)[0] for anchor in world.scene.joints.paths[name])
    return [(float(place.real), float(place.imag)) for place in places]


def path_of(
    camera: Camera, world: World, name: str, joint: Joint, angle_of: Callable[[str], float]
) -> list[XY]:
    """Return the points through which a joint is drawn [m], given the angles of bodies [rad]."""
    if spring := world.scene.joints.springs.get(name):
        ends = spring.span(world.snapshot)
        return [(float(end.real), float(end.imag)) for end in ends]
    path = between_ends(world, name)
    if isinstance(joint, Rail) and body_of(joint.ends[1]) is None:
        return _far_along(camera, world, joint, path[1])
    return joints.drawn(joint, path, world.values, angle_of)


def _far_along(camera: Camera, world: World, rail: Rail, through: XY) -> list[XY]:
    """Return two points of a rail outside the picture [m]."""
    (x, y), seen = camera.center, max(camera.size) / camera.scale
    way = complex(*evaluate(rail.direction, world.values))
    way /= abs(way)
    start = complex(*through)
    here = start + way * ((complex(x, y) - start) * way.conjugate()).real
    return [(end.real, end.imag) for end in (here - seen * way, here + seen * way)]
