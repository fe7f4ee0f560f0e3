"""The accounts of a level's ledger: where its energy and its momentum come from, and where they go.

What a force takes from the kinetic energy is stored as potential energy, or lost for good, or was
put in from outside.
"""

from collections.abc import Iterator

from sandbox.model.effects import Force
from sandbox.model.joints import Joint, Motor, Pulley, Rod, Rope, Spring, Winding, bodies_of
from sandbox.model.level import Level

FIELDS = ("gravity", "attraction", "gravitation", "centrifugal")
"""The effects that store energy."""

DRIVES = ("thrust", "accretion", "belt")
"""The effects that put energy in."""

INSIDE = ("gravitation",)
"""The forces that give no momentum to all bodies together."""


def potentials(level: Level) -> tuple[str, ...]:
    """Return what stores energy: effects, and springs all together."""
    found = [name for name in level.effects.declared if name in FIELDS]
    if any(not does_work(force) for force in level.effects.force or ()):
        found.append("force")
    if any(isinstance(joint, Spring) for joint in level.joints.values()):
        found.append("spring")
    return tuple(found)


def works(level: Level) -> tuple[str, ...]:
    """Return what puts energy in, or takes it out: effects, bodies that move as told, joints."""
    found = [name for name in level.effects.declared if name in DRIVES]
    if any(does_work(force) for force in level.effects.force or ()):
        found.insert(0, "force")
    if any(body.type == "kinematic" for body in level.bodies.values()):
        found.append("bodies")
    if any(drives(joint, level) for joint in level.joints.values()):
        found.append("joints")
    return tuple(found)


def losses(level: Level) -> tuple[str, ...]:
    """Return what takes energy for good; a rope that is jerked taut counts as an impact."""
    return tuple(_losses(level))


def _losses(level: Level) -> Iterator[str]:
    effects, joints = level.effects, level.joints.values()
    if effects.drag:
        yield "drag"
    if effects.friction:
        yield "friction"
    if effects.contact or any(isinstance(joint, Rope | Pulley | Winding) for joint in joints):
        yield "impacts"
    if any(isinstance(joint, Spring) and damps(joint) for joint in joints):
        yield "damping"
    if effects.sticking:
        yield "sticking"


def outside(level: Level) -> tuple[str, ...]:
    """Return what gives momentum from outside; supports are what bodies and joints rest on."""
    forces = (*FIELDS, "force", "drag", *DRIVES)
    found = [n for n in level.effects.declared if n in forces and n not in (*INSIDE, "belt")]
    if any(isinstance(joint, Spring) for joint in level.joints.values()):
        found.append("spring")
    if level.effects.contact or any(not isinstance(j, Spring) for j in level.joints.values()):
        found.append("supports")
    return tuple(found)


def does_work(force: Force) -> bool:
    """Whether a given force has no potential: it changes with time, or turns with its body."""
    return force.frame == "body" or any("t" in component.names for component in force.force)


def drives(joint: Joint, level: Level) -> bool:
    """Whether an exact joint does work: it changes with time, or is held by what moves as told."""
    if isinstance(joint, Spring | Motor):
        return isinstance(joint, Motor)
    if isinstance(joint, Rod) and joint.length is not None and "t" in joint.length.names:
        return True
    return any(level.bodies[body].type == "kinematic" for body in bodies_of(joint))


def damps(spring: Spring) -> bool:
    """Whether a spring takes energy."""
    return bool(spring.damping.names) or spring.damping({}) > 0
