"""From a level to a pymunk space: the only place where pymunk's objects are made.

What a level does not declare is not made: without contact no shape joins the space, without
rotation every moment is infinite, without friction or restitution the coefficients are zero.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Literal

import numpy as np
import pymunk
from pymunk import Vec2d

from sandbox.model.expressions import Values
from sandbox.model.level import Body, Level, Stepping
from sandbox.model.shapes import (
    XY,
    Box,
    Disc,
    Hoop,
    Polygon,
    Polyline,
    Segment,
    Shape,
    evaluate,
    points_of,
)
from sandbox.physics.batch import Batch
from sandbox.physics.broadphase import choose_broad_phase
from sandbox.physics.convex import convex_parts, twice_area
from sandbox.physics.joints import Joints, inverse
from sandbox.physics.laws import Gravity, Law, gravity, laws
from sandbox.physics.massflow import Share, mass_share
from sandbox.physics.outline import smallest
from sandbox.physics.schemes import REACH
from sandbox.physics.solids import Touches
from sandbox.physics.sticking import Sticking, sticking
from sandbox.physics.stiffness import check_springs

HAIR = 1e-9
"""m, how far flat surfaces stand proud. To pymunk, touching exactly is not touching: a block that
is placed on a surface would fall freely for half a step. Discs keep their radius, for rolling."""

INSET = 1e-8
"""m, how much smaller the core of a polygon is, which has this as its radius. Each body's differs a
little: between boxes that are as wide as each other, and stand in line but for the last digit,
pymunk now and then finds a sideways normal and throws them apart."""

SHARPEST = 1e-8
"""One plus the cosine between the normals of a corner's sides, below which it is not inset."""

GOLDEN = 0.6180339887498949
"""Its multiples, less their whole part, stay clear of each other."""

CORRECTION = 0.2
"""The share of an overlap that a step takes back, where the level has nothing else to say."""


SLOP = 1e-6
"""m, the overlap that is left alone, where the level has nothing else to say."""

PILE_SLOP = 0.005
"""The same in piles, of the width of the narrowest body that moves. With a tenth of it, stacks of 8
and more boxes are stirred by what takes overlaps back, and never rest."""

Rub = Literal["friction", "restitution"]

Collision = Callable[[pymunk.Arbiter, pymunk.Space, object], None]


@dataclass(frozen=True, slots=True)
class Scene:
    """A level's objects in pymunk, and what must be known of them to run and to measure.

    Attributes
    ----------
    bodies
        In the level's order, static and kinematic ones included; n of them.
    batch
        Reads and writes them.
    mass, moment
        (n,), of dynamic bodies at the start; 0 for others. The moment is 0, too, where nothing
        rotates.
    share
        How they change.
    agility
        (n, 3), what a force or torque is multiplied by to give an acceleration [1/kg, 1/(kg m²)].
    joints
        The joints, in the level's order.
    pair_callbacks
        How many callbacks the pairs with coefficients of their own make, with a contact each.
    restitution
        (n, n), the pairs' coefficients where impacts are a sequence; None where pymunk solves them.
    gravity, laws
        What acts on the bodies: gravity is pymunk's own, the laws need a hook.
    """

    space: pymunk.Space
    bodies: dict[str, pymunk.Body]
    batch: Batch
    mass: np.ndarray
    moment: np.ndarray
    share: Share
    agility: np.ndarray
    joints: Joints
    pair_callbacks: int
    restitution: np.ndarray | None
    gravity: Gravity | None
    laws: tuple[Law, ...]


