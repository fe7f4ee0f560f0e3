"""Events name parts that exist and can be observed, cut or switched."""

from collections.abc import Iterator

from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import brief
from sandbox.model.events import Event, breakable
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.measuring_instants import CrossingEvent
from sandbox.model.quantities import QuantityError, quantity
from sandbox.model.rules.consistency.references_by_name import mentions
from sandbox.model.switched_forces import switchable
from sandbox.model.translatable_message import Message


def known_parts(level: Level) -> Iterator[Fault]:
    """Joints that are cut, and forces that are switched, exist."""
    for path, name in _named(level, "joints"):
        if name not in level.joints:
            yield Fault(
                path,
                "unknown joint '{name}'{hint}",
                name=brief(name),
                hint=suggestion(name, level.joints),
            )
    known = tuple(dict.fromkeys(switchable(level)))
    for path, name in _named(level, "forces"):
        if name not in known:
            rule = Message(
                "'{name}' is not a force that can be switched{hint}; use the 'name' of a"
                " 'force' or a 'torque'",
                name=brief(name),
                hint=suggestion(name, known),
            )
            yield Fault(path, rule)


def _named(level: Level, of: str) -> Iterator[tuple[Path, str]]:
    """Yield every part of a kind that is named in a list, with the path of its name."""
    for path, names, mention in mentions(level):
        if mention.of == of:
            yield from (((*path, index), name) for index, name in enumerate(names))


def names_apart(level: Level) -> Iterator[Fault]:
    """No two forces have the same name."""
    taken = {effect.name for effect, _, _ in level.effects.settings}
    for _, path, one in level.effects.settings:
        if name := getattr(one, "name", None):
            if name in taken:
                yield Fault((*path, "name"), "the name '{name}' is taken", name=name)
            taken.add(name)


def events_act(level: Level) -> Iterator[Fault]:
    """Events do something, and their triggers can be observed at every instant."""
    for name, event in level.events.items():
        path = ("events", name)
        if not event.has_action:
            rule = Message(
                "does nothing; give it something to 'cut', 'tie', switch 'on' or 'off', or"
                " 'reverse'"
            )
            yield Fault(path, rule)
        for joint in sorted({*event.cut} & {*event.tie}):
            yield Fault((*path, "tie"), "'{joint}' is cut and tied at once", joint=brief(joint))
        for force in sorted({*event.on} & {*event.off}):
            yield Fault(
                (*path, "off"), "'{force}' is switched on and off at once", force=brief(force)
            )
        yield from _one_way(event, path, level)
        if isinstance(event.at, CrossingEvent):
            yield from _seen(event.at.quantity, (*path, "at", "quantity"), level)


def _one_way(event: Event, path: Path, level: Level) -> Iterator[Fault]:
    for index, name in enumerate(event.reverse):
        if name in level.bodies and level.bodies[name].one_way is None:
            rule = Message(
                "'{body}' is not a one-way surface; set its 'one_way' to left or right",
                body=brief(name),
            )
            yield Fault((*path, "reverse", index), rule)


def _seen(name: str, path: Path, level: Level) -> Iterator[Fault]:
    try:
        found = quantity(name, level)
    except QuantityError:
        return  # reported elsewhere
    if not found.is_momentary or found.attribute.startswith("contact."):
        rule = Message(
            "'{name}' is not known between two steps; use a position, a velocity, a length or a"
            " tension",
            name=brief(name),
        )
        yield Fault(path, rule)


def _what(level: Level) -> Message:
    """Return what happens between two steps in a level."""
    if level.events:
        return Message("'events'")
    if any(True for _ in breakable(level.joints)):
        return Message("joints that break ('breaks_at')")
    return Message("stops with a 'restitution'")


def drifts_cut_once(level: Level) -> Iterator[Fault]:
    """No events happen in drifts that are also cut by located impacts or ends of slipping."""
    if not level.has_events:
        return
    effects, what = level.effects, _what(level)
    for effect in (effects.contact, effects.friction):
        if effect and effect.located is not None:
            rule = Message("'located' cannot be combined with {what}; leave out one", what=what)
            yield Fault(("effects", effect.effect.name, "located"), rule)
    if effects.in_sequence:
        rule = Message(
            "impacts in 'sequence' cannot be combined with {what}; leave out one", what=what
        )
        yield Fault(("effects", "restitution", "impacts"), rule)
