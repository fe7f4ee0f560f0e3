"""Where a scheme may be used: fourth order needs smooth forces that do not depend on velocities."""

from collections.abc import Iterator

from sandbox.model.errors import brief
from sandbox.model.expressions import NonNegative
from sandbox.model.joints import Spring
from sandbox.model.level import Level

_SMOOTH = ("gravity", "attraction", "gravitation", "force", "rotation")
"""The effects with which fourth order was measured; whatever else there is keeps leapfrog."""


def unsmooth(level: Level) -> str | None:
    """Return why a level cannot have a scheme of fourth order; None if it can."""
    found = next(_obstacles(level), None)
    if found is None:
        return None
    rule = f"'yoshida' is for smooth forces that know no velocity, which rules out {found}"
    return f"{rule}; choose 'leapfrog'"


def _obstacles(level: Level) -> Iterator[str]:
    for effect in level.effects.declared:
        if effect not in _SMOOTH:
            yield f"the effect '{effect}'"
    for name, joint in level.joints.items():
        if not isinstance(joint, Spring):
            yield f"the {joint.type} '{brief(name)}', which holds exactly"
        elif joint.damping != NonNegative(0):
            yield f"the damping of '{brief(name)}'"
        elif joint.pushes_only:
            yield f"that '{brief(name)}' lets go"
