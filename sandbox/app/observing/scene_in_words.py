"""Describes a scene in words, for a terminal or a screen reader."""

from cmath import exp
from collections.abc import Iterator
from itertools import islice
from math import hypot, sqrt

from sandbox.app.observing.forces_on_selected_body import FAINT, without_rounding
from sandbox.app.words import formatting
from sandbox.model.body import Body
from sandbox.model.joints import End, Held, Joint, Pulley, Wire, points
from sandbox.model.shapes import Box, Disc, Hoop, Segment, Shape, evaluate
from sandbox.physics.measuring.free_body import AppliedForce, FreeBody
from sandbox.physics.measuring.free_body_forces import FreeBodies
from sandbox.physics.measuring.grading import Result
from sandbox.physics.stepping.world import World

DIGITS = 4
TOGETHER = 5
"""The largest number of forces on a body that share one line; more get a line each."""
TURNS = 1e-6
"""With no longer a lever arm than this, the torque of a force is not mentioned [m]."""


STILL = 1e-9
"""A body that is no faster than this is described as at rest [m/s, rad/s]."""

NEAR = 1e-6
"""A point no further from an axis than this fraction of the view's width is described as on the
axis."""

MANY = 40
"""The largest number of bodies, joints or contacts that are described one by one; the others are
only counted."""


def describe(
    world: World, results: tuple[Result, ...], *, with_forces: bool = False
) -> Iterator[str]:
    """Yield lines that describe the stage, the results of the checks, and perhaps the forces."""
    level = world.level
    yield f"{level.title}. {level.summary}".strip()
    yield f"Time: {formatting.number(world.t, 4)} s of {level.duration(world.values):.4g} s."
    declared = [name for name, effect in level.effects if effect is not None]
    yield f"Effects: {', '.join(declared) or 'none'}."
    yield from _section("Parameters", _parameters(world), len(level.parameters))
    yield from _section("Bodies", _bodies(world), len(level.bodies))
    yield from _section("Joints", _joints(world), len(level.joints))
    yield from _section("Contacts", _contacts(world), len(world.contacts.bodies))
    if with_forces:
        dynamic = sum(body.type == "dynamic" for body in level.bodies.values())
        yield from _section("Forces", forces(world), dynamic)
    yield from _section("Checks", map(_check, results), len(results))
    if level.challenge:
        yield f"Challenge: {level.challenge.task}"


def _section(heading: str, lines: Iterator[str], total: int) -> Iterator[str]:
    """Yield a heading and its lines, if there are any; those beyond `MANY` are not made."""
    if total:
        yield f"{heading}:"
        yield from (f"  {line}" for line in islice(lines, MANY))
        if total > MANY:
            yield f"  and {total - MANY:,} more"


def _parameters(world: World) -> Iterator[str]:
    for name, parameter in world.level.parameters.items():
        value = formatting.with_unit(formatting.setting(world.values[name]), parameter.unit)
        yield f"{parameter.label or name} ({name}): {value}"


def _bodies(world: World) -> Iterator[str]:
    for row, (name, body) in enumerate(world.level.bodies.items()):
        place = _ends if isinstance(body.shape, Segment) else _place
        yield f"{name}: {_looks(body, world)}{place(world, row)}{_motion(world, row)}"


def _looks(body: Body, world: World) -> str:
    kind = "" if body.type == "dynamic" else f"{body.type} "
    article = "a" if kind or not _shape(body.shape, world).startswith("arc") else "an"
    mass = f", {formatting.quantity(body.mass(world.values), 'kg', 4)}" if body.mass else ""
    lets = f" that lets bodies through to its {body.one_way} only" if body.one_way else ""
    return f"{article} {kind}{_shape(body.shape, world)}{lets}{mass}"


def _shape(shape: Shape, world: World) -> str:
    values = world.values
    match shape:
        case Disc(radius=radius) | Hoop(radius=radius):
            return f"{shape.type} of radius {formatting.quantity(radius(values), 'm', 3)}"
        case Box(width=width, height=height):
            size = (formatting.quantity(side(values), "m", 3) for side in (width, height))
            return f"box of {' by '.join(size)}"
        case _:
            return str(shape.type)


def _ends(world: World, row: int) -> str:
    """Describe a segment by its ends, since its body's position may be far from it."""
    shape = list(world.level.bodies.values())[row].shape
    assert isinstance(shape, Segment)
    place = complex(*world.snapshot.position[row].tolist())
    turn = exp(1j * float(world.snapshot.angle[row]))
    start, end = (
        _point(world, place + turn * complex(*evaluate(corner, world.values)))
        for corner in (shape.start, shape.end)
    )
    return f", from {start} to {end}"


def _point(world: World, point: complex) -> str:
    least = NEAR * world.level.view.width(world.values)
    seen = (part if abs(part) > least else 0.0 for part in (point.real, point.imag))
    x, y = (formatting.quantity(value, "m", 4) for value in seen)
    return f"x = {x}, y = {y}"


def _place(world: World, row: int) -> str:
    at = _point(world, complex(*world.snapshot.position[row].tolist()))
    angle = float(world.snapshot.angle[row])
    rotation = f", turned by {formatting.quantity(angle, 'rad', 3)}" if abs(angle) > STILL else ""
    return f", at {at}{rotation}"


