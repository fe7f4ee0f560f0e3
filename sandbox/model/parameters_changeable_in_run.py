"""Which parameters can change during a run, and why others cannot.

A run that continues keeps its positions and velocities. So a parameter must not change anything
that led to them: a shape, the lengths of joints, the mass that has flowed. And it must affect more
than where bodies started.
"""

from collections.abc import Collection, Iterator

from sandbox.model.effects import EFFECTS
from sandbox.model.joints import Joint, Motor, Spring
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions, names_in
from sandbox.model.number_bounds import Flow, Mass
from sandbox.model.translatable_message import Message, both

TELLS = ("mass", "moment", "friction", "static_friction", "restitution")
"""The fields of a body that affect its motion at every step."""


def obstacle(level: Level, changed: Collection[str]) -> Message | None:
    """Return why some parameters cannot change during a run; None if they can."""
    reasons = (
        (_shapes(level), Message("is part of a shape, which cannot change during a run")),
        (
            _fits(level),
            Message("determines how joints were assembled at the start, which they keep"),
        ),
        (_driven(level), Message("determines where a body is moved to, which would jump")),
        (_flows(level), Message("determines how masses have changed so far")),
    )
    for names, reason in reasons:
        for name in changed:
            if name in names:
                return Message("'{name}' {reason}", name=name, reason=reason)
    if not _acting(level).intersection(changed):
        return Message(
            "the motion does not depend on {listed}, only its start or what is displayed",
            listed=both(f"'{name}'" for name in changed),
        )
    return None


def _shapes(level: Level) -> frozenset[str]:
    return names_in(tuple(body.shape for body in level.bodies.values()))


def _fits(level: Level) -> frozenset[str]:
    """Return the names in whatever fixes joints, including positions at the start."""
    if not level.joints:
        return frozenset()
    places = tuple((body.position, body.angle) for body in level.bodies.values())
    fixed = tuple(part for joint in level.joints.values() for part in _parts(joint, free=False))
    return names_in((places, fixed))


def _driven(level: Level) -> frozenset[str]:
    return names_in(tuple(body.motion for body in level.bodies.values()))


def _flows(level: Level) -> frozenset[str]:
    """Return the names that determine how masses change with time."""
    flowing = (name for name, effect in EFFECTS.items() if effect.changes_mass)
    effects = tuple(getattr(level.effects, name) for name in flowing)
    found = (each for _, each in expressions(effects) if isinstance(each, Flow | Mass))
    return frozenset().union(*(each.names for each in found))


def _acting(level: Level) -> frozenset[str]:
    """Return the names that accelerations depend on at every step."""
    bodies = tuple(getattr(body, field) for body in level.bodies.values() for field in TELLS)
    free = tuple(part for joint in level.joints.values() for part in _parts(joint, free=True))
    return names_in((level.effects, bodies, free))


def _parts(joint: Joint, *, free: bool) -> Iterator[object]:
    """Yield the fields of a joint that may change while it holds or, if not `free`, the others."""
    changeable: tuple[str, ...] = ()
    if isinstance(joint, Spring):
        changeable = "stiffness", "damping", "length", "law"
    elif isinstance(joint, Motor):
        changeable = ("rate",)
    yield from (part for name, part in vars(joint).items() if (name in changeable) == free)
