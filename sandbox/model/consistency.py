"""What must hold between the parts of a level whatever the values of its parameters."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from keyword import iskeyword

from sandbox.model.effects import Friction, Pair, Restitution
from sandbox.model.errors import brief
from sandbox.model.expressions import RESERVED, Formula, NonNegative
from sandbox.model.joints import (
    End,
    Held,
    Joint,
    Motor,
    Own,
    Rod,
    Spring,
    Weld,
    Winding,
    Wire,
    bodies_of,
    body_of,
    ends_of,
    is_exact,
    points,
)
from sandbox.model.level import (
    ApexEvent,
    Body,
    ContactEvent,
    CrossingEvent,
    LandingEvent,
    Level,
)
from sandbox.model.locating import Path
from sandbox.model.parts import Fault, expressions
from sandbox.model.quantities import QuantityError, quantity
from sandbox.model.schemes import unsmooth
from sandbox.model.shapes import Disc, Hoop, Polygon, Polyline, Shape
from sandbox.model.suggest import suggestion

MAX_SURFACES = 30_000
"""How many surfaces may touch: of 40,000 in a heap pymunk takes more than 100 s to let go."""

_FORBIDDEN: Mapping[str, tuple[str, ...]] = {
    "dynamic": (),
    "kinematic": ("mass", "moment"),
    "static": ("mass", "moment", "velocity", "angular_velocity"),
}
"""The fields that a type of body cannot have."""


def inconsistencies(level: Level) -> Iterator[Fault]:
    """Yield whatever in a level contradicts something else in it."""
    for rule in _RULES:
        yield from rule(level)


def dangling(level: Level) -> Iterator[Fault]:
    """Yield the names that lead to nothing: parameters, bodies and quantities that do not exist."""
    for rule in (_names, _references, _quantities):
        yield from rule(level)


def _parameters(level: Level) -> Iterator[Fault]:
    scene, formulas = _used(level, scene=True), _used(level, scene=False)
    for name, parameter in level.parameters.items():
        path = ("parameters", name)
        if name in RESERVED or iskeyword(name):
            yield Fault(path, f"'{name}' already has a meaning in formulas; choose another name")
        if parameter.min > parameter.max:
            yield Fault((*path, "min"), f"must not be greater than 'max', {parameter.max:g}")
        elif not parameter.min <= parameter.value <= parameter.max:
            bounds = f"between 'min', {parameter.min:g}, and 'max', {parameter.max:g}"
            yield Fault((*path, "value"), f"must lie {bounds}")
        if name not in scene | formulas:
            yield Fault(path, f"'{name}' is declared but nothing uses it")
        elif name not in scene:
            only = f"only checks, ghosts or the landscape use '{name}'"
            rule = f"{only}, so it changes nothing in the scene"
            yield Fault(path, rule)


def _used(level: Level, *, scene: bool) -> set[str]:
    """Return the names that the scene uses, or that only tell what it should do."""
    told = ("checks", "ghosts", "view")
    used = (
        e.names
        for path, e in expressions(level)
        if (isinstance(e, Formula) and path[0] in told) is not scene
    )
    return set().union(*used)


def _names(level: Level) -> Iterator[Fault]:
    for path, expression in expressions(level):
        known = [*level.parameters, *filter(None, [expression.variable])]
        for name in sorted(expression.names.difference(known)):
            if name == "t":
                yield Fault(path, "the time 't' has no meaning here")
            else:
                yield Fault(path, f"unknown parameter '{name}'{suggestion(name, known)}")
    for kind, names in (("bodies", level.bodies), ("joints", level.joints)):
        for name in names:
            if name in ("system", "t"):
                yield Fault((kind, name), f"the name '{name}' is taken")
            elif kind == "joints" and name in level.bodies:
                yield Fault((kind, name), f"'{name}' is already the name of a body")


def _references(level: Level) -> Iterator[Fault]:
    for path, name in _body_names(level):
        if name not in level.bodies:
            yield Fault(path, f"unknown body '{brief(name)}'{suggestion(name, level.bodies)}")
    for path, names in _couples(level):
        if names[0] == names[1]:
            yield Fault(
                path, f"'{brief(names[0])}' is named twice; two different bodies are needed"
            )


def _body_names(level: Level) -> Iterator[tuple[Path, str]]:
    yield from _names_in_joints(level)
    yield from _names_in_effects(level)
    for index, belt in enumerate(level.effects.belt or ()):
        yield ("effects", "belt", index, "body"), belt.body
    for path, names in _couples(level):
        yield (*path, 0), names[0]
        yield (*path, 1), names[1]
    for name in level.ghosts:
        yield ("ghosts", name), name
    if level.view.landscape:
        yield ("view", "landscape", "body"), level.view.landscape.body
    for index, check in enumerate(level.checks):
        if isinstance(check.at, ApexEvent | LandingEvent):
            yield ("checks", index, "at", "body"), check.at.body


def _names_in_joints(level: Level) -> Iterator[tuple[Path, str]]:
    for name, joint in level.joints.items():
        for path, end in ends_of(joint):
            yield from _end_names(("joints", name, *path), end)


def _names_in_effects(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies that an effect acts on."""
    for path, bodies in _lists(level):
        for index, body in enumerate(bodies):
            yield (*path, index), body
    for index, force in enumerate(level.effects.force or ()):
        yield ("effects", "force", index, "body"), force.body
    yield from _names_of_flows(level)


