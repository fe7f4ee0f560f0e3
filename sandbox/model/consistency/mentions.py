"""Where a level names its bodies, pairs and quantities."""

from collections.abc import Iterator, Sequence

from sandbox.model.effects import Friction, Pair, Restitution
from sandbox.model.joints import End, Held, body_of, ends_of
from sandbox.model.level import (
    ApexEvent,
    ContactEvent,
    CrossingEvent,
    LandingEvent,
    Level,
)
from sandbox.model.locating import Path


def named_bodies(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every mention of a body, and where it stands."""
    yield from _names_in_joints(level)
    yield from bodies_of_effects(level)
    for index, belt in enumerate(level.effects.belt or ()):
        yield ("effects", "belt", index, "body"), belt.body
    for path, names in couples(level):
        yield (*path, 0), names[0]
        yield (*path, 1), names[1]
    for name in level.ghosts:
        yield ("ghosts", name), name
    if level.view.landscape:
        yield ("view", "landscape", "body"), level.view.landscape.body
    for index, check in enumerate(level.checks):
        if isinstance(check.at, ApexEvent | LandingEvent):
            yield ("checks", index, "at", "body"), check.at.body


def _names_in_joints(level: Level) -> Iterator[tuple[Path, str]]:
    for name, joint in level.joints.items():
        for path, end in ends_of(joint):
            yield from _end_names(("joints", name, *path), end)


def bodies_of_effects(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies that an effect acts on."""
    for path, bodies in lists_of_bodies(level):
        for index, body in enumerate(bodies):
            yield (*path, index), body
    for index, force in enumerate(level.effects.force or ()):
        yield ("effects", "force", index, "body"), force.body
    yield from bodies_of_flows(level)


def bodies_of_flows(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield the bodies whose mass changes."""
    for kind in ("thrust", "accretion"):
        for index, flow in enumerate(getattr(level.effects, kind) or ()):
            yield ("effects", kind, index, "body"), flow.body


def lists_of_bodies(level: Level) -> Iterator[tuple[Path, tuple[str, ...]]]:
    """Yield the effects that may name the bodies they act on, with those they name."""
    contact, friction = level.effects.contact, level.effects.friction
    yield ("effects", "contact", "located"), (contact and contact.located) or ()
    yield ("effects", "friction", "located"), (friction and friction.located) or ()
    drag, gravitation = level.effects.drag, level.effects.gravitation
    yield ("effects", "drag", "bodies"), (drag and drag.bodies) or ()
    yield ("effects", "gravitation", "bodies"), (gravitation and gravitation.bodies) or ()


def _end_names(path: Path, end: End) -> Iterator[tuple[Path, str]]:
    body = body_of(end)
    if body is not None:
        yield (*path, "body") if isinstance(end, Held) else path, body


def couples(level: Level) -> Iterator[tuple[Path, tuple[str, str]]]:
    """Yield everything that two bodies are named for."""
    for kind, pairs in pairs_of_effects(level).items():
        for index, pair in enumerate(pairs):
            yield ("effects", kind, "pairs", index, "bodies"), pair.bodies
    for index, check in enumerate(level.checks):
        if isinstance(check.at, ContactEvent):
            yield ("checks", index, "at", "bodies"), check.at.bodies


def named_quantities(level: Level) -> Iterator[tuple[Path, str]]:
    """Yield every quantity that is measured, and where it is asked for."""
    for index, check in enumerate(level.checks):
        yield ("checks", index, "quantity"), check.quantity
        if isinstance(check.at, CrossingEvent):
            yield ("checks", index, "at", "quantity"), check.at.quantity


def coefficients(level: Level) -> dict[str, Friction | Restitution]:
    """Return those effects that have a coefficient a body."""
    declared = {"friction": level.effects.friction, "restitution": level.effects.restitution}
    return {kind: effect for kind, effect in declared.items() if effect is not None}


def pairs_of_effects(level: Level) -> dict[str, Sequence[Pair]]:
    """Return the pairs of bodies that effects name."""
    pairs: dict[str, Sequence[Pair]] = {k: e.pairs for k, e in coefficients(level).items()}
    if level.effects.sticking:
        pairs["sticking"] = level.effects.sticking.pairs
    return pairs
