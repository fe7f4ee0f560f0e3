"""Declared effects have something to act on."""

from collections.abc import Iterator

from sandbox.model.effects import EFFECTS
from sandbox.model.errors import brief
from sandbox.model.joints import Held, points
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.rules.consistency.bodies import is_set
from sandbox.model.rules.consistency.contacts import coefficients_fit, undeclared
from sandbox.model.rules.consistency.references_by_name import (
    acted_on,
    bodies_of_effect,
    lists_of_bodies,
)
from sandbox.model.shapes import Area
from sandbox.model.translatable_message import Message, either, word


def laws_act(level: Level) -> Iterator[Fault]:
    """Effects do something, and the bodies that forces act on can move."""
    for effect, effect_path, settings in level.effects.settings:
        if effect.needs and all(getattr(settings, field).source == 0 for field in effect.needs):
            rule = Message("needs {needs} greater than 0", needs=either(map(repr, effect.needs)))
            yield Fault(effect_path, rule)
    for path, name in acted_on(level):
        if (kind := level.bodies[name].type) != "dynamic":
            yield Fault(
                path, "'{name}' is {kind}, so no force moves it", name=brief(name), kind=word(kind)
            )
    for path, bodies in lists_of_bodies(level):
        if len(set(bodies)) < len(bodies):
            yield Fault(path, "a body is named twice")


def partners_exist(level: Level) -> Iterator[Fault]:
    """Effects that act between bodies have at least two of them."""
    for effect, path, settings in level.effects.settings:
        if effect.is_internal and len(only := bodies_of_effect(level, settings)) == 1:
            rule = Message(
                "'{effect}' acts between bodies, but '{name}' is the only one; for a fixed centre,"
                " use 'attraction'",
                effect=effect.name,
                name=brief(only[0]),
            )
            yield Fault(path, rule)


def effects_used(level: Level) -> Iterator[Fault]:
    """Effects that are declared have bodies to act on."""
    dynamic = any(body.type == "dynamic" for body in level.bodies.values())
    for name in () if dynamic else level.effects.declared:
        yield Fault(("effects", name), "'{name}' is declared but no body is dynamic", name=name)
    touching = sum(not body.sensor for body in level.bodies.values())
    if level.effects.contact and dynamic and touching < 2:
        rule = Message("'contact' is declared but there is only one body that can touch another")
        yield Fault(("effects", "contact"), rule)
    for kind, effect in EFFECTS.items():
        if effect.coefficient:
            yield from coefficients_fit(level, kind)


def turned_apart(level: Level) -> Iterator[Fault]:
    """Torques act on bodies that can turn, and between two different ones."""
    for effect, path, settings in level.effects.settings:
        if effect.name not in ("torque", "torsion"):
            continue
        if settings.against == settings.body:
            rule = Message("'{body}' cannot be turned against itself", body=brief(settings.body))
            yield Fault((*path, "against"), rule)
        if level.effects.rotation is None:
            yield undeclared(path, effect.name, "rotation")


def rotation_used(level: Level) -> Iterator[Fault]:
    """Rotation is declared if a body has a moment or a spin, and only if something turns one."""
    dynamic = {name: body for name, body in level.bodies.items() if body.type == "dynamic"}
    turning = any(is_set(body, "angular_velocity") for body in dynamic.values())
    if level.effects.rotation:
        if not (turning or level.effects.contact or _levers(level)):
            rule = Message(
                "'rotation' is declared but nothing turns a body: no contact, angular velocity or"
                " torque, and joints and forces act on centres"
            )
            yield Fault(("effects", "rotation"), rule)
        return
    for name, body in dynamic.items():
        for field in ("moment", "angular_velocity"):
            if is_set(body, field):
                yield undeclared(("bodies", name, field), field, "rotation")


def _levers(level: Level) -> bool:
    """Whether an effect or a joint turns a body, or acts on it away from its centre."""
    if any(effect.exerts_torque for effect in level.effects.declarations):
        return True
    if any(joint.kind.exerts_torque for joint in level.joints.values()):
        return True
    held = (end for joint in level.joints.values() for end in points(joint))
    points_of_bodies = [end.at for end in held if isinstance(end, Held)]
    points_of_bodies += [force.at for force in level.effects.force or ()]
    return any(point != Held.model_fields["at"].default for point in points_of_bodies)


def liquid_fits(level: Level) -> Iterator[Fault]:
    """Bodies in a liquid have an area that displaces it."""
    buoyancy = level.effects.buoyancy
    if buoyancy is None:
        return
    for index, name in enumerate(buoyancy.bodies or ()):
        if not isinstance(shape := level.bodies[name].shape, Area):
            rule = Message(
                "'{name}' is a {type}, which displaces no liquid",
                name=brief(name),
                type=word(shape.type),
            )
            yield Fault(("effects", "buoyancy", "bodies", index), rule)
    dynamic = (body.shape for body in level.bodies.values() if body.type == "dynamic")
    if not any(isinstance(shape, Area) for shape in dynamic):
        rule = Message("nothing displaces the liquid: no dynamic disc, box or polygon")
        yield Fault(("effects", "buoyancy"), rule)


def landscape_fits(level: Level) -> Iterator[Fault]:
    """Landscapes show bodies that have energy, and no parameter is named as their variable."""
    landscape = level.view.landscape
    if landscape is None:
        return
    body = level.bodies.get(landscape.body)
    if body and body.type != "dynamic":
        rule = Message(
            "'{body}' is {type}, so it has no energy to draw",
            body=brief(landscape.body),
            type=word(body.type),
        )
        yield Fault(("view", "landscape", "body"), rule)
    if (variable := landscape.potential.variable) in level.parameters:
        rule = Message(
            "'{place}' is the position in the landscape's potential; choose another name",
            place=variable,
        )
        yield Fault(("parameters", variable), rule)
