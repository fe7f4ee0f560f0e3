"""Rules on how the parts of a level fit together, for any values of its parameters.

Each rule yields the faults that it finds; there is a module for each topic.
"""

from collections.abc import Callable, Iterator
from itertools import chain

from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.rules.consistency import (
    bodies,
    challenge,
    contacts,
    effects,
    events,
    joints,
    names,
    stepping,
)

Rule = Callable[[Level], Iterator[Fault]]

_NAMES: tuple[Rule, ...] = (
    names.known_names,
    names.no_circle,
    names.known_bodies,
    names.known_quantities,
    events.known_parts,
)
"""The rules that every name refers to something."""

_ALONE: tuple[Rule, ...] = (
    names.parameters_fit,
    names.constants_fit,
    names.variables_apart,
    names.timeless_conditions,
    challenge.known_parameters,
    challenge.solution_within_ranges,
    challenge.goals_are_bounded,
    contacts.contact_declared,
    bodies.fields_fit,
    bodies.motions_fit,
    bodies.rise_and_fall,
    effects.rotation_used,
    stepping.accuracy_alone,
    stepping.accuracy_within_reach,
)
"""The rules that can be checked even if a joint or an effect names a body that does not exist."""

_TOGETHER: tuple[Rule, ...] = (
    challenge.goals_can_be_met,
    bodies.points_fit,
    bodies.sensors_fit,
    bodies.one_way_fits,
    bodies.in_one_group,
    joints.something_to_hold,
    joints.own_apart,
    joints.ties_fit,
    joints.stops_bounce,
    joints.pass_impacts_on,
    contacts.sensors_untouched,
    contacts.apart_fits,
    contacts.sticking_fits,
    contacts.located_slips_fit,
    contacts.impacts_of_constant_masses,
    contacts.sticking_or_bouncing,
    contacts.arcs_fit,
    contacts.curves_fit,
    effects.laws_act,
    effects.partners_exist,
    effects.liquid_fits,
    effects.landscape_fits,
    joints.constant_masses,
    contacts.belts_fit,
    effects.effects_used,
    effects.turned_apart,
    events.names_apart,
    events.events_act,
    events.drifts_cut_once,
    stepping.scheme_fits,
)
"""The rules that look up the bodies that joints and effects name: after a wrong name they would
fail, or report only its consequences."""


_SIZES: tuple[Rule, ...] = (
    bodies.not_too_many,
    bodies.not_too_many_edges,
    joints.not_too_many_wires,
    stepping.not_too_many_pulls,
    stepping.not_too_many_sticking,
    stepping.not_too_many_hollow,
)
"""The rules that are checked before anything whose work grows with the level."""


def too_much(level: Level) -> Iterator[Fault]:
    """Yield whatever a level has too much of to be checked further."""
    return _broken(_SIZES, level)


def inconsistencies(level: Level) -> Iterator[Fault]:
    """Yield every contradiction between parts of a level."""
    misnamed = next(names.known_bodies(level), None)
    return _broken((*_NAMES, *_ALONE, *(() if misnamed else _TOGETHER)), level)


def contradictions(level: Level) -> Iterator[Fault]:
    """Yield every contradiction in a level in which all names refer to something."""
    return _broken((*_ALONE, *_TOGETHER), level)


def dangling(level: Level) -> Iterator[Fault]:
    """Yield the names of parameters, bodies and quantities that do not exist."""
    return _broken(_NAMES, level)


def _broken(rules: tuple[Rule, ...], level: Level) -> Iterator[Fault]:
    return chain.from_iterable(rule(level) for rule in rules)