def _motion(world: World, row: int) -> str:
    if list(world.level.bodies.values())[row].type == "static":
        return ""
    vx, vy = (float(value) for value in world.snapshot.velocity[row])
    spin = float(world.snapshot.angular_velocity[row])
    moves = f"moves {direction_in_words(vx, vy)} at {formatting.quantity(hypot(vx, vy), 'm/s', 4)}"
    sense = "counter-clockwise" if spin > 0 else "clockwise"
    turns = f"turns {sense} at {formatting.quantity(abs(spin), 'rad/s', 3)}"
    motions = [*([moves] if hypot(vx, vy) > STILL else []), *([turns] if abs(spin) > STILL else [])]
    return f"; {' and '.join(motions) or 'at rest'}"


def _joints(world: World) -> Iterator[str]:
    for name, joint in world.level.joints.items():
        tension = float(world.scene.joints.tension(name, world.snapshot))
        pulls = "pulls" if tension >= 0 or isinstance(joint, Wire) else "pushes"
        force = formatting.quantity(abs(tension), "N", 4)
        yield f"{name}: {_ties(joint, world)}; {pulls} with {force}"


def _ties(joint: Joint, world: World) -> str:
    if isinstance(joint, Wire):
        return f"a wire that guides {_end(joint.bead, world)}"
    first, *pegs, last = (_end(end, world) for end in points(joint))
    over = f" over {', '.join(pegs)}" if isinstance(joint, Pulley) else ""
    return f"a {joint.type} from {first}{over} to {last}"


def _end(end: End, world: World) -> str:
    if isinstance(end, Held):
        return f"a point of {end.body}"
    if isinstance(end, str):
        return end
    x, y = (formatting.number(value, 3) for value in evaluate(end, world.values))
    return f"the point ({x} m, {y} m)"


def _contacts(world: World) -> Iterator[str]:
    names, contacts = list(world.level.bodies), world.contacts
    forces = contacts.normal / world.dt
    strongest = max(forces.max(initial=0.0), abs(world.snapshot.tension).max(initial=0.0))
    for (first, second), force in zip(contacts.bodies, forces.tolist(), strict=True):
        text = f"press on each other with {formatting.quantity(force, 'N', 4)}"
        yield f"{names[first]} and {names[second]} {text if force > FAINT * strongest else 'touch'}"


def _check(result: Result) -> str:
    check = result.check
    label = check.label or check.quantity
    if result.measured is None or result.expected is None or result.error is None:
        return f"{label}: {result.verdict}"
    measured, expected = (
        formatting.quantity(value, result.unit) for value in (result.measured, result.expected)
    )
    return f"{label}: {measured}, expected {expected}; {result.verdict}"


def forces(world: World) -> Iterator[str]:
    """Yield the present forces on each dynamic body, as one line, or with a line per force."""
    bodies = FreeBodies(world)
    for name, body in world.level.bodies.items():
        if body.type != "dynamic":
            continue
        found = bodies.of(name)
        lines = ["not known before the first step"] if found is None else [*_forces_on(found)]
        if len(lines) <= TOGETHER + 1:
            yield f"{name}: {'; '.join(lines)}"
        else:
            yield "\n    ".join((f"{name}:", *lines))


def direction_in_words(x: float, y: float) -> str:
    """Return the nearest of eight directions in words, y up."""
    steep, level = abs(y) > 0.4142 * abs(x), abs(x) > 0.4142 * abs(y)
    sideways = ("right" if x > 0 else "left") if level else ""
    upright = ("up" if y > 0 else "down") if steep else ""
    return " and ".join(part for part in (sideways, upright) if part)


def _forces_on(found: FreeBody) -> Iterator[str]:
    """Yield each force, and the resultant."""
    arm = sqrt(found.moment / found.mass)  # m, radius of gyration
    least = FAINT * found.largest
    strong = [
        each for each in found.forces
        if each.magnitude > least or (arm and abs(each.couple) > least * arm)
    ]  # fmt: skip
    if not strong:
        yield "no force"
        return
    yield from map(_acting, strong)
    net = without_rounding(found.net, found)
    if not any(net):
        yield "together no force"
        return
    force = formatting.quantity(hypot(*net), "N", DIGITS)
    rate = formatting.quantity(hypot(*found.acceleration), "m/s²", DIGITS)
    when = "in an impact it accelerates" if found.struck else "it accelerates"
    yield f"together {force} {direction_in_words(*net)}: {when} at {rate}"


def _acting(acting: AppliedForce) -> str:
    """Return a force in words: its name, source, magnitude and direction."""
    name = f"{acting.name} from {acting.by}" if acting.by else acting.name
    torque = formatting.quantity(acting.couple, "N m", DIGITS)
    if not acting.magnitude:
        return f"{name} as a torque of {torque}"
    size = formatting.quantity(acting.magnitude, "N", DIGITS)
    message = f"{name} {size} {direction_in_words(*acting.force)}"
    return (
        f"{message}, with a torque of {torque}"
        if abs(acting.couple) > TURNS * acting.magnitude
        else message
    )