def make_scene(level: Level, values: Values, stepping: Stepping) -> Scene:
    """Make the pymunk objects of a level for the given parameters.

    Raises
    ------
    SimulationError
        If springs are too stiff for the rate.
    """
    as_it_comes = stepping.as_it_comes
    space = pymunk.Space()
    space.iterations = stepping.iterations
    bodies = {name: _body(spec, level, values) for name, spec in level.bodies.items()}
    space.add(*bodies.values())
    pair_callbacks, coefficients = 0, None
    if level.effects.contact:
        hair = 0.0 if as_it_comes else HAIR
        if not as_it_comes:
            _skip_ids(space, level)
        for index, (name, spec) in enumerate(level.bodies.items()):
            space.add(*_surfaces(spec, bodies[name], level, values, hair, index + 1))
        choose_broad_phase(space)
        _run_belts(level, values, bodies)
        if level.effects.in_sequence and not as_it_comes:
            coefficients = _sequence(space, level, values)
        else:
            pair_callbacks = _pairs(space, level, values)
        if not as_it_comes:
            _settle(space, level, values, 1 / stepping.rate)
    dynamic = [body.body_type == pymunk.Body.DYNAMIC for body in bodies.values()]
    mass = np.array([body.mass for body in bodies.values()])
    moment = np.array([body.moment for body in bodies.values()])
    mass = np.where(dynamic, mass, 0.0)
    moment = np.where(np.isfinite(moment) & dynamic, moment, 0.0)
    share = mass_share(level.effects, values, list(bodies), mass)
    field = gravity(level.effects, values, mass, share)
    if field:
        space.gravity = field.acceleration
    batch = Batch(space, list(bodies.values()))
    joints = Joints(level, values, bodies, batch, mass, moment, _touches(space, level))
    agility = np.stack([inverse(mass), inverse(mass), inverse(moment)], axis=1)
    reach = REACH.get(stepping.scheme, 2.0)
    check_springs(joints.springs, agility, batch.state()[:, 2], stepping.rate, reach)
    return Scene(
        space=space,
        bodies=bodies,
        batch=batch,
        mass=mass,
        moment=moment,
        share=share,
        agility=agility,
        joints=joints,
        pair_callbacks=pair_callbacks,
        restitution=coefficients,
        gravity=field,
        laws=(
            *laws(level.effects, values, list(bodies), mass, share, 1 / stepping.rate),
            *joints.springs.values(),
        ),
    )


def _skip_ids(space: pymunk.Space, level: Level) -> None:
    """Use up the ids of shapes that are as small as the numbers of corners.

    pymunk knows a contact again by a hash of the two shapes' ids and corners. While both numbers
    come from the same small range, the two ends of a box's side can have the same hash, and each
    step starts one end from the other's impulse: a box with friction then never comes to rest.
    """
    corners = [len(b.shape.vertices) for b in level.bodies.values() if isinstance(b.shape, Polygon)]
    spare = pymunk.Circle(space.static_body, 1.0)
    for _ in range(max([4, *corners]) + 1):
        space.add(spare)
        space.remove(spare)


def _body(spec: Body, level: Level, values: Values) -> pymunk.Body:
    if spec.type == "dynamic":
        assert spec.mass is not None
        mass = spec.mass(values)
        body = pymunk.Body(mass, _moment(spec, mass, values) if level.effects.rotation else inf)
    else:
        static = spec.type == "static"
        body = pymunk.Body(body_type=pymunk.Body.STATIC if static else pymunk.Body.KINEMATIC)
    body.position = evaluate(spec.position, values)
    body.angle = spec.angle(values)
    if spec.type != "static":
        body.velocity = evaluate(spec.velocity, values)
        body.angular_velocity = spec.angular_velocity(values)
    return body


def _moment(spec: Body, mass: float, values: Values) -> float:
    """Return the moment of inertia about the centre of mass [kg m²]."""
    if spec.moment is not None:
        return spec.moment(values)
    match spec.shape:
        case Disc(radius=radius):
            return pymunk.moment_for_circle(mass, 0, radius(values))
        case Hoop(radius=radius):
            return pymunk.moment_for_circle(mass, radius(values), radius(values))
        case Box(width=width, height=height):
            return pymunk.moment_for_box(mass, (width(values), height(values)))
        case Polygon():
            return pymunk.moment_for_poly(mass, local_points(spec, values))
        case Segment() | Polyline():
            return _moment_of_line(mass, local_points(spec, values))