def _names_of_flows(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies whose mass changes."""
    for kind in ("thrust", "accretion"):
        for index, flow in enumerate(getattr(level.effects, kind) or ()):
            yield ("effects", kind, index, "body"), flow.body


def _lists(level: Level) -> Iterator[tuple[Path, tuple[str, ...]]]:
    """Yield the effects that may name the bodies they act on, with those they name."""
    contact = level.effects.contact
    yield ("effects", "contact", "located"), (contact and contact.located) or ()
    drag, gravitation = level.effects.drag, level.effects.gravitation
    yield ("effects", "drag", "bodies"), (drag and drag.bodies) or ()
    yield ("effects", "gravitation", "bodies"), (gravitation and gravitation.bodies) or ()


def _end_names(path: Path, end: End) -> Iterator[tuple[Path, str]]:
    body = body_of(end)
    if body is not None:
        yield (*path, "body") if isinstance(end, Held) else path, body


def _couples(level: Level) -> Iterator[tuple[Path, tuple[str, str]]]:
    """Yield everything that two bodies are named for."""
    for kind, pairs in _pairs(level).items():
        for index, pair in enumerate(pairs):
            yield ("effects", kind, "pairs", index, "bodies"), pair.bodies
    for index, check in enumerate(level.checks):
        if isinstance(check.at, ContactEvent):
            yield ("checks", index, "at", "bodies"), check.at.bodies


def _quantities(level: Level) -> Iterator[Fault]:
    for path, name in _quantity_names(level):
        try:
            quantity(name, level)
        except QuantityError as error:
            yield Fault(path, str(error))


def _quantity_names(level: Level) -> Iterator[tuple[Path, str]]:
    for index, check in enumerate(level.checks):
        yield ("checks", index, "quantity"), check.quantity
        if isinstance(check.at, CrossingEvent):
            yield ("checks", index, "at", "quantity"), check.at.quantity


def _contact(level: Level) -> Iterator[Fault]:
    """Whatever waits for bodies to touch needs bodies that can."""
    contact = level.effects.contact
    if contact:
        if contact.piles and contact.slop is not None:
            rule = "'piles' choose the overlap that is left alone; leave out one of the two"
            yield Fault(("effects", "contact", "slop"), rule)
        return
    for path, name in _quantity_names(level):
        if ".contact." in name:
            yield _undeclared(path, name, "contact")
    for index, check in enumerate(level.checks):
        if isinstance(check.at, ContactEvent):
            yield _undeclared(("checks", index, "at", "event"), "contact", "contact")


def _bodies(level: Level) -> Iterator[Fault]:
    for name, body in level.bodies.items():
        path = ("bodies", name)
        if body.type == "dynamic" and body.mass is None:
            yield Fault(path, "a dynamic body needs a mass")
        for field in _FORBIDDEN[body.type]:
            if _given(body, field):
                yield Fault((*path, field), f"a {body.type} body has no {field.replace('_', ' ')}")


def _given(body: Body, field: str) -> bool:
    """Whether a field says anything; its default may be written out."""
    return bool(getattr(body, field) != type(body).model_fields[field].default)


def _joints(level: Level) -> Iterator[Fault]:
    for name, joint in level.joints.items():
        path = ("joints", name, "ends")
        held = [level.bodies[body] for body in bodies_of(joint) if body in level.bodies]
        moves = any(body.type == "dynamic" for body in held)
        if isinstance(joint, Wire):
            if not moves:
                yield Fault(("joints", name, "bead"), "the bead must be a dynamic body")
        elif same := _twice(joint):
            yield Fault(path, f"'{brief(same)}' is tied to itself; two different bodies are needed")
        elif not moves:
            yield Fault(path, "at least one end must be a dynamic body")
    if "s" in level.parameters and any(isinstance(j, Wire) for j in level.joints.values()):
        yield Fault(("parameters", "s"), "'s' runs along the wires; choose another name")


def _own(level: Level) -> Iterator[Fault]:
    """Joints of pymunk's own do not change with time, and share no body with exact ones."""
    exact = {b for joint in level.joints.values() if is_exact(joint) for b in bodies_of(joint)}
    if level.effects.sticking:
        exact.update(body for pair in level.effects.sticking.pairs for body in pair.bodies)
    moving = {name for name, body in level.bodies.items() if body.type == "dynamic"}
    for name, joint in level.joints.items():
        if not isinstance(joint, Own) or joint.exact:
            continue
        path = ("joints", name, "exact")
        formula = joint.length if isinstance(joint, Rod) else getattr(joint, "rate", None)
        if formula is not None and "t" in formula.names:
            yield Fault(path, "only an exact joint can change with the time 't'; leave out 'exact'")
        for body in moving.intersection(bodies_of(joint)) & exact:
            rule = f"'{brief(body)}' is held exactly, too; let all that holds it be exact, or none"
            yield Fault(path, rule)
        if level.effects.in_sequence:
            yield Fault(path, "impacts in 'sequence' need exact joints; leave out 'exact'")


def _twice(joint: Joint) -> str | None:
    """Return the body that a joint ties to itself, if it does."""
    path = [body_of(end) for end in points(joint)]
    pairs = [*pairwise(path), (path[0], path[-1])]
    return next((a for a, b in pairs if a is not None and a == b), None)


def _laws(level: Level) -> Iterator[Fault]:
    """Drags do something, and what a force acts on can move."""
    drag = level.effects.drag
    if drag and drag.linear == drag.quadratic == NonNegative(0):
        yield Fault(("effects", "drag"), "needs 'linear' or 'quadratic' greater than 0")
    for path, name in _names_in_effects(level):
        if name in level.bodies and (kind := level.bodies[name].type) != "dynamic":
            yield Fault(path, f"'{brief(name)}' is {kind}, so no force moves it")
    for path, bodies in _lists(level):
        if len(set(bodies)) < len(bodies):
            yield Fault(path, "a body is named twice")
    dynamic = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    if level.effects.gravitation and len(dynamic) == 1:
        rule = "bodies attract each other, but only one is dynamic; 'attraction' has a fixed centre"
        yield Fault(("effects", "gravitation"), rule)


def _landscape(level: Level) -> Iterator[Fault]:
    """Landscapes belong to bodies that have energy, and their place has a name of its own."""
    landscape = level.view.landscape
    if landscape is None:
        return
    body = level.bodies.get(landscape.body)
    if body and body.type != "dynamic":
        rule = f"'{brief(landscape.body)}' is {body.type}, so it has no energy to draw"
        yield Fault(("view", "landscape", "body"), rule)
    if (place := landscape.potential.variable) in level.parameters:
        rule = f"'{place}' is the place in the landscape's potential; choose another name"
        yield Fault(("parameters", place), rule)


def _flows(level: Level) -> Iterator[Fault]:
    """Exact joints are solved with the masses of the start, so they hold nothing that changes."""
    changing = {name for _, name in _names_of_flows(level)}
    for name, joint in level.joints.items():
        for body in changing.intersection(bodies_of(joint)):
            if not isinstance(joint, Spring):
                rule = f"'{brief(body)}' changes its mass, so only a spring can hold it"
                yield Fault(("joints", name, "ends"), rule)


def _belts(level: Level) -> Iterator[Fault]:
    """Belts carry by friction, and have straight sides that do not turn."""
    seen: set[str] = set()
    for index, belt in enumerate(level.effects.belt or ()):
        path = ("effects", "belt", index, "body")
        for needed in ("contact", "friction"):
            if getattr(level.effects, needed) is None:
                yield Fault(path[:-1], f"'belt' needs the effect '{needed}'")
        if belt.body in seen:
            yield Fault(path, f"'{brief(belt.body)}' is a belt already")
        seen.add(belt.body)
        if body := level.bodies.get(belt.body):
            yield from (Fault(path, rule) for rule in _no_belt(belt.body, body))


def _no_belt(name: str, body: Body) -> Iterator[str]:
    """Yield why a body can be no belt."""
    if body.type == "dynamic":
        yield f"'{brief(name)}' is dynamic, but a belt stands still or moves as told"
    if isinstance(body.shape, Disc | Hoop):
        yield f"'{brief(name)}' is round, but a belt has straight sides; let a kinematic one turn"
    if body.type == "kinematic" and _given(body, "angular_velocity"):
        yield f"'{brief(name)}' turns, but a belt keeps its direction"


def _effects(level: Level) -> Iterator[Fault]:
    dynamic = any(body.type == "dynamic" for body in level.bodies.values())
    for name in () if dynamic else level.effects.declared:
        yield Fault(("effects", name), f"'{name}' is declared but no body is dynamic")
    if level.effects.contact and dynamic and len(level.bodies) < 2:
        yield Fault(("effects", "contact"), "'contact' is declared but there is only one body")
    for kind in ("friction", "restitution"):
        yield from _surface(level, kind)


def _crowd(level: Level) -> Iterator[Fault]:
    """Bodies that touch have no more surfaces than pymunk holds in reasonable time."""
    if level.effects.contact is None:
        return
    count = sum(_pieces(body.shape) for body in level.bodies.values())
    if count > MAX_SURFACES:
        rule = f"have {count:,} surfaces in all; {MAX_SURFACES:,} are the most that may touch"
        yield Fault(("bodies",), rule)


def _pieces(shape: Shape) -> int:
    """Return of how many convex pieces a shape is made at the most."""
    match shape:
        case Polyline(points=corners):
            return len(corners) - 1
        case Polygon(vertices=corners):
            return len(corners) - 2
    return 1


def _rotation(level: Level) -> Iterator[Fault]:
    """Rotation: declared if a dynamic body is to turn, and only if something can turn one."""
    dynamic = {name: body for name, body in level.bodies.items() if body.type == "dynamic"}
    turning = any(_given(body, "angular_velocity") for body in dynamic.values())
    if level.effects.rotation:
        if not (turning or level.effects.contact or _levers(level)):
            rule = "'rotation' is declared but nothing turns a body: no contact, no joint, no spin"
            yield Fault(("effects", "rotation"), rule)
        return
    for name, body in dynamic.items():
        for field in ("moment", "angular_velocity"):
            if _given(body, field):
                yield _undeclared(("bodies", name, field), field, "rotation")


def _levers(level: Level) -> bool:
    """Whether a joint turns a body, or one or a force acts on it away from its centre."""
    if any(isinstance(joint, Motor | Weld | Winding) for joint in level.joints.values()):
        return True
    held = (end for joint in level.joints.values() for end in points(joint))
    points_of_bodies = [end.at for end in held if isinstance(end, Held)]
    points_of_bodies += [force.at for force in level.effects.force or ()]
    return any(point != Held.model_fields["at"].default for point in points_of_bodies)


def _scheme(level: Level) -> Iterator[Fault]:
    """Fourth order: only where all forces are smooth."""
    if level.stepping.scheme == "yoshida" and (rule := unsmooth(level)):
        yield Fault(("stepping", "scheme"), rule)


def _accuracy(level: Level) -> Iterator[Fault]:
    """Refuse a setting that is chosen and asked for by its accuracy as well."""
    if level.stepping.accuracy is not None:
        for name in sorted(level.stepping.model_fields_set - {"accuracy"}):
            rule = "is chosen beside an 'accuracy' that is asked for; leave one of the two out"
            yield Fault(("stepping", name), rule)


def _undeclared(path: Path, used: str, effect: str) -> Fault:
    return Fault(path, f"'{used}' is used but the effect '{effect}' is not declared")


def _surfaces(level: Level) -> dict[str, Friction | Restitution]:
    """Return those effects that have a coefficient a body."""
    declared = {"friction": level.effects.friction, "restitution": level.effects.restitution}
    return {kind: effect for kind, effect in declared.items() if effect is not None}


def _surface(level: Level, kind: str) -> Iterator[Fault]:
    """Friction and restitution: declared if used, used if declared, and only with contact."""
    effect = _surfaces(level).get(kind)
    given = [name for name, body in level.bodies.items() if getattr(body, kind) is not None]
    if kind == "friction":
        yield from _static_alone(level)
    if effect is None:
        yield from (_undeclared(("bodies", name, kind), kind, kind) for name in given)
        return
    if level.effects.contact is None:
        yield Fault(("effects", kind), f"'{kind}' needs the effect 'contact'")
    if kind == "friction" and level.effects.in_sequence:
        rule = "impacts in 'sequence' do not rub; leave out 'friction', or let them be 'together'"
        yield Fault(("effects", "restitution", "impacts"), rule)
    paired = {name for pair in effect.pairs for name in pair.bodies}
    if not given and not paired:
        yield Fault(("effects", kind), f"'{kind}' is declared but no body has a coefficient")
        return
    known = paired.union(given)
    for name in level.bodies:
        if name not in known:
            yield Fault(
                ("bodies", name),
                f"needs a '{kind}' coefficient, for the level declares '{kind}'"
                " (1 leaves the other body's as it is, 0 is none)",
            )
    yield from _repeated_pairs(effect.pairs, kind, "has a coefficient already")


def _static_alone(level: Level) -> Iterator[Fault]:
    for name, body in level.bodies.items():
        if body.static_friction is not None and body.friction is None:
            rule = "needs 'friction' beside it, the coefficient while the body slips"
            yield Fault(("bodies", name, "static_friction"), rule)


def _sticking(level: Level) -> Iterator[Fault]:
    """Sticking: of bodies that touch, one of which can move."""
    sticking = level.effects.sticking
    if sticking is None:
        return
    if level.effects.contact is None:
        yield Fault(("effects", "sticking"), "'sticking' needs the effect 'contact'")
    if level.effects.in_sequence:
        rule = "what sticks cannot be declared with impacts in 'sequence'"
        yield Fault(("effects", "sticking"), rule)
    located = (level.effects.contact and level.effects.contact.located) or ()
    for name in {name for pair in sticking.pairs for name in pair.bodies}.intersection(located):
        rule = (
            f"'{brief(name)}' sticks at its first touch; such an impact cannot be located in time"
        )
        yield Fault(("effects", "contact", "located", located.index(name)), rule)
    for index, pair in enumerate(sticking.pairs):
        held = [level.bodies[body] for body in pair.bodies if body in level.bodies]
        if len(held) == 2 and not any(body.type == "dynamic" for body in held):
            path = ("effects", "sticking", "pairs", index)
            yield Fault(path, "at least one of the two must be a dynamic body")
    yield from _repeated_pairs(sticking.pairs, "sticking", "is named already")


def _pairs(level: Level) -> dict[str, Sequence[Pair]]:
    """Return the pairs of bodies that effects name."""
    pairs: dict[str, Sequence[Pair]] = {k: e.pairs for k, e in _surfaces(level).items()}
    if level.effects.sticking:
        pairs["sticking"] = level.effects.sticking.pairs
    return pairs


def _repeated_pairs(pairs: Sequence[Pair], kind: str, told: str) -> Iterator[Fault]:
    seen: set[frozenset[str]] = set()
    for index, pair in enumerate(pairs):
        bodies = frozenset(pair.bodies)
        if bodies in seen:
            path = ("effects", kind, "pairs", index)
            yield Fault(path, f"the pair {' and '.join(map(brief, pair.bodies))} {told}")
        seen.add(bodies)


_RULES: tuple[Callable[[Level], Iterator[Fault]], ...] = (
    _parameters,
    _names,
    _references,
    _quantities,
    _contact,
    _bodies,
    _joints,
    _own,
    _sticking,
    _laws,
    _landscape,
    _flows,
    _belts,
    _effects,
    _crowd,
    _rotation,
    _scheme,
    _accuracy,
)
