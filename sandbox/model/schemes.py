"""What each scheme and rate requires of a level.

Fourth order needs smooth forces that do not depend on velocities. What holds exactly is as good,
rods, pins, rails and wires: it holds back in time as well.
"""

from collections.abc import Iterator

from sandbox.model.acting_events import breakable
from sandbox.model.errors import brief
from sandbox.model.joints import Joint, Spring, is_exact
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in


def bounds_the_rate(level: Level) -> bool:
    """Whether a level has springs, or effects that see velocities: a step may be too long."""
    springs = any(joint.kind.force for joint in level.joints.values())
    return springs or any(effect.sees_velocity for effect in level.effects.declarations)


def unsmooth(level: Level) -> str | None:
    """Return why a level cannot have a scheme of fourth order; None if it can."""
    found = next(_obstacles(level), None)
    if found is None:
        return None
    rule = f"'fourth-order' is for smooth forces that know no velocity, which rules out {found}"
    return f"{rule}; choose 'leapfrog'"


def _obstacles(level: Level) -> Iterator[str]:
    yield from (f"the event '{brief(name)}', at which forces jump" for name in level.events)
    yield from (f"that '{brief(name)}' may break" for name, _ in breakable(level.joints))
    for effect in level.effects.declarations:
        if "fourth-order" in effect.excludes:
            yield f"the effect '{effect.name}'"
    for potential in level.effects.potential or ():
        if not potential.energy.is_smooth:
            yield f"the effect 'potential', for '{brief(str(potential.energy.source))}' has corners"
    yield from (f"the motion of '{brief(n)}'" for n, body in level.bodies.items() if body.motion)
    for name, joint in level.joints.items():
        if reason := _unsmooth_joint(joint, f"'{brief(name)}'"):
            yield reason


def _unsmooth_joint(joint: Joint, name: str) -> str | None:
    kind = joint.kind
    if isinstance(joint, Spring) and joint.damping.source != 0:
        return f"the damping of {name}"
    if isinstance(joint, Spring) and joint.pushes_only:
        return f"that {name} lets go"
    if isinstance(joint, Spring) and joint.law and not joint.law.is_smooth:
        return f"that the law of {name} has corners"
    if kind.goes_slack:
        return f"the {joint.type} {name}, which can go slack"
    if kind.drives:
        return f"the {joint.type} {name}, which drives what it holds"
    if "t" in names_in(joint):
        return f"that {name} changes its length"
    if not (kind.force or is_exact(joint)):
        return f"the {joint.type} {name}, which is pymunk's own"
    return None
