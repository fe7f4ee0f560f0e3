"""No rocket burns all of its mass."""

from collections.abc import Iterator, Sequence
from functools import partial

from sandbox.model.errors import brief
from sandbox.model.expressions import Positive, Values
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.message import Message
from sandbox.model.rules.conditions.condition import Condition


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on a level's rockets."""
    thrusts = level.effects.thrust or ()
    for index, thrust in enumerate(thrusts):
        if mass := level.bodies[thrust.body].mass:
            burns = [other.propellant for other in thrusts if other.body == thrust.body]
            wrong = partial(_burnt_fault, thrust.body, mass, burns)
            path = ("effects", "thrust", index, "propellant")
            yield Condition(path, names_in((mass, *burns)), wrong)


def _burnt_fault(
    body: str, mass: Positive, burns: Sequence[Positive], values: Values
) -> Message | None:
    whole, burnt = mass(values), sum(propellant(values) for propellant in burns)
    if burnt >= whole:
        return Message(
            "'{body}' burns {burnt:g} kg, but its whole mass is {whole:g} kg",
            body=brief(body),
            burnt=burnt,
            whole=whole,
        )
    return None
