"""Joints hold bodies that they can hold."""

from collections.abc import Iterator

from sandbox.model.contact_solver_choice import is_direct
from sandbox.model.errors import brief
from sandbox.model.events import rebounding_stops, tied_joints
from sandbox.model.joints import (
    Joint,
    Own,
    Rod,
    Spring,
    Wire,
    bodies_of,
    body_of,
    is_exact,
    is_solved_by_pymunk,
    points,
)
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault, names_in
from sandbox.model.rules.consistency.references_by_name import bodies_of_flows
from sandbox.model.shapes import Curve
from sandbox.model.translatable_message import Message

MAX_WIRES = 200
"""The most wires and curves in a level: checking one takes 3 ms, at the defaults and at both ends
of the ranges."""


NO_WIRE = Message("an event cannot tie a wire; tie a rail, or let the body start on the wire")
AS_FOUND = Message("a rod that an event ties takes the distance that it finds; leave out 'length'")
SLACK_AT = Message("a spring that an event ties needs its natural 'length'")
"""The reasons why an event cannot tie a joint."""


def something_to_hold(level: Level) -> Iterator[Fault]:
    """Joints hold something that moves, and do not connect a part to itself."""
    for name, joint in level.joints.items():
        path = ("joints", name, "ends")
        held = [level.bodies[body] for body in bodies_of(joint) if body in level.bodies]
        moves = any(body.type == "dynamic" for body in held)
        if isinstance(joint, Wire):
            if not moves:
                yield Fault(("joints", name, "bead"), "the bead must be a dynamic body")
        elif same := _twice(joint):
            yield Fault(
                path,
                "'{same}' is connected to itself; two different bodies are needed",
                same=brief(same),
            )
        elif not moves:
            yield Fault(path, "at least one end must be a dynamic body")
    wires, curves = _wires_and_curves(level)
    if "s" in level.parameters and (wires or curves):
        what = Message("wires") if wires else Message("curves")
        rule = Message("'s' is the parameter along the {what}; choose another name", what=what)
        yield Fault(("parameters", "s"), rule)


def own_apart(level: Level) -> Iterator[Fault]:
    """Joints of pymunk's own do not change with time, and share no body with exact ones."""
    exact = {b for joint in level.joints.values() if is_exact(joint) for b in bodies_of(joint)}
    if level.effects.sticking:
        exact.update(body for pair in level.effects.sticking.pairs for body in pair.bodies)
    moving = {name for name, body in level.bodies.items() if body.type == "dynamic"}
    for name, joint in level.joints.items():
        if not isinstance(joint, Own) or joint.exact:
            continue
        path = ("joints", name, "exact")
        if "t" in names_in(joint):
            yield Fault(path, "only an exact joint can change with the time 't'; leave out 'exact'")
        for body in moving.intersection(bodies_of(joint)) & exact:
            rule = Message(
                "'{body}' is also held exactly; what holds a body must be all exact, or all"
                " pymunk's own",
                body=brief(body),
            )
            yield Fault(path, rule)
        if level.effects.in_sequence:
            yield Fault(path, "impacts in 'sequence' need exact joints; leave out 'exact'")


def ties_fit(level: Level) -> Iterator[Fault]:
    """Joints that an event ties take the length they find, and declare none."""
    names = sorted(tied_joints(level.events) & level.joints.keys())
    for name in names:
        for field, rule in _untied(level.joints[name]):
            yield Fault(("joints", name, field), rule)
    contact, exact = level.effects.contact, any(is_exact(level.joints[name]) for name in names)
    if contact and contact.solver == "iterative" and exact:
        rule = Message("a joint that an event ties needs the 'direct' solver; leave this out")
        yield Fault(("effects", "contact", "solver"), rule)


def stops_bounce(level: Level) -> Iterator[Fault]:
    """Contacts are solved directly if stops rebound."""
    contact = level.effects.contact
    if contact and contact.solver == "iterative":
        for name, _ in rebounding_stops(level.joints):
            rule = Message(
                "needs the 'direct' solver of contacts; leave this out, or the 'solver' of"
                " 'contact'"
            )
            yield Fault(("joints", name, "restitution"), rule)


def pass_impacts_on(level: Level) -> Iterator[Fault]:
    """Impacts that are located or in sequence reach exact joints only if contacts are direct."""
    effects, contact, friction = level.effects, level.effects.contact, level.effects.friction
    exact = any(map(is_exact, level.joints.values()))
    if contact is None or is_direct(level) or not exact:
        return
    if not (contact.located or effects.in_sequence):
        return
    rule = Message(
        "where joints are exact, impacts that are 'located' or in 'sequence' need contacts that are"
        " solved directly; leave this out"
    )
    if contact.solver == "iterative":
        yield Fault(("effects", "contact", "solver"), rule)
    if friction and friction.located:
        yield Fault(("effects", "friction", "located"), rule)
    for name, joint in level.joints.items():
        if is_solved_by_pymunk(joint):
            yield Fault(("joints", name, "exact"), rule)


def _untied(joint: Joint) -> Iterator[tuple[str, Message]]:
    """Yield the fields of a joint that prevent an event from tying it, with the reasons."""
    if isinstance(joint, Wire):
        yield "type", NO_WIRE
    if isinstance(joint, Rod) and joint.length is not None:
        yield "length", AS_FOUND
    if isinstance(joint, Spring) and joint.length is None:
        yield "length", SLACK_AT
    if getattr(joint, "exact", True) is False:
        yield "exact", Message("a joint that an event ties must be exact; leave out 'exact'")
    if getattr(joint, "restitution", None) is not None:
        rule = Message("a joint that an event ties cannot bounce; leave out 'restitution'")
        yield "restitution", rule


def not_too_many_wires(level: Level) -> Iterator[Fault]:
    """Refuse more wires and curves than can be checked for corners and crossings."""
    wires, curves = _wires_and_curves(level)
    if wires + curves > MAX_WIRES:
        have = Message("{count:,} wires and curves", count=wires + curves)
        rule = Message(
            "have {have}; at most {most} can be checked for crossings",
            have=have if curves else Message("{count:,} wires", count=wires),
            most=MAX_WIRES,
        )
        yield Fault(("joints" if wires else "bodies",), rule)


def _wires_and_curves(level: Level) -> tuple[int, int]:
    """Return the numbers of wires and curves."""
    wires = sum(isinstance(joint, Wire) for joint in level.joints.values())
    return wires, sum(isinstance(body.shape, Curve) for body in level.bodies.values())


def _twice(joint: Joint) -> str | None:
    """Return the body that a joint connects to itself, if it does.

    A string may run over several pegs of the same body.
    """
    path = [body_of(end) for end in points(joint)]
    pairs = [path[:2], path[-2:], (path[0], path[-1])]
    return next((a for a, b in pairs if a is not None and a == b), None)


def constant_masses(level: Level) -> Iterator[Fault]:
    """Exact joints do not hold bodies of changing mass: they are solved with the initial masses."""
    changing = {name for _, name in bodies_of_flows(level)}
    for name, joint in level.joints.items():
        for body in changing.intersection(bodies_of(joint)):
            if not joint.kind.force:
                rule = Message(
                    "the mass of '{body}' changes, so only a spring can hold it", body=brief(body)
                )
                yield Fault(("joints", name, "ends"), rule)
