"""The forces of a level that events switch, and those that they could switch."""

from collections.abc import Iterator, Mapping

from sandbox.model.events import cut_joints, tied_joints
from sandbox.model.level import Level


def switched(level: Level) -> Mapping[str, bool]:
    """Return the forces of a level that events switch, and whether they are on at the start.

    They include springs that are cut or tied, or that may break.
    """
    springs = {name for name, joint in level.joints.items() if joint.kind.force}
    found = dict.fromkeys(cut_joints(level.events, level.joints) & springs, True)
    found.update(dict.fromkeys(tied_joints(level.events) & springs, False))
    for event in level.events.values():
        found.update((name, True) for name in event.off if name not in found)
    found.update((name, False) for event in level.events.values() for name in event.on)
    return found


def switchable(level: Level) -> Iterator[str]:
    """Yield the names of what can be switched: effects that are laws, and named forces."""
    for effect, _, one in level.effects.settings:
        if effect.is_law and not effect.changes_mass:
            yield effect.name
            if name := getattr(one, "name", None):
                yield name
