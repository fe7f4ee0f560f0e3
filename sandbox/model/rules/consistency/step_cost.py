"""A step is not too expensive, whatever else the level declares."""

from collections.abc import Iterator

from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.message import Message
from sandbox.model.rules.consistency.mentions import bodies_of_effect

MOST_PULLS = 4_000_000
"""The most forces per step, between bodies and from centres: these take a quarter of a second."""

MOST_STICKING = 20_000
"""The most pairs with static above kinetic friction: pymunk looks up the callback of each in 50
µs."""


def not_too_many_pulls(level: Level) -> Iterator[Fault]:
    """Those between bodies and those to centres can be computed in a step."""
    for effect, place, said in level.effects.said:
        count = len(bodies_of_effect(level, said)) if effect.inside else 0
        if count**2 > MOST_PULLS:
            message = Message(
                "'{effect}' acts between every two of {count:,} bodies; a step can take at most"
                " {most:,}",
                effect=effect.name,
                count=count,
                most=int(MOST_PULLS**0.5),
            )
            yield Fault(place, message)
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
