"""Everything about touching bodies is declared, used, and consistent."""

from collections.abc import Iterator, Sequence

from sandbox.model.body import Body
from sandbox.model.contact_solver_choice import lone_strings
from sandbox.model.effects.contact import Pair
from sandbox.model.errors import brief
from sandbox.model.excluded_pairs import excluded_pairs
from sandbox.model.joints import bodies_of, is_exact, is_solved_by_pymunk
from sandbox.model.json_positions import Path
from sandbox.model.level import ContactEvent, Level, SeparationEvent
from sandbox.model.level_parts import Fault
from sandbox.model.number_bounds import MOST_PAIRS
from sandbox.model.rules.consistency.bodies import is_set
from sandbox.model.rules.consistency.references_by_name import (
    bodies_of_flows,
    coefficients,
    mentions,
    named_quantities,
)
from sandbox.model.shapes import Arc, Curve, Disc, Hoop
from sandbox.model.translatable_message import Message, both


def contact_declared(level: Level) -> Iterator[Fault]:
    """Whatever depends on contact needs bodies that can touch."""
    contact = level.effects.contact
    if contact:
        if contact.piles and contact.slop is not None:
            rule = Message("'piles' already chooses the 'slop'; leave out one")
            yield Fault(("effects", "contact", "slop"), rule)
        if contact.solver == "direct":
            yield from _left_to_pymunk(level)
        return
    for path, name in named_quantities(level):
        if ".contact." in name:
            yield undeclared(path, name, "contact")
    for index, check in enumerate(level.checks):
        if isinstance(check.at, ContactEvent | SeparationEvent):
            yield undeclared(("checks", index, "at", "event"), check.at.event, "contact")


def _left_to_pymunk(level: Level) -> Iterator[Fault]:
    """Refuse what needs pymunk's solver where contacts are solved directly."""
    for name, joint in level.joints.items():
        if is_solved_by_pymunk(joint):
            rule = Message(
                "pymunk's own joints cannot be combined with the 'direct' solver of contacts"
            )
            yield Fault(("joints", name, "exact"), rule)
    friction = level.effects.friction
    if friction and friction.located:
        rule = Message("only the 'iterative' solver of contacts can locate the end of slipping")
        yield Fault(("effects", "friction", "located"), rule)


def coefficients_fit(level: Level, kind: str) -> Iterator[Fault]:
    """Friction and restitution: declared if used, used if declared, and only with contact."""
    effect = coefficients(level).get(kind)
    given = [name for name, body in level.bodies.items() if getattr(body, kind) is not None]
    if kind == "friction":
        yield from _static_alone(level)
    if effect is None:
        yield from (undeclared(("bodies", name, kind), kind, kind) for name in given)
        return
    if level.effects.contact is None:
        yield Fault(("effects", kind), "'{kind}' needs the effect 'contact'", kind=kind)
    if kind == "friction" and level.effects.in_sequence:
        rule = Message(
            "impacts in 'sequence' are frictionless; leave out 'friction', or choose 'together'"
        )
        yield Fault(("effects", "restitution", "impacts"), rule)
    paired = {name for pair in effect.pairs for name in pair.bodies}
    if not given and not paired:
        yield Fault(
            ("effects", kind), "'{kind}' is declared but no body has a coefficient", kind=kind
        )
        return
    known = paired.union(given)
    for name, body in level.bodies.items():
        if name not in known and not body.sensor:
            yield Fault(
                ("bodies", name),
                "needs a '{kind}' coefficient, since the level declares '{kind}' (1 keeps"
                " the other body's, 0 is none)",
                kind=kind,
            )
    yield from _repeated_pairs(effect.pairs, kind, Message("already has a coefficient"))


def _static_alone(level: Level) -> Iterator[Fault]:
    for name, body in level.bodies.items():
        if body.static_friction is not None and body.friction is None:
            rule = Message("needs 'friction', too: the coefficient while the body slips")
            yield Fault(("bodies", name, "static_friction"), rule)


def sensors_untouched(level: Level) -> Iterator[Fault]:
    """No event or setting needs contact with a sensor."""
    sensors = {name for name, body in level.bodies.items() if body.sensor}
    if not sensors:
        return
    for path, names, mention in mentions(level):
        touches = mention.of == "couple" or path[:2] == ("effects", "contact")
        for name in sorted(sensors.intersection(names)) if touches else ():
            rule = Message(
                "'{name}' is a sensor, which nothing touches; use a quantity with '.within.'",
                name=brief(name),
            )
            yield Fault(path, rule)


