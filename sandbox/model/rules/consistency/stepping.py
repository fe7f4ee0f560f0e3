"""The stepping fits the simulated scene, and no step is too expensive."""

from collections.abc import Iterator

from sandbox.model.level import FINEST, Level
from sandbox.model.level_parts import Fault
from sandbox.model.rules.consistency.references_by_name import bodies_of_effect
from sandbox.model.scheme_requirements import unsmooth
from sandbox.model.shapes import Arc, Curve, Hoop
from sandbox.model.translatable_message import Message


def scheme_fits(level: Level) -> Iterator[Fault]:
    """Refuse a scheme of higher order than leapfrog where forces are not smooth."""
    if level.stepping.is_composed and (rule := unsmooth(level)):
        yield Fault(("stepping", "scheme"), rule)


def accuracy_alone(level: Level) -> Iterator[Fault]:
    """Refuse settings that are given in addition to an accuracy."""
    if level.stepping.accuracy is not None:
        for name in sorted(level.stepping.model_fields_set - {"accuracy"}):
            yield Fault(("stepping", name), "cannot be combined with 'accuracy'; leave out one")


def accuracy_within_reach(level: Level) -> Iterator[Fault]:
    """Refuse an accuracy that no run can reach."""
    asked = level.stepping.accuracy
    if asked is not None and asked < FINEST:
        rule = Message(
            "an accuracy of {asked:g} is below rounding; it must be at least {finest:g}",
            asked=asked,
            finest=FINEST,
        )
        yield Fault(("stepping", "accuracy"), rule)


MOST_PULLS = 4_000_000
"""The most forces per step, between bodies and from centres: a quarter of a second."""

MOST_STICKING = 20_000
"""The most pairs with static above kinetic friction: pymunk takes 50 µs to look up each."""

MOST_HOLLOW = 100_000
"""The most pairs of a hollow body and one that may be inside: a second to make."""


def not_too_many_pulls(level: Level) -> Iterator[Fault]:
    """Those between bodies and those to centres can be computed in a step."""
    for effect, path, settings in level.effects.settings:
        count = len(bodies_of_effect(level, settings)) if effect.is_internal else 0
        if count**2 > MOST_PULLS:
            message = Message(
                "'{effect}' acts between every two of {count:,} bodies; a step can take at most"
                " {most:,}",
                effect=effect.name,
                count=count,
                most=int(MOST_PULLS**0.5),
            )
            yield Fault(path, message)
    dynamic = sum(body.type == "dynamic" for body in level.bodies.values())
    centres = len(level.effects.attraction or ())
    if centres * dynamic > MOST_PULLS:
        message = Message(
            "{centres:,} centres attract {dynamic:,} bodies: {pulls:,} forces, but a step can"
            " take at most {most:,}",
            centres=centres,
            dynamic=dynamic,
            pulls=centres * dynamic,
            most=MOST_PULLS,
        )
        yield Fault(("effects", "attraction"), message)


def not_too_many_sticking(level: Level) -> Iterator[Fault]:
    """Pairs with static above kinetic friction are not too many to be watched."""
    if level.effects.friction is None:
        return
    rub = [body for body in level.bodies.values() if body.friction is not None]
    stick = sum(body.static_friction is not None for body in rub)
    pairs = stick * (stick - 1) // 2 + stick * (len(rub) - stick)
    if pairs > MOST_STICKING:
        message = Message(
            "{stick:,} bodies have a 'static_friction', which makes {pairs:,} pairs of bodies;"
            " at most {most:,} are allowed, so leave it out where it is not needed",
            stick=stick,
            pairs=pairs,
            most=MOST_STICKING,
        )
        yield Fault(("bodies",), message)


def not_too_many_hollow(level: Level) -> Iterator[Fault]:
    """Arcs, hoops and curves are not too many for what may touch them from inside."""
    if level.effects.contact is None:
        return
    solid = [body for body in level.bodies.values() if not body.sensor]
    hollow = [body.type for body in solid if isinstance(body.shape, Arc | Hoop | Curve)]
    moving, dynamic = hollow.count("dynamic"), sum(body.type == "dynamic" for body in solid)
    pairs = moving * (len(solid) - 1) + (len(hollow) - moving) * dynamic
    if pairs > MOST_HOLLOW:
        message = Message(
            "{hollow:,} arcs, hoops and curves make {pairs:,} pairs with bodies that may touch them"
            " from inside; at most {most:,} are allowed",
            hollow=len(hollow),
            pairs=pairs,
            most=MOST_HOLLOW,
        )
        yield Fault(("bodies",), message)
