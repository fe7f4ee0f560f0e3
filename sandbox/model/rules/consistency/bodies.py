"""The fields of a body fit its type, and there are not too many bodies."""

from collections.abc import Iterator, Mapping

from sandbox.model.body import Body
from sandbox.model.errors import brief
from sandbox.model.level import ApexEvent, LandingEvent, Level
from sandbox.model.level_parts import Fault, instants
from sandbox.model.quantities import ATTRIBUTES_OF_BODIES
from sandbox.model.shapes import Arc, Area, Curve, Hoop, Line, Polygon, Polyline, Shape
from sandbox.model.translatable_message import Message, word

MAX_MOTIONS = 1000
"""The most kinematic bodies with a motion: that many take 0.8 s to check."""

MAX_MOTION_CHARACTERS = 100_000
"""The most characters in all different formulas of motions: to parse these, find their derivatives
and look for jumps takes more than a second."""

MAX_SURFACES = 30_000
"""The most surfaces that may touch: pymunk takes more than 100 s to free 40,000 in a heap."""

HOLLOW = 20
"""The surfaces as which an arc, a curve or a hoop counts: each takes half a millisecond to make."""

MAX_PAIRS_OF_EDGES = 10_000_000
"""The most pairs of polygon edges: checking that many takes a second."""

_FORBIDDEN: Mapping[str, tuple[str, ...]] = {
    "dynamic": ("motion",),
    "kinematic": ("mass", "moment"),
    "static": ("mass", "moment", "velocity", "angular_velocity", "motion"),
}
"""The fields that bodies of each type cannot have."""


def fields_fit(level: Level) -> Iterator[Fault]:
    """Bodies have the fields that their type needs, and no others."""
    for name, body in level.bodies.items():
        path = ("bodies", name)
        if body.type == "dynamic" and body.mass is None:
            yield Fault(path, "a dynamic body needs a mass")
        for field in _FORBIDDEN[body.type]:
            if is_set(body, field):
                yield Fault(
                    (*path, field),
                    "a {type} body has no {field}",
                    type=word(body.type),
                    field=word(field.replace("_", " ")),
                )


def motions_fit(level: Level) -> Iterator[Fault]:
    """Refuse a motion that is given twice, or that nothing else can react to."""
    dynamic = any(body.type == "dynamic" for body in level.bodies.values())
    for name, body in level.bodies.items():
        if body.motion is None:
            continue
        for field in ("velocity", "angular_velocity"):
            if is_set(body, field):
                message = Message("the 'motion' already determines the velocity; leave this out")
                yield Fault(("bodies", name, field), message)
        if not dynamic:
            message = Message("a 'motion' needs a dynamic body in the level; add one")
            yield Fault(("bodies", name, "motion"), message)


def rise_and_fall(level: Level) -> Iterator[Fault]:
    """Refuse apexes of bodies with constant velocity, and landings of bodies at rest."""
    static: Mapping[str, tuple[str, ...]] = {
        "apex": ("static", "kinematic"),
        "landing": ("static",),
    }
    for path, at in instants(level):
        if isinstance(at, ApexEvent | LandingEvent):
            body = level.bodies.get(at.body)
            if body and body.type in static[at.event]:
                rule = Message(
                    "'{body}' is {type}, so its {event} never happens",
                    body=brief(at.body),
                    type=word(body.type),
                    event=word(at.event),
                )
                yield Fault((*path, "body"), rule)


def sensors_fit(level: Level) -> Iterator[Fault]:
    """Sensors are areas, have no surface, and move only along given paths."""
    for name, body in level.bodies.items():
        if not body.sensor:
            continue
        path = ("bodies", name)
        if not isinstance(body.shape, Area):
            rule = Message(
                "a sensor must be a disc, a box or a polygon, not a {type}",
                type=word(body.shape.type),
            )
            yield Fault((*path, "shape"), rule)
        if body.type == "dynamic":
            rule = Message("a sensor must be static or kinematic, since nothing pushes it")
            yield Fault((*path, "sensor"), rule)
        for field in ("friction", "static_friction", "restitution"):
            if is_set(body, field):
                yield Fault((*path, field), "a sensor has no surface; leave it out")