def apart_fits(level: Level) -> Iterator[Fault]:
    """Pairs that never meet neither rub, bounce nor stick, and are not too many."""
    contact = level.effects.contact
    if contact is None:
        return
    if sum(len(group) ** 2 // 2 for group in contact.apart) > MOST_PAIRS:
        rule = Message(
            "separates more than {most:,} pairs of bodies, the most allowed", most=MOST_PAIRS
        )
        yield Fault(("effects", "contact", "apart"), rule)
        return
    never = excluded_pairs(level)
    for kind in ("friction", "restitution", "sticking"):
        effect = getattr(level.effects, kind)
        for index, pair in enumerate(effect.pairs if effect else ()):
            one, other = sorted(pair.bodies)
            if (one, other) in never:
                rule = Message(
                    "'{one}' and '{other}' never touch, because of 'contact'",
                    one=brief(one),
                    other=brief(other),
                )
                yield Fault(("effects", kind, "pairs", index), rule)


def sticking_fits(level: Level) -> Iterator[Fault]:
    """Bodies that stick can touch, and at least one of them can move."""
    sticking = level.effects.sticking
    if sticking is None:
        return
    if level.effects.contact is None:
        yield Fault(("effects", "sticking"), "'sticking' needs the effect 'contact'")
    if level.effects.in_sequence:
        rule = Message("'sticking' cannot be combined with impacts in 'sequence'")
        yield Fault(("effects", "sticking"), rule)
    located = (level.effects.contact and level.effects.contact.located) or ()
    for name in {name for pair in sticking.pairs for name in pair.bodies}.intersection(located):
        rule = Message(
            "'{name}' sticks when it first touches; such an impact cannot be located in time",
            name=brief(name),
        )
        yield Fault(("effects", "contact", "located", located.index(name)), rule)
    for index, pair in enumerate(sticking.pairs):
        held = [level.bodies[body] for body in pair.bodies if body in level.bodies]
        if len(held) == 2 and not any(body.type == "dynamic" for body in held):
            path = ("effects", "sticking", "pairs", index)
            yield Fault(path, "at least one of the two must be a dynamic body")
    yield from _repeated_pairs(sticking.pairs, "sticking", Message("is already named"))


def located_slips_fit(level: Level) -> Iterator[Fault]:
    """Bodies with located slipping have no joints that are settled late together with contacts."""
    friction = level.effects.friction
    flows = {body for _, body in bodies_of_flows(level)}
    located = (friction and friction.located) or ()
    lone = lone_strings(level) if located else set[str]()
    for index, body in enumerate(located):
        path = ("effects", "friction", "located", index)
        if body in flows:
            rule = Message(
                "the mass of '{body}' changes, so the end of its slipping cannot be located",
                body=brief(body),
            )
            yield Fault(path, rule)
        for name, joint in level.joints.items():
            if body in bodies_of(joint) and is_exact(joint) and name not in lone:
                rule = Message(
                    "'{body}' is held by '{name}'; the end of slipping can be located only for"
                    " bodies that are free, on springs, or on one string over pegs",
                    body=brief(body),
                    name=brief(name),
                )
                yield Fault(path, rule)


def impacts_of_constant_masses(level: Level) -> Iterator[Fault]:
    """Masses are constant where pymunk does not solve the impacts: the initial ones are used."""
    changing = sorted({name for _, name in bodies_of_flows(level)})
    if not changing:
        return
    contact, effect = level.effects.contact, brief(changing[0])
    if level.effects.in_sequence:
        rule = Message(
            "the mass of '{effect}' changes; impacts in 'sequence' need constant masses",
            effect=effect,
        )
        yield Fault(("effects", "restitution", "impacts"), rule)
    if contact and contact.located:
        rule = Message(
            "the mass of '{effect}' changes; located impacts need constant masses", effect=effect
        )
        yield Fault(("effects", "contact", "located"), rule)


def arcs_fit(level: Level) -> Iterator[Fault]:
    """Refuse located impacts on arcs and curves, which are found a step later, and sticking."""
    contact, sticking = level.effects.contact, level.effects.sticking
    arcs = {
        name: Message("an arc") if isinstance(body.shape, Arc) else Message("a curve")
        for name, body in level.bodies.items()
        if isinstance(body.shape, Arc | Curve)
    }
    if arcs and contact and contact.located:
        name, kind = next(iter(arcs.items()))
        rule = Message(
            "'{name}' is {kind}; a level with one cannot have located impacts",
            name=brief(name),
            kind=kind,
        )
        yield Fault(("effects", "contact", "located"), rule)
    for index, pair in enumerate(sticking.pairs if sticking else ()):
        for name in set(pair.bodies).intersection(arcs):
            rule = Message(
                "'{name}' is {kind}; nothing can stick to one", name=brief(name), kind=arcs[name]
            )
            yield Fault(("effects", "sticking", "pairs", index), rule)


def curves_fit(level: Level) -> Iterator[Fault]:
    """Only static and kinematic bodies are curves, and no moving arc touches one."""
    curves = [name for name, body in level.bodies.items() if isinstance(body.shape, Curve)]
    for name in curves:
        if level.bodies[name].type == "dynamic":
            rule = Message(
                "'{name}' is a curve; its 'type' must be 'static' or 'kinematic'", name=brief(name)
            )
            yield Fault(("bodies", name, "type"), rule)
    for name, body in level.bodies.items() if curves and level.effects.contact else ():
        if isinstance(body.shape, Arc) and body.type == "dynamic":
            rule = Message(
                "'{name}' is a dynamic arc and cannot touch the curve '{curve}'; use a hoop, or"
                " arcs instead of the curve",
                name=brief(name),
                curve=brief(curves[0]),
            )
            yield Fault(("bodies", name, "shape"), rule)


def sticking_or_bouncing(level: Level) -> Iterator[Fault]:
    """Pairs that stick have no coefficient of restitution."""
    effects = level.effects
    if effects.sticking is None or effects.restitution is None:
        return
    stuck = [set(pair.bodies) for pair in effects.sticking.pairs]
    for index, pair in enumerate(effects.restitution.pairs):
        if set(pair.bodies) in stuck:
            rule = Message(
                "these bodies stick together when they touch, so they do not bounce; leave out one"
            )
            yield Fault(("effects", "restitution", "pairs", index), rule)


def belts_fit(level: Level) -> Iterator[Fault]:
    """Belts act by friction, and have straight sides that do not turn."""
    seen: set[str] = set()
    for index, belt in enumerate(level.effects.belt or ()):
        path = ("effects", "belt", index, "body")
        for needed in ("contact", "friction"):
            if getattr(level.effects, needed) is None:
                yield Fault(path[:-1], "'belt' needs the effect '{needed}'", needed=needed)
        if belt.body in seen:
            yield Fault(path, "'{body}' is a belt already", body=brief(belt.body))
        seen.add(belt.body)
        if body := level.bodies.get(belt.body):
            yield from (Fault(path, rule) for rule in _no_belt(belt.body, body))


def _no_belt(name: str, body: Body) -> Iterator[Message]:
    """Yield why a body cannot be a belt."""
    if body.type == "dynamic":
        yield Message("'{name}' is dynamic, but a belt is static or kinematic", name=brief(name))
    if isinstance(body.shape, Disc | Hoop | Arc | Curve):
        yield Message(
            "'{name}' is round, but a belt has straight sides; use a rotating kinematic body",
            name=brief(name),
        )
    if body.type == "kinematic" and is_set(body, "angular_velocity"):
        yield Message("'{name}' turns, but a belt keeps its direction", name=brief(name))


def undeclared(path: Path, used: str, effect: str) -> Fault:
    """Return the fault of a field whose effect is not declared."""
    return Fault(
        path, "'{used}' is used but the effect '{effect}' is not declared", used=used, effect=effect
    )


def _repeated_pairs(pairs: Sequence[Pair], kind: str, message: Message) -> Iterator[Fault]:
    seen: set[frozenset[str]] = set()
    for index, pair in enumerate(pairs):
        bodies = frozenset(pair.bodies)
        if bodies in seen:
            path = ("effects", kind, "pairs", index)
            yield Fault(
                path,
                "the pair {bodies} {message}",
                bodies=both(map(brief, pair.bodies)),
                message=message,
            )
        seen.add(bodies)