def _moment_of_line(mass: float, points: list[XY]) -> float:
    """Return the moment of a thin wire through points about the origin: Σ m_i (a² + a·b + b²)/3."""
    edges = np.array([(a, b) for a, b in pairwise(points)])
    a, b = edges[:, 0], edges[:, 1]
    length = np.hypot(*(b - a).T)
    square = np.sum(a * a + a * b + b * b, axis=1) / 3
    return float(mass * np.sum(length * square) / np.sum(length))


def local_points(spec: Body, values: Values) -> list[XY]:
    """Return the corners of a body's shape relative to it [m]; those of a disc or hoop are none.

    A dynamic body's are moved so that the origin is its centre of mass.
    """
    shape = spec.shape
    if isinstance(shape, Disc | Hoop):
        return []
    if isinstance(shape, Box):
        x, y = shape.width(values) / 2, shape.height(values) / 2
        return [(-x, -y), (x, -y), (x, y), (-x, y)]
    points = [evaluate(point, values) for point in points_of(shape)]
    if spec.type != "dynamic":
        return points
    cx, cy = _centroid(points, closed=isinstance(shape, Polygon))
    return [(x - cx, y - cy) for x, y in points]


def _centroid(points: list[XY], *, closed: bool) -> XY:
    """Return the centre of mass of a uniform polygon, or of a uniform wire."""
    a = np.array(points)
    b = np.roll(a, -1, axis=0)
    if closed:
        cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
        x, y = ((a + b) * cross[:, None]).sum(axis=0) / (3 * cross.sum())
    else:
        a, b = a[:-1], b[:-1]
        x, y = np.average((a + b) / 2, axis=0, weights=np.hypot(*(b - a).T))
    return float(x), float(y)


def _surfaces(
    spec: Body, body: pymunk.Body, level: Level, values: Values, hair: float, kind: int
) -> list[pymunk.Shape]:
    """Make the shapes with which a body touches others."""
    shapes = _outline(spec, spec.shape, body, values, hair, kind)
    effects = level.effects
    for shape in shapes:
        shape.collision_type = kind
        if effects.friction and spec.friction is not None:
            shape.friction = spec.friction(values)
        if effects.restitution and spec.restitution is not None:
            shape.elasticity = spec.restitution(values)
    return shapes


def _run_belts(level: Level, values: Values, bodies: dict[str, pymunk.Body]) -> None:
    """Let the surfaces of belts run; pymunk takes only what lies along a contact."""
    for belt in level.effects.belt or ():
        body = bodies[belt.body]
        along = Vec2d(*evaluate(belt.velocity, values)).rotated(body.angle)
        for shape in body.shapes:
            shape.surface_velocity = along


def _outline(
    spec: Body, shape: Shape, body: pymunk.Body, values: Values, hair: float, kind: int
) -> list[pymunk.Shape]:
    points = local_points(spec, values)
    match shape:
        case Disc(radius=radius) | Hoop(radius=radius):
            return [pymunk.Circle(body, radius(values))]
        case Box():
            return [_convex(body, points, hair, kind)]
        case Polygon():
            return [_convex(body, part, hair, kind) for part in convex_parts(points)]
        case Segment(thickness=thickness) | Polyline(thickness=thickness):
            return _line(body, points, thickness(values) / 2 + hair)


def _convex(body: pymunk.Body, points: list[XY], hair: float, kind: int) -> pymunk.Shape:
    """Make a convex polygon that stands proud by a hair, as a smaller one with a radius.

    A part of a cut polygon may be too thin for that; then it has the hair alone.
    """
    if not hair:
        return pymunk.Poly(body, points)
    inset = INSET * (1 + kind * GOLDEN % 1)
    a = np.array(points)
    edge = np.roll(a, -1, axis=0) - a
    outwards = np.stack([edge[:, 1], -edge[:, 0]], axis=1) / np.hypot(*edge.T)[:, None]
    outwards *= np.sign(twice_area(a))
    before = np.roll(outwards, 1, axis=0)
    blunt = 1 + np.sum(before * outwards, axis=1)
    if blunt.min() < SHARPEST:
        return pymunk.Poly(body, points, radius=hair)
    core = a - inset * (before + outwards) / blunt[:, None]
    return pymunk.Poly(body, [(float(x), float(y)) for x, y in core], radius=inset + hair)


