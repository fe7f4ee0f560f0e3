"""What must hold between the parts of a level whatever the values of its parameters.

Each rule yields what contradicts it; a file a topic.
"""

from collections.abc import Callable, Iterator

from sandbox.model.consistency import bodies, effects, joints, names, stepping, surfaces
from sandbox.model.level import Level
from sandbox.model.parts import Fault

_NAMES: tuple[Callable[[Level], Iterator[Fault]], ...] = (
    names.known_names,
    names.known_bodies,
    names.known_quantities,
)

_RULES: tuple[Callable[[Level], Iterator[Fault]], ...] = (
    names.parameters_fit,
    *_NAMES,
    names.timeless_conditions,
    surfaces.contact_declared,
    bodies.fields_fit,
    bodies.rise_and_fall,
    joints.something_to_hold,
    joints.own_apart,
    surfaces.sticking_fits,
    surfaces.located_slips_fit,
    surfaces.impacts_of_constant_masses,
    surfaces.sticking_or_bouncing,
    effects.laws_act,
    effects.landscape_fits,
    joints.constant_masses,
    surfaces.belts_fit,
    effects.effects_used,
    bodies.not_too_many,
    effects.rotation_used,
    stepping.scheme_fits,
    stepping.accuracy_alone,
    stepping.accuracy_within_reach,
)


def inconsistencies(level: Level) -> Iterator[Fault]:
    """Yield whatever in a level contradicts something else in it."""
    for rule in _RULES:
        yield from rule(level)


def dangling(level: Level) -> Iterator[Fault]:
    """Yield the names that lead to nothing: parameters, bodies and quantities that do not exist."""
    for rule in _NAMES:
        yield from rule(level)
