"""How contacts are solved where a level leaves that open: directly, or by pymunk's sweeps."""

from collections import Counter
from collections.abc import Sequence

from sandbox.model.effects.contact import Contact
from sandbox.model.events import cut_joints, tied_joints
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression, Values
from sandbox.model.joints import (
    Held,
    OneSided,
    Pulley,
    bodies_of,
    body_of,
    is_exact,
    is_solved_by_pymunk,
    points,
)
from sandbox.model.level import Level, Stepping

MOST_SPRUNG = 20
"""A level whose only joints are springs is solved directly by default if at most this many bodies
move. A landing block of 16 discs on springs takes 3 ms a step, one of 25 takes 5 ms, more than a
step at 240 Hz lasts."""

MOST_PILED = 50
"""A level without joints is solved directly by default if at most this many bodies move. A wall of
46 bricks takes 14 ms a step, a pour of 30 discs 40 ms; one of 60 takes 0.3 s."""

UNEQUAL = 3
"""Above this ratio of masses sweeps do not settle an impact. Where a heavy disc drives a light one
into a wall, with e = 0, they leave 7e-4 of the energy unexplained at 3 : 1, 4 % at 10 : 1 and 50 %
at 1000 : 1."""

FEW = 3
"""From this many bodies on several impacts may happen at once. Sweeps solve them one after the
other: when a rack of 15 balls is broken head-on, at e = 0.5, the speeds of its halves differ by
0.3 m/s. A gas of 3, 10 and 30 discs costs 2, 3 and 8 times as much if it is solved directly, 1.4 ms
a step for the last."""


def is_direct(level: Level, stepping: Stepping | None = None) -> bool:
    """Whether contacts are solved directly, together with the exact joints.

    If the effect `contact` leaves that open, they are if it is possible and one of these holds:

    - The level has exact joints.
    - Bodies stick, and impacts are located.
    - The stepping, the level's own by default, asks for it.
    - Bodies may press on each other or meet at once, and the stepping neither names a solver nor
      starts without half a kick.
    """
    contact = level.effects.contact
    if contact is None:
        return False
    if contact.solver is not None:
        return contact.solver == "direct"
    joined = any(map(is_exact, level.joints.values()))
    sticks = contact.located and level.effects.sticking
    stepping = stepping or level.stepping
    needed = joined or sticks or stepping.solver == "direct"
    if not needed and not stepping.solver and not stepping.is_stock:
        needed = _may_press(level, contact)
    return bool(needed) and may_be_direct(level)


def _may_press(level: Level, contact: Contact) -> bool:
    """Whether bodies may press on each other or meet at once, and the level does not need sweeps.

    Sweeps stay if impacts are located or taken in sequence, and if bodies may overlap at the start,
    since sweeps also separate these. Few enough bodies must move.

    On springs one body is enough. Without joints there must be a second one, and a force, a third
    body or, at the default parameters, a much larger mass: two equal bodies meet one at a time, and
    what rests on immovable bodies alone needs only a few sweeps.
    """
    if contact.located or contact.overlaps or level.effects.in_sequence:
        return False
    masses = [b.mass for b in level.bodies.values() if b.type == "dynamic" and b.mass]
    if level.joints:
        return len(masses) <= MOST_SPRUNG
    if not 1 < len(masses) <= MOST_PILED:
        return False
    forced = any(effect.is_force for effect in level.effects.declarations)
    return forced or len(masses) >= FEW or _are_unequal(masses, level.defaults)


def _are_unequal(masses: Sequence[Expression], defaults: Values) -> bool:
    """Return whether masses differ much.

    They do not if one has no value: the level will be refused for that.
    """
    try:
        values = [mass(defaults) for mass in masses]
    except (KeyError, ExpressionError):
        return False
    return max(values) > UNEQUAL * min(values)


def may_be_direct(level: Level) -> bool:
    """Whether contacts may be solved directly, and the level leaves that open.

    It must not contain what only pymunk solves: pymunk's own joints, or located ends of slipping.
    """
    contact, friction = level.effects.contact, level.effects.friction
    if contact is None or contact.solver is not None:
        return False
    left = any(map(is_solved_by_pymunk, level.joints.values()))
    return not left and not (friction and friction.located)


def has_one_sided_joints(level: Level, stepping: Stepping | None = None) -> bool:
    """Whether one-sided joints of a level without contacts may catch: ropes, windings, stops.

    These include strings that share a body with another exact joint, but not stops that rebound.
    """
    joints, stepping = level.joints.values(), stepping or level.stepping
    if level.effects.contact or stepping.scheme != "leapfrog":
        return False
    if any(map(is_solved_by_pymunk, joints)):
        return False
    sided = (joint for joint in joints if isinstance(joint, OneSided))
    if any(getattr(joint, "restitution", None) is None for joint in sided):
        return True
    return sum(isinstance(joint, Pulley) for joint in joints) > len(_lone_strings(level))


def lone_strings(level: Level) -> set[str]:
    """Return the joints that are plain strings and share no moving body with another exact joint.

    There are none if contacts are solved directly, or if one-sided joints may catch. A string that
    an event cuts or ties, or that may break, is not among them.
    """
    if is_direct(level) or has_one_sided_joints(level):
        return set()
    return _lone_strings(level)


def _lone_strings(level: Level) -> set[str]:
    """Return the plain strings over pegs that share no moving body with another exact joint."""
    exact = (joint for joint in level.joints.values() if is_exact(joint))
    counts = Counter(body for joint in exact for body in set(bodies_of(joint)))
    changed, found = cut_joints(level.events, level.joints) | tied_joints(level.events), set()
    for name, joint in level.joints.items():
        if not isinstance(joint, Pulley) or name in changed:
            continue
        first, *pegs, last = points(joint)
        plain = not (isinstance(first, Held) or isinstance(last, Held) or any(map(body_of, pegs)))
        moving = (body for body in bodies_of(joint) if level.bodies[body].type == "dynamic")
        if plain and all(counts[body] == 1 for body in moving):
            found.add(name)
    return found
