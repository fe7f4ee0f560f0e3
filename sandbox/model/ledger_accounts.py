"""The accounts of a level's ledger: the sources and destinations of its energy and momentum.

The energy that a force takes from the kinetic energy is stored as potential energy, lost, or
exchanged with the outside. Each effect declares which (see `sandbox.model.effects.contract`).
"""

from collections.abc import Iterator

from sandbox.model.effects.contact import Contact
from sandbox.model.effects.contract import Book
from sandbox.model.events import tied
from sandbox.model.joints import Joint, Spring, bodies_of
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.switched_forces import switched

OTHERS = ("bodies", "joints", "events", "damping", "supports")
"""The accounts that are not named after an effect or a joint."""


def potentials(level: Level) -> tuple[str, ...]:
    """Return the accounts that store energy: effects, and all springs together."""
    return tuple(dict.fromkeys((*_effects(level, "potential"), *_forces(level, "potential"))))


def works(level: Level) -> tuple[str, ...]:
    """Return the accounts of work: effects, kinematic bodies, joints and switches."""
    found = [*_effects(level, "work"), *_forces(level, "work")]
    if any(body.type == "kinematic" for body in level.bodies.values()):
        found.append("bodies")
    if any(drives(joint, level) for joint in level.joints.values()):
        found.append("joints")
    if switched(level):
        found.append("events")
    return tuple(dict.fromkeys(found))


def losses(level: Level) -> tuple[str, ...]:
    """Return the accounts that lose energy.

    A rope that becomes taut with a jerk counts as an impact, and so does a joint that is tied.
    """
    found, joints = [*_effects(level, "loss"), *_forces(level, "loss")], level.joints.values()
    if any(joint.kind.goes_slack for joint in joints) or _catches(level):
        found.append(Contact.effect.booked)
    if any(isinstance(joint, Spring) and damps(joint) for joint in joints):
        found.append("damping")
    return tuple(dict.fromkeys(found))


def _catches(level: Level) -> bool:
    """Whether an event ties an exact joint, which stops moving bodies."""
    held = (level.joints.get(name) for name in tied(level.events))
    return any(joint is not None and not joint.kind.force for joint in held)


def outside(level: Level) -> tuple[str, ...]:
    """Return the external accounts of momentum; `supports` is what bodies and joints rest on."""
    found = [e.name for e in level.effects.declarations if e.is_force and not e.inside]
    found += [joint.kind.force.name for joint in level.joints.values() if joint.kind.force]
    if level.effects.contact or any(not j.kind.force for j in level.joints.values()):
        found.append("supports")
    return tuple(dict.fromkeys(found))


def _effects(level: Level, book: Book) -> Iterator[str]:
    return (e.booked for e, _, one in level.effects.said if e.book_of(one) == book)


def _forces(level: Level, book: Book) -> Iterator[str]:
    forces = (joint.kind.force for joint in level.joints.values())
    return (force.booked for force in forces if force and force.book == book)


def drives(joint: Joint, level: Level) -> bool:
    """Whether an exact joint does work: it changes with time, or is held by a kinematic body."""
    if joint.kind.drives or joint.kind.force:
        return joint.kind.drives
    kinematic = any(level.bodies[body].type == "kinematic" for body in bodies_of(joint))
    return kinematic or "t" in names_in(joint)


def damps(spring: Spring) -> bool:
    """Whether a spring loses energy."""
    return bool(spring.damping.names) or spring.damping({}) > 0
