"""The forces on the bodies of a scene, and their sums, in words."""

from collections.abc import Iterator
from math import hypot, sqrt

from sandbox.app.observing.forces_on_selection import FAINT, cleared
from sandbox.app.words import formatting
from sandbox.physics.measuring.free_body import Acting, FreeBody
from sandbox.physics.measuring.free_body_forces import FreeBodies
from sandbox.physics.stepping.world import World

DIGITS = 4
MANY = 5
"""The largest number of forces on a body that share one line; more get a line each."""
TURNS = 1e-6
"""The lever arm up to which the torque of a force is not mentioned [m]."""


def forces(world: World) -> Iterator[str]:
    """Yield the present forces on each dynamic body: a line per body, or a line per force."""
    bodies = FreeBodies(world)
    for name, body in world.level.bodies.items():
        if body.type != "dynamic":
            continue
        found = bodies.of(name)
        lines = ["not known before the first step"] if found is None else [*_forces_on(found)]
        if len(lines) <= MANY + 1:
            yield f"{name}: {'; '.join(lines)}"
        else:
            yield f"{name}:"
            yield from (f"  {line}" for line in lines)


def way(x: float, y: float) -> str:
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
        if each.size > least or (arm and abs(each.couple) > least * arm)
    ]  # fmt: skip
    if not strong:
        yield "no force"
        return
    yield from map(_acting, strong)
    net = cleared(found.net, found)
    if not any(net):
        yield "together no force"
        return
    force = formatting.quantity(hypot(*net), "N", DIGITS)
    rate = formatting.quantity(hypot(*found.acceleration), "m/s²", DIGITS)
    when = "in an impact it accelerates" if found.struck else "it accelerates"
    yield f"together {force} {way(*net)}: {when} at {rate}"


def _acting(acting: Acting) -> str:
    """Return a force in words: its name, source, magnitude and direction."""
    name = f"{acting.name} from {acting.by}" if acting.by else acting.name
    torque = formatting.quantity(acting.couple, "N m", DIGITS)
    if not acting.size:
        return f"{name} as a torque of {torque}"
    size = formatting.quantity(acting.size, "N", DIGITS)
    message = f"{name} {size} {way(*acting.force)}"
    return (
        f"{message}, with a torque of {torque}"
        if abs(acting.couple) > TURNS * acting.size
        else message
    )