def _line(body: pymunk.Body, points: list[XY], radius: float) -> list[pymunk.Shape]:
    """Make the segments through the points; each knows its neighbours: no ball trips at a join."""
    lines: list[pymunk.Shape] = []
    for i, (a, b) in enumerate(pairwise(points)):
        line = pymunk.Segment(body, a, b, radius)
        line.set_neighbors(points[max(i - 1, 0)], points[min(i + 2, len(points) - 1)])
        lines.append(line)
    return lines


def _settle(space: pymunk.Space, level: Level, values: Values, dt: float) -> None:
    """Choose how overlaps are dealt with; pymunk's own settings were made for pixels."""
    contact = level.effects.contact
    assert contact is not None
    if contact.correction is not None:
        correction = contact.correction(values)
    else:
        correction = 0.0 if level.effects.restitution else CORRECTION
    space.collision_bias = (1 - correction) ** (1 / dt)
    space.collision_slop = SLOP
    if contact.slop is not None:
        space.collision_slop = contact.slop(values)
    elif contact.piles:
        space.collision_slop = PILE_SLOP * smallest(space)


def pair_coefficients(level: Level, values: Values, kind: Rub) -> np.ndarray:
    """Return the coefficients of all pairs: (n, n)."""
    effect, names = getattr(level.effects, kind), list(level.bodies)
    if effect is None:
        return np.zeros((len(names), len(names)))
    given = (getattr(body, kind) for body in level.bodies.values())
    own = [coefficient(values) if coefficient else 0.0 for coefficient in given]
    coefficients = np.outer(own, own)
    for pair in effect.pairs:
        a, b = (names.index(name) for name in pair.bodies)
        coefficients[a, b] = coefficients[b, a] = pair.coefficient(values)
    return coefficients


def _sequence(space: pymunk.Space, level: Level, values: Values) -> np.ndarray:
    """Take the bounces from pymunk's solver, and return the pairs' coefficients: (n, n).

    Discs stand proud too: those that touch must be in contact, whatever the last digit says.
    """
    for shape in space.shapes:
        shape.elasticity = 0.0
        if isinstance(shape, pymunk.Circle):
            shape.unsafe_set_radius(shape.radius + HAIR)
    return pair_coefficients(level, values, "restitution")


def _pairs(space: pymunk.Space, level: Level, values: Values) -> int:
    """Give pairs coefficients of their own, and return how many callbacks a contact each makes."""
    kinds = {name: index + 1 for index, name in enumerate(level.bodies)}
    coefficients: dict[tuple[str, str], dict[str, float]] = {}
    for attribute in ("friction", "restitution"):
        effect = getattr(level.effects, attribute)
        for pair in effect.pairs if effect else ():
            a, b = sorted(pair.bodies)
            coefficients.setdefault((a, b), {})[attribute] = pair.coefficient(values)
    sticky = sticking(level, values)
    for a, b in coefficients | sticky:
        chosen, stick = coefficients.get((a, b), {}), sticky.get((a, b))
        space.on_collision(
            kinds[a], kinds[b], pre_solve=_setter(chosen, stick), post_solve=_judge(stick)
        )
    return len(coefficients | sticky) + len(sticky)


def _touches(space: pymunk.Space, level: Level) -> Touches | None:
    """Watch the pairs that are to stick to each other, if there are any."""
    sticking = level.effects.sticking
    if sticking is None:
        return None
    return Touches(space, list(level.bodies), [pair.bodies for pair in sticking.pairs])


def _setter(coefficients: dict[str, float], stick: Sticking | None) -> Collision:
    def choose(arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: object) -> None:
        for attribute, value in coefficients.items():
            setattr(arbiter, attribute, value)
        if stick:
            stick.choose(arbiter)

    return choose


def _judge(stick: Sticking | None) -> Collision | None:
    if stick is None:
        return None

    def judge(arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: object) -> None:
        stick.judge(arbiter)

    return judge