def one_way_fits(level: Level) -> Iterator[Fault]:
    """One-way surfaces are lines, and something can move and touch them."""
    moves = any(body.type == "dynamic" for body in level.bodies.values())
    for name, body in level.bodies.items():
        if body.one_way is None:
            continue
        path = ("bodies", name, "one_way")
        if not isinstance(body.shape, Line):
            rule = Message(
                "only a segment, a polyline, an arc or a curve can be one-way, not a {type}",
                type=word(body.shape.type),
            )
            yield Fault(path, rule)
        if moves and level.effects.contact is None:
            yield Fault(path, "has no effect without 'contact'")
        sticking = level.effects.sticking
        for index, pair in enumerate(sticking.pairs if sticking else ()):
            if name in pair.bodies:
                yield Fault(
                    ("effects", "sticking", "pairs", index),
                    "nothing can stick to '{name}', which is one-way",
                    name=brief(name),
                )


def in_one_group(level: Level) -> Iterator[Fault]:
    """No body is in two of the groups that are selected together."""
    taken: set[str] = set()
    for index, group in enumerate(level.view.together):
        for name in sorted(taken.intersection(group)):
            yield Fault(
                ("view", "together", index),
                "'{name}' is already in another group",
                name=brief(name),
            )
        taken.update(group)


def is_set(body: Body, field: str) -> bool:
    """Whether a field differs from its default, which may be written out."""
    return bool(getattr(body, field) != type(body).model_fields[field].default)


def not_too_many_edges(level: Level) -> Iterator[Fault]:
    """Polygons have no more edges than can be compared in pairs."""
    corners = [len(b.shape.vertices) for b in level.bodies.values() if isinstance(b.shape, Polygon)]
    pairs = sum(count**2 for count in corners)
    if pairs > MAX_PAIRS_OF_EDGES:
        rule = Message(
            "have polygons with {corners:,} corners in all, and so {pairs:,} pairs of edges"
            " that may cross; at most {most:,} are allowed",
            corners=sum(corners),
            pairs=pairs,
            most=MAX_PAIRS_OF_EDGES,
        )
        yield Fault(("bodies",), rule)


def not_too_many(level: Level) -> Iterator[Fault]:
    """Bodies have no more surfaces and motions than can be handled in reasonable time."""
    touching = level.bodies.values() if level.effects.contact is not None else ()
    surfaces = sum(_pieces(body.shape) for body in touching if not body.sensor)
    if surfaces > MAX_SURFACES:
        yield Fault(
            ("bodies",),
            "have {count:,} surfaces in all; at most {most:,} may touch",
            count=surfaces,
            most=MAX_SURFACES,
        )
    motions = [body.motion for body in level.bodies.values() if body.motion]
    if len(motions) > MAX_MOTIONS:
        yield Fault(
            ("bodies",),
            "have {count:,} motions; at most {most:,} can be checked for jumps",
            count=len(motions),
            most=MAX_MOTIONS,
        )
    different = {str(one.source) for each in motions for one in (*each.displacement, each.turn)}
    if (length := sum(map(len, different))) > MAX_MOTION_CHARACTERS:
        yield Fault(
            ("bodies",),
            "have motions with formulas of {length:,} characters in all; at most {most:,} can be"
            " checked for jumps",
            length=length,
            most=MAX_MOTION_CHARACTERS,
        )


def _pieces(shape: Shape) -> int:
    """Return the most convex pieces that a shape may be divided into, or what takes as long."""
    match shape:
        case Arc() | Curve() | Hoop():
            return HOLLOW
        case Polyline(points=corners):
            return len(corners) - 1
        case Polygon(vertices=corners):
            return len(corners) - 2
    return 1


def points_fit(level: Level) -> Iterator[Fault]:
    """Points of bodies do not have the names of quantities."""
    for body, written in level.bodies.items():
        for name in sorted(ATTRIBUTES_OF_BODIES.intersection(written.points)):
            rule = Message(
                "'{name}' is a quantity of the body itself; choose another name", name=name
            )
            yield Fault(("bodies", body, "points", name), rule)
