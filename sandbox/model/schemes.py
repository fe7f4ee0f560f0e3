"""What a scheme and a rate ask of a level.

Fourth order needs smooth forces that do not depend on velocities. What holds exactly is as good,
rods, pins, rails and wires: it holds back in time as well.
"""

from collections.abc import Iterator

from sandbox.model.errors import brief
from sandbox.model.expressions import Formula
from sandbox.model.joints import Joint, Motor, Pivot, Pulley, Rod, Rope, Spring, Weld, Winding
from sandbox.model.level import Level

_SMOOTH = ("gravity", "attraction", "gravitation", "force", "rotation")
"""The effects with which fourth order was measured; whatever else there is keeps leapfrog."""


def bounds_the_rate(level: Level) -> bool:
    """Whether a level has springs, or effects that slow down: they may be too strong for a step."""
    springs = any(isinstance(joint, Spring) for joint in level.joints.values())
    return springs or bool(level.effects.drag or level.effects.accretion)


def unsmooth(level: Level) -> str | None:
    """Return why a level cannot have a scheme of fourth order; None if it can."""
    found = next(_obstacles(level), None)
    if found is None:
        return None
    rule = f"'fourth-order' is for smooth forces that know no velocity, which rules out {found}"
    return f"{rule}; choose 'leapfrog'"


def _obstacles(level: Level) -> Iterator[str]:
    for effect in level.effects.declared:
        if effect not in _SMOOTH:
            yield f"the effect '{effect}'"
    for name, joint in level.joints.items():
        if reason := _unsmooth_joint(joint, f"'{brief(name)}'"):
            yield reason


def _unsmooth_joint(joint: Joint, name: str) -> str | None:
    match joint:
        case Spring(damping=damping) if damping.source != 0:
            return f"the damping of {name}"
        case Spring(pushes_only=True):
            return f"that {name} lets go"
        case Rope() | Pulley() | Winding():
            return f"the {joint.type} {name}, which can go slack"
        case Motor():
            return f"the motor {name}, which drives what it holds"
        case Rod(length=Formula(names=names)) if "t" in names:
            return f"that {name} changes its length"
        case Rod(exact=False) | Pivot(exact=False) | Weld(exact=False):
            return f"the {joint.type} {name}, which is pymunk's own"
    return None
