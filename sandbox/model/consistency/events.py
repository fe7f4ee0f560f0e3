"""Events name what exists, can be observed, and can be cut or switched."""

from collections.abc import Iterator

from sandbox.model.acting_events import breakable
from sandbox.model.consistency.mentions import mentions
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import brief
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import Fault
from sandbox.model.measuring_instants import CrossingEvent
from sandbox.model.quantities import QuantityError, quantity
from sandbox.model.switches import switchable


def known_parts(level: Level) -> Iterator[Fault]:
    """Joints that are cut, and forces that are switched, exist."""
    for path, name in _named(level, "joints"):
        if name not in level.joints:
            yield Fault(path, f"unknown joint '{brief(name)}'{suggestion(name, level.joints)}")
    known = tuple(dict.fromkeys(switchable(level)))
    for path, name in _named(level, "forces"):
        if name not in known:
            rule = f"'{brief(name)}' is no force that can be switched{suggestion(name, known)}"
            yield Fault(path, f"{rule}; one of 'force' or 'torque' is, by its 'name'")


def _named(level: Level, of: str) -> Iterator[tuple[Path, str]]:
    """Yield every part of a kind that is named in a list, and where."""
    for path, names, mention in mentions(level):
        if mention.of == of:
            yield from (((*path, index), name) for index, name in enumerate(names))


def names_apart(level: Level) -> Iterator[Fault]:
    """No two forces have the same name."""
    taken = {effect.name for effect, _, _ in level.effects.said}
    for _, path, one in level.effects.said:
        if name := getattr(one, "name", None):
            if name in taken:
                yield Fault((*path, "name"), f"the name '{name}' is taken")
            taken.add(name)


def events_act(level: Level) -> Iterator[Fault]:
    """Events do something, and what they wait for can be seen at every instant."""
    for name, event in level.events.items():
        path = ("events", name)
        if not (event.cut or event.tie or event.on or event.off):
            rule = "say what it is to 'cut' or to 'tie', or to switch 'on' or 'off'"
            yield Fault(path, f"does nothing: {rule}")
        for joint in sorted({*event.cut} & {*event.tie}):
            yield Fault((*path, "tie"), f"'{brief(joint)}' is cut and tied at once")
        for force in sorted({*event.on} & {*event.off}):
            yield Fault((*path, "off"), f"'{brief(force)}' is switched on and off at once")
        if isinstance(event.at, CrossingEvent):
            yield from _seen(event.at.quantity, (*path, "at", "quantity"), level)


def _seen(name: str, path: Path, level: Level) -> Iterator[Fault]:
    try:
        found = quantity(name, level)
    except QuantityError:
        return  # which is told by itself
    if not found.momentary or found.attribute.startswith("contact."):
        rule = "is not known between two steps; wait for a place, a velocity, a length or a tension"
        yield Fault(path, f"'{brief(name)}' {rule}")


def _what(level: Level) -> str:
    """Return what happens in a level between two steps."""
    if level.events:
        return "'events'"
    breaks = any(True for _ in breakable(level.joints))
    return "joints that break ('breaks_at')" if breaks else "stops with a 'restitution'"


def drifts_cut_once(level: Level) -> Iterator[Fault]:
    """Nothing else happens where impacts, or ends of slipping, cut a drift as well."""
    if not level.happens:
        return
    what = _what(level)
    effects, rule = level.effects, f"cannot be had together with {what}; leave out one"
    for effect in (effects.contact, effects.friction):
        if effect and effect.located is not None:
            yield Fault(("effects", effect.effect.name, "located"), f"'located' {rule}")
    if effects.in_sequence:
        place = ("effects", "restitution", "impacts")
        yield Fault(place, f"impacts in 'sequence' {rule}")
