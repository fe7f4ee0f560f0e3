"""The accounts of a level's ledger: the sources and destinations of its energy and momentum.

The energy that a force takes from the kinetic energy is stored as potential energy, lost, or
exchanged with the outside. Each effect declares which (see `sandbox.model.effects.contract`).
"""

from collections.abc import Iterator

from sandbox.model.effects.contact import Contact
from sandbox.model.effects.contract import Book
from sandbox.model.events import tied_joints
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
    accounts = [*_effects(level, "work"), *_forces(level, "work")]
    if any(body.type == "kinematic" for body in level.bodies.values()):
        accounts.append("bodies")
    if any(drives(joint, level) for joint in level.joints.values()):
        accounts.append("joints")
    if switched(level):
        accounts.append("events")
    return tuple(dict.fromkeys(accounts))


def losses(level: Level) -> tuple[str, ...]:
    """Return the accounts that lose energy.

    A rope that becomes taut with a jerk counts as an impact, and so does a joint that is tied.
    """
    accounts, joints = [*_effects(level, "loss"), *_forces(level, "loss")], level.joints.values()
    if any(joint.kind.goes_slack for joint in joints) or _ties_joints(level):
        accounts.append(Contact.effect.account_name)
    if any(isinstance(joint, Spring) and damps(joint) for joint in joints):
        accounts.append("damping")
    return tuple(dict.fromkeys(accounts))


def _ties_joints(level: Level) -> bool:
    """Whether an event ties an exact joint, which stops moving bodies."""
    ties = (level.joints.get(name) for name in tied_joints(level.events))
    return any(joint is not None and not joint.kind.force for joint in ties)


def external_accounts(level: Level) -> tuple[str, ...]:
    """Return the external accounts of momentum; `supports` is what bodies and joints rest on."""
    accounts = [e.name for e in level.effects.declarations if e.is_force and not e.is_internal]
    accounts += [joint.kind.force.name for joint in level.joints.values() if joint.kind.force]
    if level.effects.contact or any(not j.kind.force for j in level.joints.values()):
        accounts.append("supports")
    return tuple(dict.fromkeys(accounts))


def _effects(level: Level, book: Book) -> Iterator[str]:
    return (e.account_name for e, _, one in level.effects.settings if e.book_of(one) == book)


def _forces(level: Level, book: Book) -> Iterator[str]:
    forces = (joint.kind.force for joint in level.joints.values())
    return (force.account_name for force in forces if force and force.book == book)


def drives(joint: Joint, level: Level) -> bool:
    """Whether an exact joint does work: it changes with time, or is held by a kinematic body."""
    if joint.kind.drives or joint.kind.force:
        return joint.kind.drives
    kinematic = any(level.bodies[body].type == "kinematic" for body in bodies_of(joint))
    return kinematic or "t" in names_in(joint)


def damps(spring: Spring) -> bool:
    """Whether a spring loses energy."""
    return bool(spring.damping.names) or spring.damping({}) > 0
