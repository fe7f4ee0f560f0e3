"""What must hold between the parts of a level whatever the values of its parameters.

Each rule yields what contradicts it; a file a topic.
"""

from collections.abc import Callable, Iterator

from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.rules.consistency import (
    bodies,
    challenge,
    effects,
    events,
    joints,
    names,
    sizes,
    stepping,
    surfaces,
)

_NAMES: tuple[Callable[[Level], Iterator[Fault]], ...] = (
    names.known_names,
    names.no_circle,
    names.known_bodies,
    names.known_quantities,
    events.known_parts,
)

_RULES: tuple[Callable[[Level], Iterator[Fault]], ...] = (
    names.parameters_fit,
    *_NAMES,
    names.constants_fit,
    names.variables_apart,
    names.timeless_conditions,
    challenge.known_parameters,
    challenge.solution_within_ranges,
    challenge.goals_are_bounded,
    challenge.goals_can_be_met,
    surfaces.contact_declared,
    bodies.fields_fit,
    bodies.points_fit,
    bodies.sensors_fit,
    bodies.one_way_fits,
    bodies.in_one_group,
    bodies.motions_fit,
    bodies.rise_and_fall,
    joints.something_to_hold,
    joints.own_apart,
    joints.ties_fit,
    joints.stops_bounce,
    surfaces.sensors_untouched,
    surfaces.apart_fits,
    surfaces.sticking_fits,
    surfaces.located_slips_fit,
    surfaces.impacts_of_constant_masses,
    surfaces.sticking_or_bouncing,
    surfaces.arcs_fit,
    surfaces.curves_fit,
    effects.laws_act,
    effects.liquid_fits,
    effects.landscape_fits,
    joints.constant_masses,
    surfaces.belts_fit,
    effects.effects_used,
    effects.turned_apart,
    events.names_apart,
    events.events_act,
    events.drifts_cut_once,
    effects.rotation_used,
    stepping.scheme_fits,
    stepping.accuracy_alone,
    stepping.accuracy_within_reach,
)

_ALONE = frozenset(
    {
        names.parameters_fit,
        names.constants_fit,
        *_NAMES,
        names.variables_apart,
        names.timeless_conditions,
        challenge.known_parameters,
        challenge.solution_within_ranges,
        challenge.goals_are_bounded,
        surfaces.contact_declared,
        bodies.fields_fit,
        bodies.motions_fit,
        bodies.rise_and_fall,
        effects.rotation_used,
        stepping.accuracy_alone,
        stepping.accuracy_within_reach,
    }
)
"""What can be told although a body that is named does not exist. The others ask what the bodies
are that a joint or an effect names, and would fail, or tell what only follows from a wrong name."""


_SIZES: tuple[Callable[[Level], Iterator[Fault]], ...] = (
    bodies.not_too_many,
    bodies.not_too_many_edges,
    joints.not_too_many_wires,
    sizes.not_too_many_pulls,
    sizes.not_too_many_sticking,
)
"""What is asked before anything that takes longer, the more there is."""


def too_much(level: Level) -> Iterator[Fault]:
    """Yield whatever a level has too much of to be checked further."""
    for rule in _SIZES:
        yield from rule(level)


def inconsistencies(level: Level) -> Iterator[Fault]:
    """Yield whatever in a level contradicts something else in it."""
    misnamed = next(names.known_bodies(level), None)
    for rule in _RULES:
        if rule in _ALONE or not misnamed:
            yield from rule(level)


def contradictions(level: Level) -> Iterator[Fault]:
    """Yield the same of a level in which no name leads to nothing."""
    for rule in _RULES:
        if rule not in _NAMES:
            yield from rule(level)


def dangling(level: Level) -> Iterator[Fault]:
    """Yield the names that lead to nothing: parameters, bodies and quantities that do not exist."""
    for rule in _NAMES:
        yield from rule(level)
