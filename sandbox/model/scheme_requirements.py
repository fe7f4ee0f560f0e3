"""The requirements of schemes and rates on a level.

Schemes of higher order than leapfrog need smooth forces that do not depend on velocities. Exact
rods, pins, rails and wires are allowed as well: they are reversible in time, too.
"""

from collections.abc import Iterator

from sandbox.model.errors import brief
from sandbox.model.events import breakable
from sandbox.model.joints import Joint, Spring, is_exact
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.translatable_message import Message, word


def bounds_the_rate(level: Level) -> bool:
    """Whether a level has springs, or effects that depend on velocities, which limit the step."""
    springs = any(joint.kind.force for joint in level.joints.values())
    return springs or any(effect.depends_on_velocity for effect in level.effects.declarations)


def unsmooth(level: Level) -> Message | None:
    """Return why a level cannot use a scheme of higher order than leapfrog; None if it can."""
    found = next(_obstacles(level), None)
    if found is None:
        return None
    return Message(
        "a higher order needs smooth forces that do not depend on velocity, which rules out"
        " {found}; choose 'leapfrog'",
        found=found,
    )


def _obstacles(level: Level) -> Iterator[Message]:
    yield from map(_jump, level.events)
    yield from (_break(name) for name, _ in breakable(level.joints))
    for effect in level.effects.declarations:
        if effect.is_rough:
            yield Message("the effect '{name}'", name=effect.name)
    for potential in level.effects.potential or ():
        if not potential.energy.is_smooth:
            yield Message(
                "the effect 'potential', since '{source}' has corners",
                source=brief(str(potential.energy.source)),
            )
    yield from (_motion(name) for name, body in level.bodies.items() if body.motion)
    for name, joint in level.joints.items():
        if reason := _unsmooth_joint(joint, f"'{brief(name)}'"):
            yield reason


def _jump(event: str) -> Message:
    return Message("the event '{name}', at which forces jump", name=brief(event))


def _break(joint: str) -> Message:
    return Message("'{name}', which may break", name=brief(joint))


def _motion(body: str) -> Message:
    return Message("the motion of '{name}'", name=brief(body))


def _unsmooth_joint(joint: Joint, name: str) -> Message | None:
    kind = joint.kind
    if isinstance(joint, Spring) and joint.damping.source != 0:
        return Message("the damping of {name}", name=name)
    if isinstance(joint, Spring) and joint.pushes_only:
        return Message("{name}, which lets go", name=name)
    if isinstance(joint, Spring) and joint.law and not joint.law.is_smooth:
        return Message("{name}, whose law has corners", name=name)
    if kind.goes_slack:
        return Message("the {type} {name}, which can go slack", type=word(joint.type), name=name)
    if kind.drives:
        return Message(
            "the {type} {name}, which drives its bodies", type=word(joint.type), name=name
        )
    if "t" in names_in(joint):
        return Message("{name}, whose length changes", name=name)
    if not (kind.force or is_exact(joint)):
        return Message("the {type} {name}, which is pymunk's own", type=word(joint.type), name=name)
    return None
